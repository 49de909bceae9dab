#pragma once

#include <optional>

#include "case/case.hpp"
#include "holdfast/motion/ideal_loop.hpp"
#include "holdfast/stability/design/max_delay.hpp"
#include "holdfast/stability/design/minimum_amplitude.hpp"

namespace holdfast::program {

/// The D of least steady amplitude that has the usual margin and with which a motion settles in the
/// first half of a duration T: its spectral radius is at most e^{−10 τ/T}, so that the transient
/// falls to e^{−5} by then.
class BestGains {
 public:
  /// @param duration  T (s), > 0
  explicit BestGains(double duration) : duration_(duration) {}

  /// Its D is NaN where the outcome says that there is none.
  const MinimumAmplitude& of(const IdealLoop<double>& loop);

 private:
  double duration_;
  std::optional<IdealLoop<double>> known_;  // the last one asked for
  MinimumAmplitude answer_{};
};

/// The question which computer is the slowest that attenuates at a frequency (Hz), P being tuned to
/// it by Eq. 6; its processing delay keeps the case's share of the sampling period.
MaxDelayOptions tuned_delay_question(const Case& the_case, double frequency);

}  // namespace holdfast::program
