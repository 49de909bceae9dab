#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "holdfast/contact/contact_guard.hpp"
#include "holdfast/contact/contact_mode.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/math/roots/first_root.hpp"
#include "holdfast/math/roots/series.hpp"
#include "holdfast/motion/dense_output.hpp"
#include "holdfast/motion/event_motion.hpp"
#include "holdfast/motion/taylor_step.hpp"
#include "holdfast/orbit/loop_orbit.hpp"
#include "holdfast/plant/port_readings.hpp"

namespace holdfast {

/// The least margins by which an orbit avoids a change of its switching sequence; +∞ where no such
/// event occurs. Δz and Δż are the relative displacement and velocity of the drive's two sides.
///
/// At a margin of zero the motion touches a switching surface without crossing it. Neighbouring
/// motions then have different switching sequences, and the linearised return map (multipliers)
/// does not describe them. All margins are +∞ for a contact that changes only at the samples.
struct SwitchingMargins {
  /// The value of a margin whose event never occurs, +∞.
  static constexpr double none = std::numeric_limits<double>::infinity();

  /// Least distance (m) of a turning point of Δz from an end of the gap that Δz does not reach.
  double border_distance = none;
  /// Least distance that Δz covers between leaving a gap and the next reversal (m).
  double shortest_travel = none;
  /// Least |Δż| with which Δz passes an end of the gap (m/s).
  double exit_velocity = none;
  /// Least local minimum of |Δż| (m/s) in engaged motion at which Δż does not change its sign.
  double reversal_velocity = none;
  /// Least |a(u)| at a reversal (m/s²); a(u) is the acceleration Δz̈ under the command u.
  double reversal_acceleration = none;
  /// Least |a(0)| at a reversal (m/s²); a(0) is Δz̈ without drive force. Its sign decides between
  /// stick and gap.
  double stick_acceleration = none;
};

/// A periodic motion of the sampled loop whose contact may change between samples.
///
/// The certificate of find_event_orbit() is numerical, in doubles. The simulated motion closes
/// after one period up to `closure_error` and has the same switches in three successive periods.
/// All multipliers, saltation included, lie inside the unit circle. No switching surface is touched
/// within rounding. Only prove_event_orbit() proves that an orbit exists near the computed one.
///
/// There is one multiplier for each entry of [x; u_{j−1}; gap position; last measured displacement]
/// that affects later samples, x being the plant state. Zeros are added up to a total of five.
/// @tparam States  N, the order of the plant
template <int States>
struct EventOrbitOf : LoopOrbit<States> {
  std::vector<ContactMode> modes;  ///< contact mode after each sample
  /// Force of the drive at each sample (N). Engaged: the command u_j, which acts from t_j + δ on,
  /// after the processing delay δ. Gap: 0. Stick: the force that keeps Δż = 0 at the instant t_j.
  std::vector<double> forces;
  std::vector<ContactSwitch> switches;  ///< contact changes of one period; times (s) from sample 0
  /// For each sample in a gap: Δz (m) at the reversal by which the drive entered this gap. No
  /// meaning at other samples and for laws other than exact play (contact/contact.hpp).
  std::vector<double> reversals;
  SwitchingMargins margins;          ///< least margins over all switches and turning points
  std::array<double, 3> time_share;  ///< share of the time in each ContactMode; sum 1
  double largest_displacement;       ///< max |z₁(t)| (m), between the samples too
  double largest_sample;             ///< max |z₁| (m), at the samples
  StateScale extent;  ///< largest displacement and velocity of the drive's two sides, at samples

  /// The largest |z₁| (m) of the conductor at the samples.
  double amplitude() const { return largest_sample; }

  /// The share, 0 … 1, of the samples after which the drive is engaged.
  double engaged_fraction() const {
    const auto engaged = std::count(modes.begin(), modes.end(), ContactMode::engaged);
    return static_cast<double>(engaged) / static_cast<double>(modes.size());
  }

