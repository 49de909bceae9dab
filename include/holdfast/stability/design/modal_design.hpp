#pragma once

#include <vector>

#include "holdfast/core/errors.hpp"
#include "holdfast/core/interval.hpp"
#include "holdfast/stability/boundary/resolved_circle.hpp"
#include "holdfast/stability/design/minimum_amplitude.hpp"
#include "holdfast/stability/design/minimum_radius.hpp"
#include "holdfast/stability/response/loop_roots.hpp"
#include "holdfast/stability/response/modal_response.hpp"
#include "holdfast/stability/response/response.hpp"

namespace holdfast {

/// The open intervals of D (N s/m) at which every root of a loop has |λ| < radius, by
/// `ResolvedCircle` of G(λ radius).
/// @tparam Scalar            double; a parameter so that nothing is compiled where this is not
///                           called
/// @param response           of the plant by its poles
/// @param proportional_gain  P (N/m), finite
/// @param radius             > 0
/// @return none where the response has no poles
/// @throws InvalidParameter for a P that is not finite
template <class Scalar>
std::vector<Interval<Scalar>> differential_gains_within_radius(
    const ModalResponse<Scalar>& response, const detail::Undeduced<Scalar>& proportional_gain,
    const detail::Undeduced<Scalar>& radius) {
  const auto scaled = response.at_radius(radius - Scalar(1));
  if (!scaled) return {};
  return ResolvedCircle<Scalar>(*scaled).stable_gains(FreeGain::differential,
                                                      {proportional_gain, Scalar(0)});
}

/// min over D of ρ(P, D) of a loop by its poles: as of a `LoopMap`, from the D within each radius,
/// the margin to a millionth of itself.
/// @param response           of the plant by its poles, which it has
/// @param proportional_gain  P (N/m), finite
/// @param start              a D (N s/m) to begin from, finite
/// @throws InvalidParameter for gains that are not finite
template <class Scalar>
MinimumRadius minimum_radius(const ModalResponse<Scalar>& response, double proportional_gain,
                             double start = 0.0) {
  require_finite("proportional gain P", proportional_gain, "N/m");
  require_finite("differential gain D", start, "N s/m");
  const detail::RadiusLevels<ModalResponse<Scalar>> levels{response};
  return detail::MinimumRadiusSearch(levels, proportional_gain, 1e-6).from(start);
}

/// The D of least steady amplitude of a loop by its poles, as `minimum_amplitude` of a plant.
/// @param loop               of the plant by its poles, at the sampling of the options
/// @param options            within their ranges
/// @param frequency          f (Hz), > 0
/// @param proportional_gain  P (N/m), finite
/// @param response           `steady_response` of the same at f, relative to what is wanted; the
///                           options' own wish does not count
/// @throws InvalidParameter outside the admissible ranges
template <class Scalar>
MinimumAmplitude minimum_amplitude(const ModalResponse<Scalar>& loop,
                                   const AmplitudeOptions& options, double frequency,
                                   double proportional_gain,
                                   const SteadyResponse<Scalar>& response) {
  validate(options);
  require_positive("frequency", frequency, "Hz");
  require_finite("proportional gain P", proportional_gain, "N/m");
  return detail::minimum_amplitude_of(loop, options, frequency, proportional_gain,
                                      [&] { return response; });
}

}  // namespace holdfast
