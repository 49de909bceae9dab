#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "holdfast/contact/contact_guard.hpp"
#include "holdfast/contact/contact_mode.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/math/roots/first_root.hpp"
#include "holdfast/math/roots/series.hpp"
#include "holdfast/motion/dense_output.hpp"
#include "holdfast/motion/event_motion.hpp"
#include "holdfast/motion/trajectory.hpp"
#include "holdfast/plant/port_readings.hpp"

namespace holdfast {

/// A point of the Poincaré section Δż = 0, where absorber and conductor have equal velocities.
/// @tparam States  N, the order of the plant
template <int States>
struct SectionPointOf {
  double time;                   ///< instant (s)
  Vector<double, States> state;  ///< state x, N × 1, with Δż = 0; of two masses (m, m/s, m, m/s)
  bool rising;                   ///< whether Δż was negative before
  bool engaged;                  ///< whether the drive transmits from this instant on
};

/// A point of the section of the two masses, [z₁, ż₁, z₂, ż₂] with ż₂ = ż₁.
using SectionPoint = SectionPointOf<4>;

namespace detail {

/// The sign and the vanishing derivatives of Δż in a part of the motion, as far as known.
struct KnownVelocity {
  int zeros = 0;      ///< number of Δż, Δz̈, … that vanish at the beginning
  double sign = 0.0;  ///< constant sign of Δż in the stretch, ±1; 0: not determined
};

/// The KnownVelocity of a contact mode, from its guards. @param guards  guards of the mode
/// @param readings  readings of the plant
template <int States, class Readings>
KnownVelocity known_velocity(const GuardsOf<States>& guards, const Readings& readings) {
  const Vector<double, States> velocity = readings.velocity_row();
  const Vector<double, States> displacement = readings.displacement_row();
  KnownVelocity known;
  for (int g = 0; g < guards.count; ++g) {
    const auto& guard = guards.guard[static_cast<std::size_t>(g)];
    for (const double sign : {1.0, -1.0}) {
      if (guard.state == sign * velocity) {
        known.zeros = std::max(known.zeros, guard.zeros);
        if (!guard.unsigned_yet) known.sign = sign;
      } else if (guard.state == sign * displacement) {
        known.zeros = std::max(known.zeros, guard.zeros - 1);
      }
    }
  }
  return known;
}

/// The sign of p(x) just after x = 0; 0 where p vanishes identically.
inline double leading_sign(const Series& p) {
  for (Eigen::Index k = 0; k < p.size(); ++k)
    if (p[k] != 0.0) return p[k] > 0.0 ? 1.0 : -1.0;
  return 0.0;
}

/// The observer of EventMotion::advance that reports the changes of sign of Δż along a motion.
template <class Contact, class Observer>
class TurnFinder {
  using Motion = EventMotion<Contact>;
  using Part = typename DenseOutput<Contact>::Part;

 public:
  /// Constructs the finder; the motion and the observer must outlive it.
  TurnFinder(const Motion& motion, Observer& observer)
      : motion_(&motion), observer_(&observer), trace_(motion) {
    const bool sticks = motion.contact().word() == ContactMode::stick;
    const double velocity = sticks ? 0.0 : motion.readings().relative_velocity(motion.state());
    sign_ = velocity > 0.0 ? 1.0 : velocity < 0.0 ? -1.0 : 0.0;
  }

  /// Starts a sampling period; to be called after `sense()` and before `advance()`.
  void begin() {
    time_ = motion_->time();
    trace_.begin();
  }

  void flowed(int mode, double begin, double length) {
    KnownVelocity known = known_velocity(motion_->contact().guards(), motion_->readings());
    // Where changes of contact are no longer followed, Δż may pass zero in any mode.
    if (motion_->counts().accumulates) known.sign = 0.0;
    const std::size_t seen = trace_.parts().size();
    trace_.flowed(mode, begin, length);
    for (std::size_t part = seen; part < trace_.parts().size(); ++part) {
      look_at(trace_.parts()[part], known);
      known.zeros = 0;
    }
  }
  void commanded() { trace_.commanded(); }
  void switched(int from, int to, int guard, const typename Motion::Instant& instant) {
    trace_.switched(from, to, guard, instant);
  }

 private:
  static constexpr double velocity_rounding = 64.0 * std::numeric_limits<double>::epsilon();

  void look_at(const Part& part, const KnownVelocity& known) {
    if (part.mode == ContactMode::stick) return rest(part);
    if (part.length == 0.0) return;
    if (known.sign != 0.0) return take_sign(part, 0.0, known.sign);
    search(part, known.zeros);
  }