  /// The least of the `margins`, each divided by the orbit's largest displacement x, its largest
  /// velocity v, or v²/x for an acceleration. +∞ where no margin is finite.
  double border_share() const {
    const double acceleration = extent.velocity * extent.velocity / extent.displacement;
    return std::min({extent.share_of_displacement(margins.border_distance),
                     extent.share_of_displacement(margins.shortest_travel),
                     extent.share_of_velocity(margins.exit_velocity),
                     extent.share_of_velocity(margins.reversal_velocity),
                     margins.reversal_acceleration / acceleration,
                     margins.stick_acceleration / acceleration});
  }
  /// The number of times that the given contact mode begins in one period.
  std::int64_t entries(ContactMode mode) const {
    return std::count_if(switches.begin(), switches.end(),
                         [mode](const ContactSwitch& change) { return change.mode == mode; });
  }
};

/// The periodic orbit of a two-mass plant whose contact switches between the samples.
using EventOrbit = EventOrbitOf<4>;

namespace detail {

/// The derivative p′ of a power series p, given by its coefficients in ascending order.
inline Series series_derivative(const Series& p) {
  if (p.size() < 2) return Series::Zero(1);
  const Eigen::Index terms = p.size() - 1;
  const auto powers = Series::LinSpaced(terms, 1.0, static_cast<double>(terms));
  return p.tail(terms).cwiseProduct(powers);
}

/// Calls visit(x, rises) for every x in (0, 1] at which a series changes its sign, in ascending
/// order. The number of calls is at most the number of terms of the series.
template <class Visit>
void for_each_sign_change(Series p, Visit&& visit) {
  double from = 0.0;
  for (Eigen::Index count = 0; count < p.size() && from < 1.0; ++count) {
    Eigen::Index leading = 0;
    while (leading < p.size() && p[leading] == 0.0) ++leading;
    if (leading == p.size()) return;
    const bool rises = p[leading] < 0.0;
    const FirstRoot root = first_root(rises ? Series(-p) : p);
    if (root.outcome == RootOutcome::none) return;
    from += (1.0 - from) * root.at;
    visit(from, rises);
    p = rest_of(p, root.at);
    p[0] = 0.0;
  }
}

/// Whether a guard is a multiple of `row`, a linear function of the plant's state such as Δz or Δż.
template <int States>
bool is_of(const Vector<double, States>& row, const GuardOf<States>& guard) {
  const double factor = guard.state.dot(row) / row.squaredNorm();
  return guard.force == 0.0 && guard.state.isApprox(factor * row, 1e-14);
}

}  // namespace detail

/// An observer of EventMotion::advance that measures a motion between its samples: the margins of
/// its switches, the time in each contact mode, and the largest displacement of the conductor.
///
///     EventOrbitMeasures<Contact> measures(motion);
///     motion.sense();
///     measures.begin();
///     motion.advance(measures);
///
/// The motion must outlive this object and keep its address. No sample may be left out.
/// Turning points are found as roots of the motion's differentiated Taylor series; none is missed.
/// @tparam Contact  contact of the motion
template <class Contact>
class EventOrbitMeasures {
  using Motion = EventMotion<Contact>;
  using ModeGuard = GuardOf<Motion::states>;
  using ModeGuards = GuardsOf<Motion::states>;
  using Expansion = typename Motion::Expansion;
  using Instant = typename Motion::Instant;

 public:
  /// Constructs the observer for a motion; the measurement starts at its present sample.
  explicit EventOrbitMeasures(const EventMotion<Contact>& motion)
      : motion_(&motion),
        readings_(motion.readings()),
        displacement_row_(readings_.displacement_row()),
        velocity_row_(readings_.velocity_row()),
        trace_(motion) {}

  /// Begins a sampling period; to be called after `sense()` and before `advance(measures)`.
  void begin() {
    trace_.begin();
    seen_ = 0;
  }

  /// The least margin of each kind so far.
  const SwitchingMargins& margins() const { return margins_; }
  /// The share of the measured time that the motion has spent in each ContactMode; sum 1.
  std::array<double, 3> time_share() const {
    const double all = time_[0] + time_[1] + time_[2];
    return {time_[0] / all, time_[1] / all, time_[2] / all};
  }
  /// The largest |z₁(t)| (m) of the conductor so far.
  double largest_displacement() const { return largest_displacement_; }

