#pragma once

#include <optional>
#include <string>

#include "case/case.hpp"
#include "holdfast/control/gains.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/motion/ideal_loop.hpp"
#include "holdfast/stability/design/max_delay.hpp"
#include "holdfast/stability/design/minimum_amplitude.hpp"
#include "holdfast/stability/design/minimum_amplitude_gains.hpp"
#include "holdfast/stability/design/minimum_radius.hpp"
#include "holdfast/stability/response/modal_response.hpp"
#include "kernels/instruction_set.hpp"

namespace holdfast::program {

/// What is best for the plant of a case, whichever it is, one frequency and P after another.
class BestForPlant {
 public:
  /// @param the_case  must outlive this
  BestForPlant(const Case& the_case, const AmplitudeOptions& options);

  /// The D of least steady amplitude at a frequency (Hz) and P.
  MinimumAmplitude quietest(double frequency, double p) const;
  /// The P and D of least steady amplitude at a frequency (Hz), whose modulus margin is that of the
  /// options itself; of a modal case.
  MinimumAmplitudeGains quietest_pair(double frequency) const;
  /// The D of least spectral radius.
  MinimumRadius fastest(double p) const;

 private:
  SteadyResponse<double> modal_steady_response(double frequency) const;

  const Case& case_;
  AmplitudeOptions options_;
  std::optional<SampledLoop<double>> loop_;
  std::optional<ModalResponse<double>> modal_;
};

/// The D of least steady amplitude that has the usual margin and with which a motion settles in the
/// first half of a duration T: its spectral radius is at most e^{−10 τ/T}, so that the transient
/// falls to e^{−5} by then.
class BestGains {
 public:
  /// @param duration  T (s), > 0
  explicit BestGains(double duration) : duration_(duration) {}

  /// Its D is NaN where the outcome says that there is none.
  const MinimumAmplitude& of(const IdealLoop<double>& loop);
  /// Of the plant of a case, whichever it is; of a modal case it need not settle in that time, for
  /// the conductor's slowest modes, which no absorber reaches, do not.
  MinimumAmplitude of(const Case& the_case) const;

 private:
  double duration_;
  std::optional<IdealLoop<double>> known_;  // the last one asked for
  MinimumAmplitude answer_{};
};

/// What the play of a case makes of a gain that was chosen without it: the ratio to the
/// uncontrolled vibration by the motions of both, of two masses; "" where the case has no play or
/// no such gain.
/// @param gains  N/m, N s/m
/// @param ideal  the ratio without play
std::string play_warning(const Case& the_case, const PdGains<double>& gains, double ideal,
                         InstructionSet set);

/// The question which computer is the slowest that attenuates at a frequency (Hz), P being tuned to
/// it by Eq. 6; its processing delay keeps the case's share of the sampling period.
MaxDelayOptions tuned_delay_question(const Case& the_case, double frequency);

/// The answer of the plant of a case, whichever it is.
MaxDelay longest_period_of(const Case& the_case, const MaxDelayOptions& question);

}  // namespace holdfast::program
