#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "holdfast/core/errors.hpp"
#include "holdfast/math/linalg/multipliers.hpp"
#include "holdfast/math/roots/bracketing_root.hpp"
#include "holdfast/motion/forced_loop.hpp"
#include "holdfast/orbit/itinerary_maps.hpp"
#include "holdfast/orbit/periodic_orbit.hpp"
#include "holdfast/orbit/periodic_solution.hpp"
#include "holdfast/orbit/switching_borders.hpp"

namespace holdfast {

/// Why an orbit cannot be followed any further along a parameter.
enum class OrbitEndOutcome {
  border_collision,  ///< a sample comes to lie on a switching surface: its decision would change
  unit_circle,       ///< a multiplier reaches modulus 1
  range_end,         ///< neither: the orbit is there, attracting, at the end of the range
};

/// Where and why an orbit ends.
struct OrbitEnd {
  OrbitEndOutcome outcome = OrbitEndOutcome::range_end;  ///< why it is not followed any further
  double parameter = 0.0;                                ///< its value at the end
  Border border;            ///< of a border collision: which surface at which sample of the orbit
  Multiplier multiplier{};  ///< the largest there; of `unit_circle`, angle 0: fold, π: flip, else a
                            ///< pair
  int solutions = 0;  ///< how often the sequence was solved
};

namespace detail {

/// An orbit's sequence of contacts solved at one value of a parameter: all that may end it, each
/// positive while the orbit lasts.
struct FollowedOrbit {
  bool solved = false;
  Borders borders;
  Multiplier multiplier{};
};

/// Follows an orbit along a path of loops by its sequence of contacts.
template <class Path>
class OrbitFollower {
 public:
  OrbitFollower(const Path& path, const PeriodicOrbit& orbit, double width)
      : path_(path),
        orbit_(orbit),
        has_backlash_(width > 0.0),
        pattern_(switching_pattern(orbit.states, Backlash<double>(width, orbit.memory))),
        extent_(orbit.states) {}

  FollowedOrbit at(double parameter) {
    ++solutions_;
    const ForcedLoop<double> loop = path_(parameter);
    require_ratio(loop);
    if (has_backlash_ != (loop.backlash_width > 0.0))
      throw InvalidParameter("backlash width along the path", loop.backlash_width, "m",
                             has_backlash_ ? "> 0: without backlash the rule is another one"
                                           : "0, as it is at the orbit");
    const ContactMaps<double> maps(loop, orbit_.ratio);
    const auto blocks = affine_blocks(maps, orbit_.contacts);
    const auto solution = periodic_solution(maps, orbit_.contacts, relation_of_ends(blocks));
    FollowedOrbit followed;
    followed.solved = solution.has_value();
    if (!followed.solved) return followed;
    followed.borders = pattern_.stays_inside()
                           ? borders_in_best_gap(solution->states, loop.backlash_width)
                           : borders_of(pattern_, solution->states, loop.backlash_width);
    followed.multiplier = multipliers_of_product(maps_of(blocks)).front();
    return followed;
  }

  /// The smallest of the distances, each as a share of the orbit's own size; negative past the end.
  double margin(const FollowedOrbit& followed) const {
    if (!followed.solved) return -1.0;
    return std::min({followed.borders.displacement.distance / extent_.displacement,
                     followed.borders.velocity.distance / extent_.velocity,
                     -followed.multiplier.log_modulus});
  }

  OrbitEnd end(double parameter, const FollowedOrbit& followed) const {
    OrbitEnd result;
    result.parameter = parameter;
    result.multiplier = followed.multiplier;
    result.solutions = solutions_;
    const double by_displacement = followed.borders.displacement.distance / extent_.displacement;
    const double by_velocity = followed.borders.velocity.distance / extent_.velocity;
    const bool by_multiplier = !followed.solved || -followed.multiplier.log_modulus <=
                                                       std::min(by_displacement, by_velocity);
    result.outcome =
        by_multiplier ? OrbitEndOutcome::unit_circle : OrbitEndOutcome::border_collision;
    if (!by_multiplier)
      result.border =
          by_displacement < by_velocity ? followed.borders.displacement : followed.borders.velocity;
    return result;
  }

