#pragma once

#include <optional>
#include <string>

#include "case/case.hpp"
#include "holdfast/control/gains.hpp"
#include "holdfast/motion/ideal_loop.hpp"
#include "holdfast/stability/design/max_delay.hpp"
#include "holdfast/stability/design/minimum_amplitude.hpp"
#include "kernels/instruction_set.hpp"

namespace holdfast::program {

/// Options of a D of least amplitude: to stay below a spectral radius, or else to have a margin,
/// which two masses measure by the decay of their loop and a conductor by the distance of its loop
/// from instability, whatever is between plant and computer.
AmplitudeOptions amplitude_options_of(const Case& the_case,
                                      std::optional<double> largest_radius = std::nullopt,
                                      std::optional<double> margin = std::nullopt);

/// The D of least steady amplitude that has the usual margin and with which a motion settles in the
/// first half of a duration T: its spectral radius is at most e^{−10 τ/T}, so that the transient
/// falls to e^{−5} by then.
class BestGains {
 public:
  /// @param duration  T (s), > 0
  explicit BestGains(double duration) : duration_(duration) {}

  /// Its D is NaN where the outcome says that there is none.
  const MinimumAmplitude& of(const IdealLoop<double>& loop);
  /// Best D of the loop of a case, whichever it is; on a conductor it need not settle in that time,
  /// for the slowest modes, which no absorber reaches, do not.
  MinimumAmplitude of(const Case& the_case) const;

 private:
  double duration_;
  std::optional<IdealLoop<double>> known_;  // the last one asked for
  MinimumAmplitude answer_{};
};

/// Warning of the play of a case for a gain that was chosen without it: the ratio to the
/// uncontrolled vibration by the motions of both, of two masses; "" where the case has no play or
/// no such gain.
/// @param gains  N/m, N s/m
/// @param ideal  the ratio without play
std::string play_warning(const Case& the_case, const PdGains<double>& gains, double ideal,
                         InstructionSet set);

/// The question which computer is the slowest that attenuates at a frequency (Hz), P being tuned to
/// it by Eq. 6; its processing delay keeps the case's share of the sampling period.
MaxDelayOptions tuned_delay_question(const Case& the_case, double frequency);
}  // namespace holdfast::program
