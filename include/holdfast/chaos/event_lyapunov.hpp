#pragma once

#include <functional>

#include "holdfast/chaos/lyapunov_run.hpp"
#include "holdfast/chaos/lyapunov_spectrum.hpp"
#include "holdfast/contact/contact.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/motion/event_motion.hpp"
#include "holdfast/motion/variational_flow.hpp"
#ifdef HOLDFAST_EXTERN_TEMPLATES
#include "holdfast/motion/implemented_loop.hpp"
#endif

namespace holdfast {

/// An EventMotion with its Lyapunov spectrum. run_trajectory() accepts this object in place of the
/// motion and can thus record a time history too. Tangent vectors are orthogonalised per sample. A
/// plant of order N has N + 3 exponents, for deviations of its N states, the previous command
/// u_{j−1}, the relative displacement Δz = z₂ − z₁ at the drive's last reversal, and the
/// conductor's displacement as last measured. Each of these conditions makes one exponent −∞:
/// - The drive was engaged at some time. Δz at the next reversal then follows from the state.
/// - Velocity is not computed from measured displacements. The last of them has no effect then.
/// - There is no processing delay. The previous command then has no effect from t_j on.
///
/// While the drive sticks (Δż = 0), at most N − 1 exponents remain finite, plus one for each
/// command or measured displacement that is stored at that time and acts later. The contact mode
/// with the fewest finite exponents determines the result. With processing delay and velocity from
/// displacements, N + 2 exponents may be finite, or N + 1 if this object is constructed before the
/// first sample. If the drive never leaves its gap, one exponent is 0.
///
/// An exact −∞ is detected by the structural rank (structural_rank.hpp) of the product of all maps.
/// Numerical pivots cannot detect it, because later maps amplify the round-off of an exact zero.
/// Work per sample for two masses: that of VariationalFlow and some 1500 multiply-adds.
template <class Contact>
class EventLyapunov {
 public:
  /// The number N + 3 of exponents, or Eigen::Dynamic where N is not fixed at compile time.
  static constexpr int size = VariationalFlow<Contact>::size;

  /// @param motion  motion, continued from its present state; it must outlive this object
  explicit EventLyapunov(EventMotion<Contact>& motion)
      : motion_(&motion),
        tangent_(motion),
        spectrum_(detail::oblique_basis<double, size>(motion.state().size() + 3)) {}

  /// Takes the present sample; call it once before each `advance()`.
  typename EventMotion<Contact>::Sample sense() { return motion_->sense(); }

  /// Advances the motion and its tangent vectors to the next sample.
  void advance();

  /// Displaces the conductor by `displacement` (m), not the tangent vectors; call before sense().
  void displace_conductor(double displacement) { motion_->displace_conductor(displacement); }
  /// The instant t_j (s) of the present sample.
  double time() const { return motion_->time(); }
  /// The state x_j at the present sample, N × 1; for two masses [z₁, ż₁, z₂, ż₂] (m, m/s).
  const typename EventMotion<Contact>::State& state() const { return motion_->state(); }

  /// The Lyapunov spectrum over the samples since the last restart, natural logarithm per sample.
  const LyapunovSpectrum<double, size>& spectrum() const { return spectrum_; }
  /// Restarts the averages; keeps tangent vectors and the number of exponents that are −∞.
  void restart() { spectrum_.restart(); }

 private:
  EventMotion<Contact>* motion_;
  VariationalFlow<Contact> tangent_;
  LyapunovSpectrum<double, size> spectrum_;
};

template <class Contact>
void EventLyapunov<Contact>::advance() {
  tangent_.begin_sample(*motion_);
  motion_->advance(tangent_);
  spectrum_.push(tangent_.map(), tangent_.rank_of_product());
}

/// Computes the five leading Lyapunov exponents, natural logarithm per sample, of an EventMotion.
/// They are invalid if contact changes accumulate: `motion.counts().accumulates` is then true.
///
///     const LyapunovResult result = run_event_lyapunov(motion, {1000000, 1000});
///
/// @param motion  the motion; it is advanced from its present state to the end of the run
/// @param run     numbers of samples to discard and to average; choice of exponents
/// @param pause   function called every 2¹² samples, if set; it may throw to end the run
/// @throws InvalidParameter where a number in `run` is out of its range
template <class Contact>
LyapunovResult run_event_lyapunov(EventMotion<Contact>& motion, const LyapunovRun& run,
                                  const std::function<void()>& pause = {}) {
  validate(run);
  EventLyapunov<Contact> lyapunov(motion);
  return detail::run_average(lyapunov, run, pause);
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template void EventLyapunov<DriveContact<>>::advance();
extern template void EventLyapunov<DriveContact<ControlledPlant>>::advance();
extern template LyapunovResult run_event_lyapunov(EventMotion<DriveContact<>>&, const LyapunovRun&,
                                                  const std::function<void()>&);
extern template LyapunovResult run_event_lyapunov(EventMotion<DriveContact<ControlledPlant>>&,
                                                  const LyapunovRun&, const std::function<void()>&);
#endif

}  // namespace holdfast
