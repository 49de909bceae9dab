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

/// The attenuation −20 log₁₀(ratio) (dB) of an amplitude ratio > 0: 6 dB for 1/2, < 0 above 1.
inline double attenuation(double ratio) { return -20.0 * std::log10(ratio); }

/// Outcome of the search for the differential gain D of least steady amplitude.
enum class MinimumAmplitudeOutcome {
  stationary,  ///< the minimum is inside an interval of admissible D
  edge,        ///< the minimum is at an end of an open interval of admissible D
  none,        ///< no D is admissible; D and the ratio are NaN
  aliased,     ///< the frequency is ≥ 1/(2τ), the Nyquist limit; D and the ratio are NaN
};

/// The options of the search for the differential gain D of least steady amplitude.
struct AmplitudeOptions {
  Sampling<double> sampling;  ///< period τ (s) > 0, delay δ (s) 0 … 1000 τ; for two masses δ ≤ τ
  ForceHold hold = ForceHold::sampled;  ///< whether the excitation force is held over each sample
  /// Upper limit, > 0 and ≤ 1, of the loop's spectral radius ρ with an admissible D. With the limit
  /// 1 the loop must be stable. With a smaller limit r, transients must decay at least as fast as
  /// rʲ, j being the number of samples.
  double largest_radius = 1.0;
  /// The margin m of an admissible D, 0 … 0.999. Let D* be the D of minimum spectral radius ρ. The
  /// distance of an admissible D from each stability boundary, and its decay rate −ln ρ, exceed m
  /// times those of D*. With m = 0 no margin is required; the program's default is 1/2. For a
  /// ModalResponse without `by_decay`, D* is the D of largest modulus margin (modal_design.hpp),
  /// and this margin replaces the decay rate.
  double margin = 0.0;
  /// Whether amplitude ratios refer to the amplitude without control under the true force, which is
  /// not held over samples (`true_amplitude_per_force`). If false, they refer to the amplitude
  /// without control under the force according to `hold` (Kollár 2022, Fig. 5).
  bool relative_to_true_force = false;
  /// Whether, for a ModalResponse too, `margin` takes D* as the D of minimum spectral radius.
  bool by_decay = false;
};

/// The differential gain D of least steady amplitude at one frequency, for a given gain P.
struct MinimumAmplitude {
  MinimumAmplitudeOutcome outcome;          ///< location of the minimum, or why there is none
  double differential_gain = std::nan("");  ///< differential gain D (N s/m)
  /// Ratio of the conductor's steady amplitude with this D to that without control.
  double ratio_to_uncontrolled = std::nan("");
  double attenuation =
      std::nan("");  ///< −20 log₁₀ `ratio_to_uncontrolled` (dB); > 0 for a ratio below 1
};

/// Validates the options. @throws InvalidParameter where a member is outside its stated range
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

/// The open intervals of the differential gain D (N s/m) that the options admit for a given P. Each
/// D in them has a spectral radius ρ(D) < `largest_radius` and, for a margin m > 0, satisfies
///
///     ρ(D) < ρ_min^m  and  D = D* + (1 − m)(D_s − D*)
///
/// D* is the D of minimum radius ρ_min, and D_s is some D in the stable interval around D*. For
/// m > 0 and ρ_min ≥ 1 no D is admissible. For a ModalResponse see modal_design.hpp.
/// @param loop               loop from `sampled_loop` or `loop_map`
/// @param proportional_gain  P (N/m), finite
/// @param options            options within their ranges, which are not checked here
template <class Loop>
std::vector<Interval<double>> admissible_differential_gains(const Loop& loop,
                                                            double proportional_gain,
                                                            const AmplitudeOptions& options) {
  return detail::gains_that_decay(loop, proportional_gain, options);
}

namespace detail {

/// The D of least steady amplitude in given intervals (N s/m); outcome `none` without a finite D.
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
/// No grid of D is needed: the admissible D are computed as intervals, and the squared amplitude is
/// a quotient of two quadratics in D (`SteadyResponse::best_differential_gain`).
/// @tparam Plant             two masses (closed form), or a plant of any order with `Ports`
/// @param plant              plant within its ranges
/// @param options            τ, δ, the hold of the force and the limits of admissible D
/// @param frequency          excitation frequency f (Hz), > 0
/// @param proportional_gain  P (N/m), finite; `tuned_proportional_gain` gives the P tuned to f
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
