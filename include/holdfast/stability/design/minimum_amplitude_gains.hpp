#pragma once

#include <cmath>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

#include "holdfast/core/errors.hpp"
#include "holdfast/core/interval.hpp"
#include "holdfast/core/interval_sets.hpp"
#include "holdfast/math/roots/bracketing_root.hpp"
#include "holdfast/stability/boundary/unit_circle_crossings.hpp"
#include "holdfast/stability/design/minimum_amplitude.hpp"
#include "holdfast/stability/design/modal_design.hpp"
#include "holdfast/stability/response/modal_response.hpp"
#include "holdfast/stability/response/response.hpp"

namespace holdfast {

/// The pair of gains (P, D) of least steady amplitude at one frequency.
struct MinimumAmplitudeGains {
  double proportional_gain;   ///< proportional gain P (N/m); NaN without an admissible pair
  MinimumAmplitude quietest;  ///< D and its amplitude ratio, or the reason why there is no pair
};

namespace detail {

/// The intervals of D that satisfy the options' modulus margin and largest radius, for a given P.
/// @param nearby  series of the circle for ModulusLevels
template <class Scalar>
std::vector<Interval<Scalar>> gains_of_modulus(const UnitCircleCrossings<Scalar>& circle, double p,
                                               const AmplitudeOptions& options,
                                               typename ModulusLevels<Scalar>::Series& nearby) {
  const auto admissible = ModulusLevels<Scalar>(circle, p, nearby).beyond(Scalar(options.margin));
  if (!(options.largest_radius < 1.0)) return admissible;
  return intersection(admissible, differential_gains_within_radius(circle.response(), p,
                                                                   Scalar(options.largest_radius)));
}

/// Minimises a function of P: first at 65 values of P in a range, which is doubled while the best P
/// is at its end, then by golden section around the best P. A better P in between may be missed.
/// @param range     initial range of P (N/m), lower < upper, finite
/// @param value_at  P ↦ value to be minimised; ∞ where P is not admissible
template <class Value>
void search_proportional_gain(Interval<double> range, const Value& value_at) {
  constexpr int places = 65, most_ranges = 8;
  double step = 0.0, best = std::numeric_limits<double>::infinity(), best_p = range.lower;
  for (int k = 0; k < most_ranges; ++k) {
    step = (range.upper - range.lower) / (places - 1);
    for (int i = 0; i < places; ++i) {
      const double p = range.lower + i * step, value = value_at(p);
      if (value < best) std::tie(best, best_p) = std::pair(value, p);
    }
    if (best_p > range.lower + step && best_p < range.upper - step) break;
    const double half = 0.5 * (range.upper - range.lower);
    range = {range.lower - half, range.upper + half};
  }
  if (std::isinf(best)) return;
  narrow_to_minimum(best_p - step, best_p + step, 40, value_at);
}

}  // namespace detail

/// The P and D of least steady amplitude of a loop given by its poles, among the stable pairs with
///
///     min |1 − P G_z − D G_v| ≥ m   over the unit circle, m = `options.margin`
///
/// and with ρ < `largest_radius` (ρ: spectral radius). G_z and G_v are the transfer functions from
/// the command to the readings. The sensitivity is at most 1/m: m = 1/2 gives a gain margin of at
/// least 6 dB upwards and a phase margin of at least 29°. Source of this modulus margin: K. J.
/// Åström and R. M. Murray, Feedback Systems (2008), 9.3.
///
/// For each P the best D is computed exactly. P is varied over a grid, then by golden section; a
/// better P between grid points may be missed.
/// @param loop       loop of the plant given by its poles, with the sampling of the options
/// @param options    options within their ranges; only those named here are used
/// @param frequency  excitation frequency f (Hz), > 0
/// @param range      initial range of P (N/m), lower < upper, finite; extended where needed
/// @param response   `steady_response` of the loop at f, with the reference amplitude of the ratio
/// @throws InvalidParameter where an argument is outside its admissible range
template <class Scalar>
MinimumAmplitudeGains minimum_amplitude_gains(const ModalResponse<Scalar>& loop,
                                              const AmplitudeOptions& options, double frequency,
                                              Interval<double> range,
                                              const SteadyResponse<Scalar>& response) {
  validate(options);
  require_positive("frequency", frequency, "Hz");
  require_positive("width of the range of P", range.upper - range.lower, "N/m");
  if (!(2.0 * frequency * options.sampling.period < 1.0))
    return {std::nan(""), {MinimumAmplitudeOutcome::aliased}};
  const UnitCircleCrossings<Scalar> circle(loop);
  typename detail::ModulusLevels<Scalar>::Series nearby;
  MinimumAmplitudeGains best{std::nan(""), {MinimumAmplitudeOutcome::none}};
  detail::search_proportional_gain(range, [&](double p) {
    const MinimumAmplitude there =
        detail::least_amplitude(response, p, detail::gains_of_modulus(circle, p, options, nearby));
    if (there.outcome == MinimumAmplitudeOutcome::none)
      return std::numeric_limits<double>::infinity();
    if (best.quietest.outcome == MinimumAmplitudeOutcome::none ||
        there.ratio_to_uncontrolled < best.quietest.ratio_to_uncontrolled)
      best = {p, there};
    return there.ratio_to_uncontrolled;
  });
  return best;
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template MinimumAmplitudeGains minimum_amplitude_gains(const ModalResponse<double>&,
                                                              const AmplitudeOptions&, double,
                                                              Interval<double>,
                                                              const SteadyResponse<double>&);
#endif

}  // namespace holdfast
