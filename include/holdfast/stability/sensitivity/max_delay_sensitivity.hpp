#pragma once

#include <cmath>
#include <limits>

#include "holdfast/control/gains.hpp"
#include "holdfast/stability/design/delay_options.hpp"
#include "holdfast/stability/design/max_delay.hpp"
#include "holdfast/stability/sensitivity/amplitude_sensitivity.hpp"
#include "holdfast/stability/sensitivity/minimum_radius_sensitivity.hpp"
#include "holdfast/stability/sensitivity/sensitivity.hpp"

namespace holdfast {

/// How the largest sampling period answers to the loop.
struct MaxDelaySensitivity {
  LoopSensitivity sampling_period;  ///< of τ*; its entries by τ, δ and D are 0
  double by_delay_fraction;  ///< ∂τ*/∂φ, φ = δ/τ (s); one-sided at φ = 0 and φ = 1
};

namespace detail {

/// The gradient of what is zero at τ*: 1 − min ρ where stability limits it, 1 less the minimum
/// amplitude ratio where attenuation does; NaN where it has none.
template <class Scalar>
Entries reserve_gradient(const TwoMass<Scalar>& plant, const MaxDelayOptions& options,
                         const MaxDelay& answer) {
  const auto sampling = options.sampling(answer.sampling_period);
  const double p = options.proportional_gain;
  if (answer.limit == MaxDelayLimit::attenuation)
    return amplitude_sensitivity(plant,
                                 {sampling, options.hold, 1.0, 0.0, options.relative_to_true_force},
                                 options.frequency, p)
        .ratio.entries;
  const auto least = minimum_radius_sensitivity(plant, sampling, {p, answer.differential_gain});
  if (least.kind == MinimumRadiusKind::fixed)
    return Entries::Constant(std::numeric_limits<double>::quiet_NaN());
  return least.radius.entries;
}

}  // namespace detail

/// The sensitivity of the largest sampling period τ*, the delay keeping its fraction φ of it and P
/// its value.
///
/// With the quantity G that is zero at τ* (`detail::reserve_gradient`),
///
///     ∂τ*/∂x = −G_x/(G_τ + φ G_δ),   ∂τ*/∂φ = −τ* G_δ/(G_τ + φ G_δ)
///
/// Where τ* = 1/(2f) no parameter moves it.
/// @param plant     m, k and c of both masses, within their ranges
/// @param options   the one that `answer` belongs to
/// @param answer    of `max_sampling_period` to the same question
/// @return zeros where `answer` is not `found`; NaN where the minimum radius at τ* has no
///         sensitivity
/// (`MinimumRadiusKind::fixed`)
/// @throws InvalidParameter outside the admissible ranges
template <class Scalar>
MaxDelaySensitivity max_delay_sensitivity(const TwoMass<Scalar>& plant,
                                          const MaxDelayOptions& options, const MaxDelay& answer) {
  validate(plant);
  validate(options);
  const bool moves = answer.outcome == MaxDelayOutcome::found &&
                     answer.limit != MaxDelayLimit::nyquist &&
                     std::isfinite(answer.differential_gain);
  if (!moves) return {{}, 0.0};
  const auto g = detail::reserve_gradient(plant, options, answer);
  const double by_delay = g[detail::by_delay];
  const double along = g[detail::by_period] + options.delay_fraction * by_delay;
  detail::Entries result = -g / along;
  result[detail::by_period] = result[detail::by_delay] = result[detail::by_d] = 0.0;
  return {{result}, -answer.sampling_period * by_delay / along};
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template MaxDelaySensitivity max_delay_sensitivity(const TwoMass<double>&,
                                                          const MaxDelayOptions&, const MaxDelay&);
#endif

}  // namespace holdfast
