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
/// motion, to record a time history at the same time. Tangent vectors are orthogonalised at every
/// sample. A plant of order N has N + 3 exponents, for deviations of these quantities: its state,
/// the previous command u_{j−1}, the relative displacement Δz at the drive's last reversal, and the
/// last reading of the conductor's displacement z₁. Each of these causes makes one exponent −∞:
/// - the drive was engaged at some time: the next reversal then follows from the state;
/// - the controller forms no velocity from displacements: the last reading has no effect;
/// - there is no processing delay: u_{j−1} has no effect from t_j on.
///
/// A phase of stick (Δż = 0) leaves at most N − 1 finite exponents, plus one for each command or
/// reading that is stored in stick and acts later. The phase with the fewest finite exponents
/// determines the result. With processing delay and a velocity formed from displacements, N + 2
/// exponents may be finite, or N + 1 if this object is constructed before the first sample. If the
/// drive never leaves its gap, one exponent is 0.
///
/// An exact −∞ is detected by the structural rank (structural_rank.hpp) of the product of all maps.
/// Numerical pivots cannot detect it, because later maps amplify the round-off of an exact zero.
/// Work per sample of two masses: that of VariationalFlow and some 1500 multiply-adds.
template <class Contact>
class EventLyapunov {
 public:
  /// The number of exponents, N + 3.
  static constexpr int size = VariationalFlow<Contact>::size;

  /// @param motion  motion to be advanced from its present state; it must outlive this object
  explicit EventLyapunov(EventMotion<Contact>& motion)
      : motion_(&motion),
        tangent_(motion),
        spectrum_(detail::oblique_basis<double, size>(motion.state().size() + 3)) {}

  /// Takes the present sample; to be called once before each `advance()`.
  typename EventMotion<Contact>::Sample sense() { return motion_->sense(); }

  /// Advances the motion and its tangent vectors to the next sample.
  void advance();

  /// Adds a displacement (m) to the conductor, not to the tangent vectors; call before sense().
  void displace_conductor(double displacement) { motion_->displace_conductor(displacement); }
  /// The instant t_j (s) of the present sample.
  double time() const { return motion_->time(); }
  /// The state x_j, N × 1; for two masses z_j (m, m/s, m, m/s).
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

/// The five leading Lyapunov exponents, natural logarithm per sample, of an EventMotion from its
/// present state. Invalid if contact changes accumulate (`motion.counts().accumulates` is true).
///
///     const LyapunovResult result = run_event_lyapunov(motion, {1000000, 1000});
///
/// @param motion  the motion; it is advanced to the end of the run
/// @param run     numbers of samples to discard and to average; exponents to be computed
/// @param pause   called every 2¹² samples; may throw to end the run
/// @throws InvalidParameter where `run` is not admissible
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