  int solutions() const { return solutions_; }

 private:
  /// Of an orbit that stays in the gap: it is there in every gap that holds it, so the one counts
  /// that holds it best.
  static Borders borders_in_best_gap(const std::vector<Vector<double, 5>>& states, double width) {
    std::size_t lowest = 0, highest = 0;
    const auto at = [&](std::size_t j) { return relative_displacement(states[j]); };
    for (std::size_t j = 1; j < states.size(); ++j) {
      if (at(j) < at(lowest)) lowest = j;
      if (at(j) > at(highest)) highest = j;
    }
    const double clearance = (width - (at(highest) - at(lowest))) / 2.0;
    return {{clearance, SwitchingSurface::gap_upper, static_cast<std::int64_t>(highest)}, {}};
  }

  void require_ratio(const ForcedLoop<double>& loop) const {
    const double given = loop.excitation.frequency * loop.sampling.period;
    const double kept =
        static_cast<double>(orbit_.ratio.numerator) / static_cast<double>(orbit_.ratio.denominator);
    if (loop.excitation.amplitude > 0.0 && !(std::abs(given - kept) <= 1e-9 * kept))
      throw InvalidParameter("f tau along the path", given, "", "that of the orbit");
  }

  const Path& path_;
  const PeriodicOrbit& orbit_;
  bool has_backlash_;
  SwitchingPattern pattern_;
  StateExtent extent_;
  int solutions_ = 0;
};

}  // namespace detail

/// Follows an orbit along one parameter by its sequence of contacts, to where it ends.
///
/// At each value the sequence is solved anew; the orbit lasts while every sample keeps its side of
/// the switching surface and every multiplier stays inside the unit circle. The first step at whose
/// end it does not is narrowed to the rounding of the parameter. An end that comes and goes within
/// one step is not seen.
///
///     const auto path = [&](double gain) { auto other = loop; other.gains.differential = gain;
///                                          return other; };
///     const OrbitEnd end = follow_orbit(path, orbit, loop.gains.differential, -30.0);
///
/// @param path   parameter ↦ ForcedLoop<double>, with the same f τ everywhere; path(from) is the
///               loop of the orbit
/// @param orbit  certified
/// @param from,to  finite; `to` may lie on either side
/// @param steps  ≥ 1
/// @throws InvalidParameter where the range is not finite, f τ is another one, or the backlash
///         vanishes or appears along the path: without it the rule is another one
template <class Path>
OrbitEnd follow_orbit(const Path& path, const PeriodicOrbit& orbit, double from, double to,
                      int steps = 64) {
  require_finite("start of the path", from, "");
  require_finite("end of the path", to, "");
  require_within("number of steps", steps, "", 1.0, 1e6);
  detail::OrbitFollower<Path> follower(path, orbit, path(from).backlash_width);
  double last = from;
  for (int k = 1; k <= steps; ++k) {
    const double next = k == steps ? to : from + (to - from) * k / steps;
    const detail::FollowedOrbit followed = follower.at(next);
    if (follower.margin(followed) > 0.0) {
      last = next;
      continue;
    }
    const auto margin = [&follower](double value) { return follower.margin(follower.at(value)); };
    const SignChange<double> bracket{std::min(last, next), std::max(last, next),
                                     last < next ? 1.0 : -1.0, last < next ? -1.0 : 1.0};
    const double tolerance =
        4.0 * std::numeric_limits<double>::epsilon() * std::max(std::abs(last), std::abs(next));
    const auto found = bracketing_root(margin, bracket, tolerance);
    const double position = last < next ? found.upper : found.lower;
    return follower.end(position, follower.at(position));
  }
  OrbitEnd end;
  end.parameter = to;
  end.multiplier = follower.at(to).multiplier;
  end.solutions = follower.solutions();
  return end;
}

}  // namespace holdfast
