#pragma once

#include <cmath>
#include <limits>

#include "holdfast/control/harmonic_input.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/plant/two_dof.hpp"
#include "holdfast/stability/characteristic_polynomial.hpp"
#include "holdfast/stability/least_radius.hpp"
#include "holdfast/stability/response.hpp"
#include "holdfast/stability/stable_intervals.hpp"

namespace holdfast {

/// Which D to use against an excitation of one frequency, at a given P.
struct DesignQuestion {
  double frequency;          ///< f (Hz), > 0
  double proportional_gain;  ///< P (N/m), finite; Eq. (6) tunes it to f
  ForceHold hold = ForceHold::sampled;
};

/// Two answers: the D that leaves the least vibration, and the D that forgets a disturbance
/// fastest.
struct Design {
  double least_amplitude_gain;   ///< D (N s/m); NaN where no D stabilises
  double ratio_to_uncontrolled;  ///< the amplitude it leaves over that of no control; NaN likewise
  double attenuation;        ///< −20 log₁₀ of that ratio (dB), positive where control helps
  double least_radius_gain;  ///< D (N s/m)
  double least_radius;       ///< its spectral radius; stable ⇔ below 1
};

/// Both over all D, not by scanning: the least amplitude over the exact stable intervals
/// (`SteadyResponse::best_differential_gain`; it may be the limit of stable gains), the least
/// radius by `least_radius`.
/// @throws InvalidParameter for a plant, sampling or question outside the ranges stated
inline Design design(const TwoDof<double>& plant, const Sampling<double>& sampling,
                     const DesignQuestion& question) {
  validate(plant);
  validate(sampling);
  require_positive("frequency", question.frequency, "Hz");
  require_finite("proportional gain P", question.proportional_gain, "N/m");
  const auto loop = sampled_loop(plant, sampling);
  const double omega = 2.0 * pi<double> * question.frequency;
  const SteadyResponse<double> response(loop, harmonic_input(plant, loop, question.hold, omega),
                                        omega);
  const auto best = response.best_differential_gain(
      question.proportional_gain,
      stable_differential_gains(characteristic_polynomial(loop), question.proportional_gain));
  const LeastRadius least = least_radius(loop, question.proportional_gain);
  const bool found = std::isfinite(best.differential_gain);
  const double ratio =
      found ? best.ratio_to_uncontrolled : std::numeric_limits<double>::quiet_NaN();
  return {best.differential_gain, ratio, -20.0 * std::log10(ratio), least.differential_gain,
          least.radius};
}

}  // namespace holdfast
