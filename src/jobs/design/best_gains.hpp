#pragma once

#include <optional>

#include "holdfast/motion/ideal_loop.hpp"
#include "holdfast/stability/design/minimum_amplitude.hpp"

namespace holdfast::program {

/// The D of least steady amplitude with which a motion settles in the first half of a duration T:
/// its spectral radius is at most e^{−10 τ/T}, so that the transient falls to e^{−5} by then.
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

}  // namespace holdfast::program
