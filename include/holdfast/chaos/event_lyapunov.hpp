#pragma once

#include <cstddef>
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

/// A motion and the Lyapunov spectrum that it has had so far. It stands in for the motion in
/// run_trajectory, so that a history may be kept beside it.
///
/// The tangent is that of VariationalFlow, orthogonalised at every sample. Of its N + 3 exponents,
/// N being the order of the plant, one each is −∞
///  - once the drive has been engaged: where its gap lies is a function of the state from then on;
///  - unless the controller takes differences of displacements: else it does not use the last one;
///  - without processing delay: u_{j−1} is without effect from t_j on.
/// After a stick phase, in which Δż = 0 and the drive knows its place, no more are finite than N −
/// 1 and the commands (and readings) that have been decided but act later, at whichever instant of
/// it these are fewest: without processing delay one less, with one up to two less. With a delay
/// and a difference together N + 2 may be finite; one less if this is made before the first sample
/// of all, when nothing has been read. A gap that is never left is neutral, an exponent of 0.
///
/// An exact −∞ is told by the structural rank (structural_rank.hpp) of the product of all maps, not
/// by a pivot: maps with different kernels show it only up to a rounding that those in between
/// magnify. Work per sample of the two masses: that of the tangent, and some 1500 multiply-adds.
template <class Contact>
class EventLyapunov {
 public:
  /// N + 3.
  static constexpr int size = VariationalFlow<Contact>::size;

  /// @param motion  goes on from where it stands; must outlive this
  explicit EventLyapunov(EventMotion<Contact>& motion)
      : motion_(&motion),
        tangent_(motion),
        spectrum_(detail::oblique_basis<double, size>(motion.state().size() + 3)) {}

  /// Takes the sample; once before each `advance()`.
  typename EventMotion<Contact>::Sample sense() { return motion_->sense(); }

  /// Moves on to the next sample, and the tangent vectors with it.
  void advance();

  /// Adds a displacement (m) to the conductor, which leaves the tangent vectors as they are; call
  /// before `sense()`.
  void displace_conductor(double displacement) { motion_->displace_conductor(displacement); }
  /// t_j (s) of the present sample.
  double time() const { return motion_->time(); }
  /// x_j, N × 1; of the two masses z_j (m, m/s, m, m/s).
  const typename EventMotion<Contact>::State& state() const { return motion_->state(); }

  /// Natural logarithm per sample, over the samples since the last restart.
  const LyapunovSpectrum<double, size>& spectrum() const { return spectrum_; }
  /// Number of batches complete, for the standard errors.
  std::size_t complete_batches() const { return spectrum_.complete_batches(); }
  /// Forgets all but the tangent vectors.
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

/// The five leading Lyapunov exponents of a motion that may switch between its samples, from where
/// it stands, natural logarithm per sample. One whose `counts()` say that its changes of contact
/// accumulate has none to be trusted from there on.
///
///     const LyapunovResult result = run_event_lyapunov(motion, {1000000, 1000, 1e-5});
///
/// @param motion  left after the last sample taken
/// @param run     how long, and with what accuracy, is averaged
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
