#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "holdfast/control/loop_input.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/core/interval.hpp"
#include "holdfast/core/interval_sets.hpp"
#include "holdfast/plant/linear_plant.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "holdfast/stability/design/minimum_radius.hpp"
#include "holdfast/stability/margins/loop_form.hpp"
#include "holdfast/stability/polynomial/loop_polynomial.hpp"
#include "holdfast/stability/response/response.hpp"

namespace holdfast {

/// The attenuation −20 log₁₀ of an amplitude ratio (dB): 6 for 1/2, negative for a ratio above 1.
inline double attenuation(double ratio) { return -20.0 * std::log10(ratio); }

/// Location of the differential gain D of minimum amplitude.
enum class MinimumAmplitudeOutcome {
  stationary,  ///< at a D inside the admissible intervals
  edge,        ///< at the edge of the admissible intervals: a limit of admissible D
  none,        ///< no D is admissible; D and the ratio are NaN
  aliased,     ///< frequency ≥ 1/(2τ): the samples do not resolve it; D and the ratio are NaN
};

/// The options of the search for the D of least steady amplitude.
struct AmplitudeOptions {
  Sampling<double> sampling;  ///< period τ (s) > 0, delay δ (s) 0 … 1000 τ; for two masses δ ≤ τ
  ForceHold hold = ForceHold::sampled;  ///< hold of the excitation over a sample
  /// Upper limit of the spectral radius with an admissible D, > 0 and ≤ 1. With 1 the loop must be
  /// stable; with less, its transients must decay at least like largest_radiusʲ in j samples.
  double largest_radius = 1.0;
  /// The margin m, 0 … 0.999, relative to D*, the D of minimum spectral radius ρ. For an admissible
  /// D, the distance from either stability boundary and the decay rate −ln ρ exceed m times those
  /// of D*. m = 0 admits the boundary as a limit; the default of the program is 1/2. For a
  /// ModalResponse, unless `by_decay`, D* is the D of largest modulus margin (see
  /// modal_design.hpp), and the modulus margin replaces the decay rate.
  double margin = 0.0;
  /// Whether ratios refer to the plant without control under the true force
  /// (`true_amplitude_per_force`). If not, the reference is the plant without control under the
  /// force held as with control (Kollár 2022, Fig. 5).
  bool relative_to_true_force = false;
  /// Whether D* of `margin` is the D of minimum spectral radius for a ModalResponse too.
  bool by_decay = false;
};

/// The differential gain D of least steady amplitude at one frequency, for a given gain P.
struct MinimumAmplitude {
  MinimumAmplitudeOutcome outcome;          ///< location of the minimum, or why there is none
  double differential_gain = std::nan("");  ///< differential gain D (N s/m)
  /// The conductor's amplitude with this D over the amplitude without control.
  double ratio_to_uncontrolled = std::nan("");
  double attenuation =
      std::nan("");  ///< −20 log₁₀ `ratio_to_uncontrolled` (dB), > 0 where control helps
};

/// Validates the options. @throws InvalidParameter outside the ranges stated at their members
inline void validate(const AmplitudeOptions& options) {
  const Sampling<double>& sampling = options.sampling;
  require_positive("sampling period tau", sampling.period, "s");
  require_within("processing delay", sampling.processing_delay, "s", 0.0, 1000.0 * sampling.period);
  require_positive("largest spectral radius", options.largest_radius, "");
  require_within("largest spectral radius", options.largest_radius, "", 0.0, 1.0);
  require_within("margin", options.margin, "", 0.0, 1.0 - 1e-3);
}

namespace detail {

/// The interval that contains `from`, shrunk about this point by a factor `share`; or none.
template <class Scalar>
std::vector<Interval<Scalar>> within_share(const std::vector<Interval<Scalar>>& intervals,
                                           const Scalar& from, const Scalar& share) {
  for (const Interval<Scalar>& interval : intervals)
    if (interval.contains(from))
      return {{from + share * (interval.lower - from), from + share * (interval.upper - from)}};
  return {};
}

/// The admissible intervals of D of any loop, with a margin relative to the fastest decay.
template <class Loop>
std::vector<Interval<double>> gains_that_decay(const Loop& loop, double proportional_gain,
                                               const AmplitudeOptions& options) {
  const auto within = [&](double radius) {
    return differential_gains_within_radius(loop, proportional_gain, radius);
  };
  if (!(options.margin > 0.0)) return within(options.largest_radius);
  const MinimumRadius fastest = minimum_radius(loop, proportional_gain);
  if (!(fastest.margin > 0.0)) return {};
  const auto away = within_share(within(1.0), fastest.differential_gain, 1.0 - options.margin);
  const double radius = std::exp(options.margin * std::log1p(-fastest.margin));
  return intersection(away, within(std::min(radius, options.largest_radius)));
}

}  // namespace detail

/// The open intervals of D (N s/m) that the options admit for one P. In them the spectral radius ρ
/// is below `largest_radius` and, for a margin m > 0,
///
///     ρ(D) < ρ_min^m  and  D = D* + (1 − m)(D_s − D*)
///
/// where D* has the minimum radius ρ_min and D_s is any D in the stable interval around D*. A
/// stable D* is admitted if ρ_min < `largest_radius`. For a ModalResponse see modal_design.hpp.
/// @param loop               loop of `sampled_loop` or `loop_map`
/// @param proportional_gain  P (N/m), finite
/// @param options            options within their ranges, which are not checked here
template <class Loop>
std::vector<Interval<double>> admissible_differential_gains(const Loop& loop,
                                                            double proportional_gain,
                                                            const AmplitudeOptions& options) {
  return detail::gains_that_decay(loop, proportional_gain, options);
}

namespace detail {

/// The D of least steady amplitude in given intervals; outcome `none` without a finite D.
/// @param admissible  intervals of D (N s/m); may be empty
template <class Scalar>
MinimumAmplitude least_amplitude(const SteadyResponse<Scalar>& response, double proportional_gain,
                                 const std::vector<Interval<double>>& admissible) {
  const auto best = response.best_differential_gain(proportional_gain, admissible);
  if (!std::isfinite(best.differential_gain)) return {MinimumAmplitudeOutcome::none};
  const bool inside = contains_any(admissible, best.differential_gain);
  return {inside ? MinimumAmplitudeOutcome::stationary : MinimumAmplitudeOutcome::edge,
          best.differential_gain, best.ratio_to_uncontrolled,
          holdfast::attenuation(best.ratio_to_uncontrolled)};
}

/// The D of least steady amplitude of a loop, among the admissible D.
/// @param response_at  () → SteadyResponse at the frequency, called only if a D is admissible
template <class Loop, class ResponseAt>
MinimumAmplitude minimum_amplitude_of(const Loop& loop, const AmplitudeOptions& options,
                                      double frequency, double proportional_gain,
                                      const ResponseAt& response_at) {
  if (!(2.0 * frequency * options.sampling.period < 1.0)) return {MinimumAmplitudeOutcome::aliased};
  const auto admissible = admissible_differential_gains(loop, proportional_gain, options);
  if (admissible.empty()) return {MinimumAmplitudeOutcome::none};
  return least_amplitude(response_at(), proportional_gain, admissible);
}

}  // namespace detail

/// The differential gain D of least steady amplitude at one frequency, among the admissible D.
///
/// No grid of D is needed: the admissible D are computed as intervals, and over them the squared
/// amplitude is a quotient of two quadratics (`SteadyResponse::best_differential_gain`).
/// @tparam Plant             two masses, in closed form, or a plant of any order with ports;
///                           `validate` checks it
/// @param plant              plant within its ranges
/// @param options            τ, δ, the hold of the force and the limits of admissible D
/// @param frequency          f (Hz), > 0
/// @param proportional_gain  P (N/m), finite; `tuned_proportional_gain` tunes it to f
/// @throws InvalidParameter where an argument is outside its admissible range
template <class Plant>
MinimumAmplitude minimum_amplitude(const Plant& plant, const AmplitudeOptions& options,
                                   double frequency, double proportional_gain) {
  validate(plant);
  validate(options);
  require_positive("frequency", frequency, "Hz");
  require_finite("proportional gain P", proportional_gain, "N/m");
  const auto loop = detail::loop_of(plant, options.sampling);
  return detail::minimum_amplitude_of(loop, options, frequency, proportional_gain, [&] {
    return detail::response_of_loop(plant, loop, options.hold, 2.0 * pi<double> * frequency,
                                    options.relative_to_true_force);
  });
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template MinimumAmplitude minimum_amplitude(const TwoMass<double>&, const AmplitudeOptions&,
                                                   double, double);
extern template MinimumAmplitude minimum_amplitude(const LinearPlant<double>&,
                                                   const AmplitudeOptions&, double, double);
#endif

}  // namespace holdfast
