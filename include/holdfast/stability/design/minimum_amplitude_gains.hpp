#pragma once

#include <cmath>

#include "holdfast/core/errors.hpp"
#include "holdfast/core/interval.hpp"
#include "holdfast/core/interval_sets.hpp"
#include "holdfast/stability/boundary/unit_circle_crossings.hpp"
#include "holdfast/stability/design/minimum_amplitude.hpp"
#include "holdfast/stability/design/modal_design.hpp"
#include "holdfast/stability/response/modal_response.hpp"
#include "holdfast/stability/response/response.hpp"

namespace holdfast {

/// The pair of gains of least steady amplitude at one frequency.
struct MinimumAmplitudeGains {
  double proportional_gain;   ///< P (N/m)
  MinimumAmplitude quietest;  ///< the D and its amplitude, or why no pair is admissible
};

namespace detail {

/// The D of least amplitude for a given P, of those with the modulus margin `options.margin`.
template <class Scalar>
MinimumAmplitude quietest_at_modulus(const UnitCircleCrossings<Scalar>& circle, double p,
                                     const AmplitudeOptions& options,
                                     const SteadyResponse<Scalar>& response) {
  auto admissible = ModulusLevels<Scalar>(circle, p).beyond(Scalar(options.margin));
  if (options.largest_radius < 1.0)
    admissible = intersection(
        admissible,
        differential_gains_within_radius(circle.response(), p, Scalar(options.largest_radius)));
  return least_amplitude(response, p, admissible);
}

/// Whether one pair has a smaller amplitude than another.
inline bool is_quieter(const MinimumAmplitude& one, const MinimumAmplitude& other) {
  if (one.outcome == MinimumAmplitudeOutcome::none) return false;
  return other.outcome == MinimumAmplitudeOutcome::none ||
         one.ratio_to_uncontrolled < other.ratio_to_uncontrolled;
}

}  // namespace detail

/// The P and D of least steady amplitude of a loop given by its poles, among the stable pairs with
///
///     min |1 − P G_z − D G_v| ≥ m   over the unit circle, m = `options.margin`
///
/// that is, with a sensitivity of at most 1/m: m = 1/2 gives a gain margin of at least 6 dB upwards
/// and a phase margin of at least 29°.
///
/// For each P the D is exact. P is searched at 65 places of a range that is doubled while the best
/// place is at its end, and by golden section about the best. A better P between two places may be
/// missed: this is a search, not a proof.
/// @param loop       loop of the plant given by its poles, with the sampling of the options
/// @param options    options within their ranges
/// @param frequency  f (Hz), > 0
/// @param range      initial range of P (N/m), lower < upper, finite
/// @param response   steady response at f, as for `minimum_amplitude` of a ModalResponse
/// @throws InvalidParameter where an argument is outside its admissible range
/// Source of the margin: K. J. Åström and R. M. Murray, Feedback Systems (2008), 9.3.
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
  MinimumAmplitudeGains best{std::nan(""), {MinimumAmplitudeOutcome::none}};
  const auto ask = [&](double p) {
    const MinimumAmplitude there = detail::quietest_at_modulus(circle, p, options, response);
    if (detail::is_quieter(there, best.quietest)) best = {p, there};
    return there;
  };
  constexpr int places = 65, most_ranges = 8;
  double step = 0.0;
  for (int k = 0; k < most_ranges; ++k) {
    step = (range.upper - range.lower) / (places - 1);
    for (int i = 0; i < places; ++i) ask(range.lower + i * step);
    if (best.proportional_gain > range.lower + step && best.proportional_gain < range.upper - step)
      break;
    const double half = 0.5 * (range.upper - range.lower);
    range = {range.lower - half, range.upper + half};
  }
  if (best.quietest.outcome == MinimumAmplitudeOutcome::none) return best;
  detail::narrow_to_best(best.proportional_gain - step, best.proportional_gain + step, 40,
                         [&](double left, double right) {
                           const MinimumAmplitude at_left = ask(left);
                           return detail::is_quieter(at_left, ask(right));
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
