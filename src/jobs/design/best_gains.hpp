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

/// Options of the search for the D of least steady amplitude: an upper limit of the spectral radius
/// and a margin, by default `usual_margin`, or 0 with a given limit. The margin refers to the decay
/// rate for two masses and to the modulus margin for other plants, with or without filter and lag.
AmplitudeOptions amplitude_options_of(const Case& the_case,
                                      std::optional<double> largest_radius = std::nullopt,
                                      std::optional<double> margin = std::nullopt);

/// Search for the D of least steady amplitude with which a motion of duration T settles in T/2: the
/// spectral radius is at most e^{−10 τ/T}, so that transients fall to e^{−5} in T/2.
class BestGains {
 public:
  /// Prepares searches. @param duration  duration T (s) of the motion, > 0
  explicit BestGains(double duration) : duration_(duration) {}

  /// Best D of a two-mass loop; NaN where the outcome says that no D is admissible.
  const MinimumAmplitude& of(const IdealLoop<double>& loop);
  /// Best D of a case's loop, for any plant. On a conductor the motion need not settle within T/2,
  /// because no absorber damps the slowest modes enough.
  MinimumAmplitude of(const Case& the_case) const;

 private:
  double duration_;
  std::optional<IdealLoop<double>> known_;  // loop of the last search
  MinimumAmplitude answer_{};
};

/// Warning that gains chosen without play leave more vibration with the case's play. Two masses are
/// simulated with and without control. Empty if the amplitude ratio is at most 5 % above `ideal`;
/// without play, finite D or force; and for a plant other than two masses.
/// @param gains  P (N/m), D (N s/m)
/// @param ideal  ratio of the amplitude with the gains, without play, to that without control
std::string play_warning(const Case& the_case, const PdGains<double>& gains, double ideal,
                         InstructionSet set);

/// Options of the search for the longest sampling period that attenuates at a frequency (Hz). P is
/// tuned to this frequency by Eq. 6; with a user-defined plant P and always δ/τ are the case's.
MaxDelayOptions tuned_delay_question(const Case& the_case, double frequency);
}  // namespace holdfast::program
