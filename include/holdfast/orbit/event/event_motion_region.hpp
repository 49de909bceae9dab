#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "holdfast/motion/implemented_loop.hpp"
#include "holdfast/orbit/event/event_orbit.hpp"
#include "holdfast/orbit/event/event_orbit_search.hpp"
#include "holdfast/orbit/event/return_map.hpp"
#include "holdfast/orbit/motion_border.hpp"

namespace holdfast {

/// Continues an orbit to a loop with similar parameters: computes the loop's periodic motion with
/// the period and sequence of contact modes of the orbit. The switching instants may differ.
/// @param loop   the loop with similar parameters and the same f τ (frequency × sampling period)
/// @param orbit  known orbit of the original loop, not in stick at every sample; its drive leaves
///               every gap. @return `certified` only if such a motion with these modes is found
template <class Plant>
OrbitResultOf<EventOrbitOf<states_of<Plant>>> continued_orbit(
    const ImplementedLoopOf<Plant>& loop, const EventOrbitOf<states_of<Plant>>& orbit) {
  using Contact = DriveContact<Plant>;
  const std::int64_t start = detail::section_of(orbit);
  if (start < 0) return {};
  const std::size_t samples = orbit.states.size(), at = static_cast<std::size_t>(start);
  const auto fresh = event_motion(loop, orbit.states[at]);
  Contact contact = fresh.contact();
  if (orbit.modes[at] == ContactMode::gap) {
    if (orbit.switches.empty()) return {};  // a gap that is never left may lie anywhere
    const double reversal = orbit.reversals[at];
    const double here = fresh.readings().relative_displacement(orbit.states[at]);
    contact.cross_gap(reversal, here < reversal ? 1.0 : -1.0);
  }
  RepeatingMotion<Contact> motion(fresh, orbit.ratio.denominator);
  const double command = orbit.forces[(at + samples - 1) % samples];
  const double reading = fresh.readings().displacement(orbit.states[(at + samples - 1) % samples]);
  motion.go_to({start % orbit.ratio.denominator, orbit.states[at], command, reading, contact});
  // Continue to the orbit's first sample.
  for (std::size_t j = at; j < samples; ++j) {
    motion.sense();
    motion.advance();
  }
  auto found = detail::EventOrbitSolver<Contact>(motion, orbit.ratio)
                   .solve(motion.point(), orbit.period_samples());
  const auto same_mode = [](const ContactSwitch& a, const ContactSwitch& b) {
    return a.mode == b.mode;
  };
  const bool alike = found.orbit && found.orbit->period_samples() == orbit.period_samples() &&
                     detail::is_rotated(found.orbit->switches, orbit.switches, 1, same_mode);
  if (found.outcome == OrbitOutcome::certified && !alike)
    found.outcome = OrbitOutcome::not_reproduced;
  return {found.outcome, std::move(found.orbit), found.samples, found.candidates};
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template OrbitResultOf<EventOrbit> continued_orbit(const ImplementedLoop&,
                                                          const EventOrbit&);
#endif

namespace detail {

/// Whether an orbit is symmetric: half a period later the state has the opposite sign.
template <int States>
bool mirrors_itself(const EventOrbitOf<States>& orbit) {
  constexpr double rounding = 1e-6;  // of each state
  const std::size_t samples = orbit.states.size(), half = samples / 2;
  if (samples % 2 != 0) return false;
  Vector<double, States> largest = orbit.states.front().cwiseAbs(), open = 0.0 * largest;
  for (std::size_t j = 0; j < half; ++j) {
    if (orbit.modes[j] != orbit.modes[j + half]) return false;
    largest = largest.cwiseMax(orbit.states[j].cwiseAbs());
    open = open.cwiseMax((orbit.states[j] + orbit.states[j + half]).cwiseAbs());
  }
  return (open.array() <= rounding * largest.array()).all();
}

/// The least margin of an orbit, relative to its size, and the border where that margin is zero.
template <int States>
RegionLook<MotionBorder> look_of(const EventOrbitOf<States>& orbit) {
  const SwitchingMargins& margins = orbit.margins;
  const StateScale& extent = orbit.extent;
  const double acceleration = extent.velocity * extent.velocity / extent.displacement;
  const double at_end =
      std::min({extent.share_of_displacement(margins.border_distance),
                extent.share_of_displacement(margins.shortest_travel),
                // A turn that passes an end by a way s passes it at a speed like √s.
                std::pow(extent.share_of_velocity(margins.exit_velocity), 2.0)});
  const double at_reversal = std::min(extent.share_of_velocity(margins.reversal_velocity),
                                      std::pow(margins.reversal_acceleration / acceleration, 2.0));
  const double stick = margins.stick_acceleration / acceleration;
  const Multiplier& largest = orbit.multipliers.front();
  RegionLook<MotionBorder> look{-largest.log_modulus, circle_border(largest)};
  const auto take = [&](double margin, BorderKind kind, SwitchingSurface surface) {
    if (margin < look.margin) look = {margin, {kind, surface, -1, 0, largest}};
  };
  take(at_end, BorderKind::grazing, SwitchingSurface::gap_upper);
  take(at_reversal, BorderKind::grazing, SwitchingSurface::reversal);
  take(stick, BorderKind::sliding, SwitchingSurface::reversal);
  return look;
}

/// Continuation of an exact-switching orbit over two parameters, from the nearest known solution.
template <class Family, class Orbit>
class EventContinuation {
 public:
  EventContinuation(const Family& family, const PlanePoint& at, const Orbit& orbit)
      : family_(family), mirrored_(mirrors_itself(orbit)), known_{{at, orbit}} {}

  RegionLook<MotionBorder> operator()(double x, double y) {
    ++solutions_;
    const auto distance = [&](const Known& known) {
      return std::hypot((known.at.x - x) / unit_.x, (known.at.y - y) / unit_.y);
    };
    const auto nearest =
        std::min_element(known_.begin(), known_.end(),
                         [&](const Known& a, const Known& b) { return distance(a) < distance(b); });
    auto found = continued_orbit(family_(x, y), nearest->orbit);
    if (found.outcome != OrbitOutcome::certified) return {-1.0, beyond(nearest->orbit)};
    RegionLook<MotionBorder> look = look_of(*found.orbit);
    // Where the symmetry breaks, the motion continues as a pair of asymmetric orbits.
    if (mirrored_ && look.margin > 0.0 && !mirrors_itself(*found.orbit))
      return {-1.0, beyond(nearest->orbit)};
    if (look.margin > 0.0) remember({{x, y}, std::move(*found.orbit)});
    return look;
  }

  /// Sets the units of x and y for distances between parameter points; initially 1.
  void set_unit(const PlanePoint& unit) { unit_ = unit; }
  int solutions() const { return solutions_; }

 private:
  struct Known {
    PlanePoint at;
    Orbit orbit;
  };

  /// The border that was crossed when no motion was found: `switch_at_sample` if the nearest known
  /// orbit switches near a sample, else `jump`.
  static MotionBorder beyond(const Orbit& orbit) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    const BorderKind kind = nears_sample(orbit) ? BorderKind::switch_at_sample : BorderKind::jump;
    return {kind, {}, -1, 0, {none, none}};
  }

  /// Whether a switch occurs within 10⁻³ τ of a sample, but not at that sample. A switch that the
  /// sample itself causes occurs exactly at the sample.
  static bool nears_sample(const Orbit& orbit) {
    constexpr double near = 1e-3, rounding = 1e-12;
    return std::any_of(orbit.switches.begin(), orbit.switches.end(), [&](const auto& change) {
      const double apart = std::abs(std::remainder(change.time / orbit.sampling_period, 1.0));
      return apart < near && apart > rounding;
    });
  }

  void remember(Known known) {
    constexpr std::size_t most = 64;
    if (known_.size() < most) {
      known_.push_back(std::move(known));
      return;
    }
    known_[oldest_] = std::move(known);
    oldest_ = (oldest_ + 1) % most;
  }

  const Family& family_;
  bool mirrored_;
  PlanePoint unit_{1.0, 1.0};
  std::vector<Known> known_;
  std::size_t oldest_ = 0;
  int solutions_ = 0;
};

}  // namespace detail

/// Computes the border of the region of two parameters in which a periodic motion with exact
/// switching (contact changes at any time) exists and attracts. Inside, the period and the sequence
/// of contact modes do not change, and all multipliers lie inside the unit circle.
///
/// The kind of a border is the cause that ends the motion: a multiplier at the unit circle or a
/// margin of EventOrbit at zero. If a contact change crosses a sample, the multipliers jump but the
/// motion may persist. The region of a symmetric motion ends where the motion loses its symmetry.
/// @param family  function (x, y) ↦ ImplementedLoop; f τ, the orbit's `ratio`, must be constant
/// @param orbit   certified orbit of family(at.x, at.y); its drive leaves every gap that it enters
/// @param window  range of the parameters that is searched; contains `at`
/// @param at      parameters (x, y) of the orbit
/// @param steps   step lengths and accuracies along the border, as shares of the window's sides
/// @throws InvalidParameter where the window is not finite or does not contain `at`
template <class Family, int States>
MotionRegion motion_region(const Family& family, const EventOrbitOf<States>& orbit,
                           const ParameterWindow& window, const PlanePoint& at,
                           const BorderSteps& steps = {0.02, 1e-6, 1e-9}) {
  detail::validate(window, at);
  detail::EventContinuation<Family, EventOrbitOf<States>> look(family, at, orbit);
  look.set_unit({window.x_to - window.x_from, window.y_to - window.y_from});
  const auto seen = [&](double x, double y) { return look(x, y); };
  MotionRegion region = detail::motion_region_by(seen, window, at, steps);
  region.solutions = look.solutions();
  return region;
}

}  // namespace holdfast