  /// Reports a part in stick, where Δż stays 0, as one turning point at its beginning.
  void rest(const Part& part) {
    if (sign_ != 0.0) show(part, 0.0, sign_ < 0.0);
    sign_ = 0.0;
  }

  /// Sets the sign of Δż from x on; reports a turning point of Δz at x if the sign was opposite.
  void take_sign(const Part& part, double x, double sign) {
    if (sign_ * sign < 0.0) show(part, x, sign > 0.0);
    sign_ = sign;
  }

  /// Finds the turning points in a part. @param zeros  number of Δż, Δz̈, … that vanish at its start
  void search(const Part& part, int zeros) {
    const auto& states = part.state.coefficients();
    const double size = velocity_size(states);
    if (!(size > 0.0 && std::isfinite(size))) return;
    // In units of the velocities, whose squares might leave the range of numbers.
    const Series velocity = motion_->readings().relative_velocities(states).transpose() / size;
    double x = 0.0;
    Series left = velocity;
    left.head(std::min<Eigen::Index>(zeros, left.size())).setZero();
    // The part before may have found the same turn at its end, on the other side of rounding.
    if (std::abs(left[0]) <= velocity_rounding) left[0] = 0.0;
    // A polynomial has no more zeros than coefficients.
    for (Eigen::Index found = 0; found < velocity.size(); ++found) {
      // A zero at the end of a part is left to the next one, which knows how Δż goes on.
      if (left.cwiseAbs().sum() <= velocity_rounding) return;
      const double sign = leading_sign(left);
      take_sign(part, x, sign);
      const FirstRoot root = first_root(sign * left);
      if (root.outcome == RootOutcome::none) return;
      x += root.at * (1.0 - x);
      left = rest_of(velocity, x);
      // Where it touches zero, the slope is zero but for rounding too.
      const Eigen::Index vanishing = root.outcome == RootOutcome::grazing ? 2 : 1;
      left.head(std::min(vanishing, left.size())).setZero();
    }
  }

  /// The bound Σ |r_i| Σ_k |x_ik| of |Δż| = |r x| in a part; x_ik: Taylor coefficients of x.
  template <class Coefficients>
  double velocity_size(const Coefficients& states) const {
    const typename Motion::State row = motion_->readings().velocity_row();
    double size = 0.0;
    for (Eigen::Index i = 0; i < row.size(); ++i)
      if (row[i] != 0.0) size += std::abs(row[i]) * states.row(i).cwiseAbs().sum();
    return size;
  }

  void show(const Part& part, double x, bool rising) {
    (*observer_)(SectionPointOf<Motion::states>{time_ + part.begin + x * part.length,
                                                part.state.state(x), rising,
                                                part.mode == ContactMode::engaged});
  }

  const Motion* motion_;
  Observer* observer_;
  DenseOutput<Contact> trace_;
  double time_ = 0.0;
  double sign_;  // of Δż; 0 while it is zero, and before it was first unlike zero
};

}  // namespace detail

/// Runs a motion and reports every turning point of Δz, the relative displacement z₂ − z₁, that is,
/// every change of sign of Δż. Turning points between the samples are found as first roots of a
/// Taylor series (math/roots/first_root.hpp), so that none is missed.
///
///     auto motion = event_motion(implemented_loop(loop), Vector<double, 4>::Zero().eval());
///     run_section(motion, samples, [](const SectionPoint& at) { … });
///
/// A phase of stick (Δż = 0 for some time) gives one point, at its beginning, even if Δz afterwards
/// continues in the same direction; the next point then has the same `rising`. A point is `engaged`
/// where the drive transmits the whole command afterwards. With exact switching and a backlash
/// r₀ > 0 no point is `engaged`: each reversal of an engaged drive begins a gap or stick. A zero of
/// Δż without a change of sign, up to rounding, and Δż = 0 at the start give no point.
/// @param motion    motion before its next sample; a further call continues the motion
/// @param samples   number of sampling periods
/// @param observer  called with each point, a SectionPointOf<N>, in order of time
/// @return `diverged` where the run ended early because the state is not finite
/// Extra work per mode in a sampling period: a Taylor series (taylor_step.hpp) and its root.
template <class Contact, class Observer>
TrajectoryOutcome run_section(EventMotion<Contact>& motion, std::int64_t samples,
                              Observer&& observer) {
  detail::TurnFinder<Contact, std::remove_reference_t<Observer>> turns(motion, observer);
  for (std::int64_t taken = 0; taken < samples; ++taken) {
    motion.sense();
    turns.begin();
    motion.advance(turns);
    if (!std::isfinite(motion.state().sum())) return TrajectoryOutcome::diverged;
  }
  return TrajectoryOutcome::completed;
}

}  // namespace holdfast