  // The calls by EventMotion::advance.
  /// Called after a time interval in one contact mode: measures the motion from `begin` (s after
  /// the sample) over `length` (s).
  void flowed(int mode, double begin, double length) {
    guards_ = motion_->contact().guards();
    time_[static_cast<std::size_t>(motion_->contact().word())] += length;
    trace_.flowed(mode, begin, length);
    ModeGuards guards = guards_;
    for (; seen_ < trace_.parts().size(); ++seen_) {
      const Expansion& part = trace_.parts()[seen_].state;
      look_at_displacement(part);
      for (int g = 0; g < guards.count; ++g) look_at_guard(guards, at(g), part);
      for (ModeGuard& guard : guards.guard) guard.zeros = 0;
    }
  }
  /// Called when the command u_j takes effect, at t_j + δ (processing delay δ).
  void commanded() { trace_.commanded(); }
  /// Called at a contact change: records the SwitchingMargins, from |Δż| at an end of the gap and
  /// the accelerations at a reversal. A change by a jump of command or force (`guard` −1) has none.
  void switched(int from, int, int guard, const Instant& instant) {
    last_slope_ = {};
    if (guard < 0) return;
    const ModeGuard& reached = guards_.guard[at(guard)];
    if (detail::is_of(displacement_row_, reached)) {
      keep_least(margins_.exit_velocity, std::abs(velocity_row_.dot(instant.state)));
      exit_ = displacement_row_.dot(instant.state);
    } else if (detail::is_of(velocity_row_, reached)) {
      look_at_reversal(motion_->dynamics(from), instant);
    }
  }

 private:
  static constexpr std::size_t at(int index) { return static_cast<std::size_t>(index); }
  static void keep_least(double& margin, double value) {
    margin = std::min(margin, std::max(value, 0.0));
  }

  void look_at_displacement(const Expansion& part) {
    const auto keep = [&](double x, bool) {
      largest_displacement_ =
          std::max(largest_displacement_, std::abs(readings_.displacement(part.state(x))));
    };
    keep(0.0, false);
    keep(1.0, false);
    detail::for_each_sign_change(Series(readings_.velocities(part.coefficients()).transpose()),
                                 keep);
  }

  double* margin_of(const ModeGuard& guard) {
    if (detail::is_of(displacement_row_, guard)) return &margins_.border_distance;
    if (detail::is_of(velocity_row_, guard)) return &margins_.reversal_velocity;
    return nullptr;
  }

  /// Records the local minima of a guard that does not end the mode. At a minimum the guard's slope
  /// rises through zero, continuously or by a jump.
  void look_at_guard(const ModeGuards& guards, std::size_t g, const Expansion& part) {
    const ModeGuard& guard = guards.guard[g];
    double* const margin = margin_of(guard);
    if (margin == nullptr) return;
    Series value = (guard.state.transpose() * part.coefficients()).transpose();
    value[0] += guard.constant;
    const auto value_at = [&](double x) { return value_and_slope(value, x).value; };
    if (guard.unsigned_yet) return keep_least(*margin, std::abs(value_at(1.0)));
    Series slope = detail::series_derivative(value);
    // Both ends of a gap have the slope of Δz, which is zero where the gap was entered.
    const int zeros = std::max(guards.guard[0].zeros, guards.guard[1].zeros) - 1;
    slope.head(std::clamp<Eigen::Index>(zeros, 0, slope.size())).setZero();
    if (last_slope_[g] < 0.0 && slope[0] > 0.0) keep_least(*margin, value_at(0.0));
    detail::for_each_sign_change(slope, [&](double x, bool rises) {
      if (rises) keep_least(*margin, value_at(x));
    });
    last_slope_[g] = slope.sum();
  }

  void look_at_reversal(const typename Motion::Dynamics& dynamics, const Instant& instant) {
    if (exit_)
      keep_least(margins_.shortest_travel, std::abs(displacement_row_.dot(instant.state) - *exit_));
    const double free = velocity_row_.dot(dynamics.state * instant.state + dynamics.drift +
                                          dynamics.force * instant.force);
    const double driven = free + velocity_row_.dot(dynamics.command) * instant.command;
    keep_least(margins_.reversal_acceleration, std::abs(driven));
    keep_least(margins_.stick_acceleration, std::abs(free));
  }

  const Motion* motion_;
  PortReadings<typename Motion::Plant> readings_;
  typename Motion::State displacement_row_, velocity_row_;  // of Δz and Δż, N × 1
  DenseOutput<Contact> trace_;
  std::size_t seen_ = 0;                // number of parts of the trace measured
  ModeGuards guards_;                   // of the last stretch
  std::array<double, 2> last_slope_{};  // of the guards, at the end of the last part; 0: unknown
  std::optional<double> exit_;          // Δz where the last gap was left
  SwitchingMargins margins_;
  std::array<double, 3> time_{};
  double largest_displacement_ = 0.0;
};

}  // namespace holdfast
