#pragma once

#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>

#include "holdfast/control/loop_input.hpp"
#include "holdfast/stability/design/minimum_amplitude.hpp"
#include "holdfast/stability/response/moving_response.hpp"
#include "holdfast/stability/response/response.hpp"
#include "holdfast/stability/sensitivity/sensitivity.hpp"

namespace holdfast {

/// How the minimum amplitude ratio over D at a fixed P, and its D, answer to the loop.
struct AmplitudeSensitivity {
  MinimumAmplitudeOutcome outcome;    ///< of the minimum amplitude; NaN below where it has no D
  LoopSensitivity ratio;              ///< of the minimum amplitude over that without control
  LoopSensitivity differential_gain;  ///< of the D (N s/m) that has it
};

namespace detail {

/// The rates of `squared_modulus`.
template <class Scalar>
Vector<Scalar, 3> squared_modulus_rates(const std::complex<Scalar>& a,
                                        const std::complex<Scalar>& b,
                                        const std::complex<Scalar>& a_rate,
                                        const std::complex<Scalar>& b_rate) {
  return {2.0 * (std::conj(a) * a_rate).real(),
          2.0 * (std::conj(a_rate) * b + std::conj(a) * b_rate).real(),
          2.0 * (std::conj(b) * b_rate).real()};
}

/// The phasor without control whose modulus ratios are relative to, and its rates by all parameters
/// but D.
template <class Scalar>
struct RatioReference {
  std::complex<Scalar> phasor;
  std::array<std::complex<Scalar>, by_d> rates{};
};

/// The rates of `SteadyResponse::squared_ratio` of the two masses, from those of the phasors, of
/// the reference and of P.
template <class Scalar>
RatioOfQuadratics<Scalar> squared_ratio_rates(const LoopPhasors<Scalar>& phasors,
                                              const LoopPhasors<Scalar>& rates,
                                              const std::complex<Scalar>& reference,
                                              const std::complex<Scalar>& reference_rate,
                                              const Scalar& p, const Scalar& p_rate) {
  using Complex = std::complex<Scalar>;
  const auto& [t1, t2, f1, f2, t, f] = phasors;
  const auto& [t1_rate, t2_rate, f1_rate, f2_rate, t_rate, f_rate] = rates;
  const Complex slope_rate = t1_rate * f2 + t1 * f2_rate - t2_rate * f1 - t2 * f1_rate;
  const Complex below = 1.0 - p * t1, below_rate = -p * t1_rate - p_rate * t1;
  return {squared_modulus_rates(f1, phasors.differential_slope(), f1_rate, slope_rate),
          2.0 * (std::conj(reference) * reference_rate).real() * squared_modulus(below, -t2) +
              std::norm(reference) * squared_modulus_rates(below, -t2, below_rate, -t2_rate)};
}

/// The rates of the phasors by all parameters but D.
/// @param response  `MovingResponse` of the loop, the input and ω
template <class Scalar, class Response>
std::array<LoopPhasors<Scalar>, by_d> phasor_derivatives(
    const TwoMass<Scalar>& plant, const SampledLoop<Scalar>& loop, ForceHold hold,
    const HarmonicInput<Scalar>& input, const Response& response, const Scalar& omega) {
  std::array<LoopPhasors<Scalar>, by_d> result;
  const auto rates = loop_derivatives(plant, loop);
  const auto by_plant = plant_derivatives(plant);
  for (std::size_t i = 0; i < result.size(); ++i) {
    HarmonicInput<Scalar> input_rate{rates[i].held_excitation, Vector<Scalar, 4>::Zero()};
    if (i == by_period) {
      input_rate = input_derivative_by_period(plant, loop, hold, input, omega);
    } else if (i < by_plant.size() && hold == ForceHold::exact) {
      const auto exact = exact_harmonic(by_plant[i], loop.sampling.period, omega);
      input_rate = {exact.cosine.template head<4>(), exact.sine.template head<4>()};
    }
    result[i] = response.along(rates[i], input_rate, i == by_period ? 1.0 : 0.0);
  }
  return result;
}

/// The plant without control under the held force, or under the true one, which neither sampling
/// nor gains move.
template <class Scalar>
RatioReference<Scalar> ratio_reference(const TwoMass<Scalar>& plant,
                                       const LoopPhasors<Scalar>& phasors,
                                       const std::array<LoopPhasors<Scalar>, by_d>& rates,
                                       const Scalar& omega, bool relative_to_true_force) {
  RatioReference<Scalar> reference{phasors.force_conductor};
  for (std::size_t i = 0; i < rates.size(); ++i) reference.rates[i] = rates[i].force_conductor;
  if (!relative_to_true_force) return reference;
  const auto loop = sampled_loop(plant, Sampling<Scalar>{pi<Scalar> / (Scalar(4) * omega)});
  const auto input = harmonic_input(plant, loop, ForceHold::exact, omega);
  const MovingResponse<SampledLoop<Scalar>> response(loop, input, omega);
  const auto moved = phasor_derivatives(plant, loop, ForceHold::exact, input, response, omega);
  reference = {response.phasors().force_conductor};
  for (std::size_t i = 0; i < plant_derivatives(plant).size(); ++i)
    reference.rates[i] = moved[i].force_conductor;
  return reference;
}

/// ∂ of the ratio at a held D, and of the stationary D, by all parameters.
struct RatioEntries {
  Entries ratio = Entries::Zero();       ///< last entry: by D
  Entries stationary = Entries::Zero();  ///< of the D at which the ratio is stationary
};

/// @param rates  of the phasors
/// @param p, d   the gains
template <class Scalar>
RatioEntries ratio_entries(const LoopPhasors<Scalar>& phasors,
                           const std::array<LoopPhasors<Scalar>, by_d>& rates,
                           const RatioReference<Scalar>& reference, const Scalar& p,
                           const Scalar& d) {
  using Ratio = RatioOfQuadratics<Scalar>;
  const Ratio square =
      SteadyResponse<Scalar>(phasors).relative_to(std::abs(reference.phasor)).squared_ratio(p);
  const Scalar n = evaluate(square.numerator, d), m = evaluate(square.denominator, d);
  const Scalar ratio = std::sqrt(n / m);
  const Vector<Scalar, 3> s = square.slope_numerator();
  const Scalar s_slope = s[1] + 2.0 * s[2] * d;
  RatioEntries entries;
  for (int i = 0; i < by_d; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Ratio change = squared_ratio_rates(phasors, rates[k], reference.phasor,
                                             reference.rates[k], p, i == by_p ? 1.0 : 0.0);
    entries.ratio[i] =
        0.5 * ratio * (evaluate(change.numerator, d) / n - evaluate(change.denominator, d) / m);
    const Vector<Scalar, 3> s_rate = Ratio{change.numerator, square.denominator}.slope_numerator() +
                                     Ratio{square.numerator, change.denominator}.slope_numerator();
    entries.stationary[i] = -evaluate(s_rate, d) / s_slope;
  }
  entries.ratio[by_d] = 0.5 * ratio * evaluate(s, d) / (n * m);
  return entries;
}

}  // namespace detail

/// The sensitivity of `minimum_amplitude`: of the minimum amplitude ratio over the admissible D at
/// a fixed P, and of its D; by D itself the entries are 0.
///
/// At a stationary D the ratio moves as at a held D (its slope by D is zero) and D follows the root
/// of the slope's numerator, a quadratic in D. At the edge D follows the boundary
/// (`boundary_gain_sensitivity`) and takes the ratio with it.
/// @param plant              m, k and c of both masses, within their ranges
/// @param options            τ, δ, the hold of the force and the largest spectral radius admitted
/// @param frequency          f (Hz), > 0; held, so that a P tuned to it moves with k₂ and m₂ only
///                           (`with_tuned_gain`)
/// @param proportional_gain  P (N/m), finite
/// @throws InvalidParameter outside the admissible ranges
template <class Scalar>
AmplitudeSensitivity amplitude_sensitivity(const TwoMass<Scalar>& plant,
                                           const AmplitudeOptions& options, double frequency,
                                           double proportional_gain) {
  const auto least = minimum_amplitude(plant, options, frequency, proportional_gain);
  if (!std::isfinite(least.differential_gain)) {
    const LoopSensitivity none{detail::Entries::Constant(std::numeric_limits<double>::quiet_NaN())};
    return {least.outcome, none, none};
  }
  const double omega = 2.0 * pi<double> * frequency, d = least.differential_gain;
  const auto loop = sampled_loop(plant, options.sampling);
  const auto input = harmonic_input(plant, loop, options.hold, omega);
  const MovingResponse<SampledLoop<double>> response(loop, input, omega);
  const auto phasors = response.phasors();
  const auto rates = detail::phasor_derivatives(plant, loop, options.hold, input, response, omega);
  auto [ratio, gain] = detail::ratio_entries(
      phasors, rates,
      detail::ratio_reference(plant, phasors, rates, omega, options.relative_to_true_force),
      proportional_gain, d);
  if (least.outcome == MinimumAmplitudeOutcome::edge) {
    gain = boundary_gain_sensitivity(plant, options.sampling, {proportional_gain, d},
                                     FreeGain::differential, options.largest_radius)
               .entries;
    ratio += ratio[detail::by_d] * gain;
  }
  ratio[detail::by_d] = 0.0;
  return {least.outcome, {ratio}, {gain}};
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template AmplitudeSensitivity amplitude_sensitivity(const TwoMass<double>&,
                                                           const AmplitudeOptions&, double, double);
#endif

}  // namespace holdfast
