#pragma once

#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>

#include "holdfast/control/loop_input.hpp"
#include "holdfast/stability/design/minimum_amplitude.hpp"
#include "holdfast/stability/response/response.hpp"
#include "holdfast/stability/response/response_derivatives.hpp"
#include "holdfast/stability/sensitivity/sensitivity.hpp"

namespace holdfast {

/// How the minimum amplitude ratio over D at a fixed P, and its D, answer to the loop.
struct AmplitudeSensitivity {
  MinimumAmplitudeOutcome outcome;    ///< of the minimum amplitude; NaN below where it has no D
  LoopSensitivity ratio;              ///< of the minimum amplitude over that without control
  LoopSensitivity differential_gain;  ///< of the D (N s/m) that has it
};

namespace detail {

/// The squared amplitude ratio N(D)/M(D) and how its coefficients move.
template <class Scalar>
class MovingRatio {
 public:
  using Complex = std::complex<Scalar>;

  MovingRatio(const ResponsePhasors<Scalar>& phasors, const Scalar& proportional_gain)
      : phasors_(phasors), proportional_gain_(proportional_gain) {
    slope_ = phasors.numerator_slope();
    below_ = 1.0 - proportional_gain * phasors.control_displacement;
    ratio_ = {
        squared_modulus(phasors.force_displacement, slope_),
        std::norm(phasors.force_displacement) * squared_modulus(below_, -phasors.control_velocity)};
  }

  const RatioOfQuadratics<Scalar>& ratio() const { return ratio_; }

  /// The rates of both quadratics' coefficients, from the phasors' rates and that of P.
  RatioOfQuadratics<Scalar> rate(const ResponsePhasors<Scalar>& rates,
                                 const Scalar& proportional_rate) const {
    const auto& [t1, t2, f1, f2] = phasors_;
    const auto& [t1_rate, t2_rate, f1_rate, f2_rate] = rates;
    const Complex slope_rate = t1_rate * f2 + t1 * f2_rate - t2_rate * f1 - t2 * f1_rate;
    const Complex below_rate = -proportional_gain_ * t1_rate - proportional_rate * t1;
    return {square_rates(f1, slope_, f1_rate, slope_rate),
            2.0 * (std::conj(f1) * f1_rate).real() * squared_modulus(below_, -t2) +
                std::norm(f1) * square_rates(below_, -t2, below_rate, -t2_rate)};
  }

 private:
  /// The rates of `squared_modulus`.
  static Vector<Scalar, 3> square_rates(const Complex& a, const Complex& b, const Complex& a_rate,
                                        const Complex& b_rate) {
    return {2.0 * (std::conj(a) * a_rate).real(),
            2.0 * (std::conj(a_rate) * b + std::conj(a) * b_rate).real(),
            2.0 * (std::conj(b) * b_rate).real()};
  }

  ResponsePhasors<Scalar> phasors_;
  Scalar proportional_gain_;
  Complex slope_, below_;
  RatioOfQuadratics<Scalar> ratio_;
};

/// The rates of the phasors by the carried parameters.
/// @param response  `ResponseDerivatives` of the loop, the input and ω
template <class Scalar, class Response>
std::array<ResponsePhasors<Scalar>, carried_parameters> phasor_derivatives(
    const TwoMass<Scalar>& plant, const SampledLoop<Scalar>& loop, ForceHold hold,
    const HarmonicInput<Scalar>& input, const Response& response, const Scalar& omega) {
  std::array<ResponsePhasors<Scalar>, carried_parameters> result;
  const auto rates = loop_derivatives(plant, loop);
  const auto by_plant = plant_derivatives(plant);
  for (std::size_t i = 0; i < result.size(); ++i) {
    HarmonicInput<Scalar> input_rate{rates[i].held_excitation, Vector<Scalar, 4>::Zero()};
    if (i == 6) {
      input_rate = input_derivative_by_period(plant, loop, hold, input, omega);
    } else if (i < 6 && hold == ForceHold::exact) {
      input_rate = exact_input_derivative_by_plant(plant, by_plant[i], loop.sampling.period, omega);
    }
    result[i] = response.along(rates[i], input_rate, i == 6 ? 1.0 : 0.0);
  }
  return result;
}

/// ∂ of the ratio at a held D, and of the stationary D, by all parameters.
template <class Scalar>
struct RatioEntries {
  Vector<Scalar, loop_parameters> ratio;       ///< entry 9: by D
  Vector<Scalar, loop_parameters> stationary;  ///< of the D at which the ratio is stationary
};

template <class Scalar>
RatioEntries<Scalar> ratio_entries(
    const MovingRatio<Scalar>& moving,
    const std::array<ResponsePhasors<Scalar>, carried_parameters>& rates, const Scalar& d) {
  const RatioOfQuadratics<Scalar>& square = moving.ratio();
  const Scalar n = evaluate(square.numerator, d), m = evaluate(square.denominator, d);
  const Scalar ratio = std::sqrt(n / m);
  const Vector<Scalar, 3> s = square.slope_numerator();
  const Scalar s_slope = s[1] + 2.0 * s[2] * d;
  RatioEntries<Scalar> entries{Vector<Scalar, loop_parameters>::Zero(),
                               Vector<Scalar, loop_parameters>::Zero()};
  for (int i = 0; i < 9; ++i) {
    const auto change = i < carried_parameters
                            ? moving.rate(rates[static_cast<std::size_t>(i)], 0.0)
                            : moving.rate({}, 1.0);
    entries.ratio[i] =
        0.5 * ratio * (evaluate(change.numerator, d) / n - evaluate(change.denominator, d) / m);
    const Vector<Scalar, 3> s_rate =
        RatioOfQuadratics<Scalar>{change.numerator, square.denominator}.slope_numerator() +
        RatioOfQuadratics<Scalar>{square.numerator, change.denominator}.slope_numerator();
    entries.stationary[i] = -evaluate(s_rate, d) / s_slope;
  }
  entries.ratio[9] = 0.5 * ratio * evaluate(s, d) / (n * m);
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
    const auto none = sensitivity_of(
        Vector<Scalar, loop_parameters>::Constant(std::numeric_limits<Scalar>::quiet_NaN()));
    return {least.outcome, none, none};
  }
  const double omega = 2.0 * pi<double> * frequency, d = least.differential_gain;
  const auto loop = sampled_loop(plant, options.sampling);
  const auto input = harmonic_input(plant, loop, options.hold, omega);
  const ResponseDerivatives response(loop, input, omega);
  auto [ratio, gain] = detail::ratio_entries(
      detail::MovingRatio<Scalar>(response.phasors(), proportional_gain),
      detail::phasor_derivatives(plant, loop, options.hold, input, response, omega), d);
  if (least.outcome == MinimumAmplitudeOutcome::edge) {
    gain = entries_of<Scalar>(
        boundary_gain_sensitivity(plant, options.sampling, {proportional_gain, d},
                                  BoundaryGain::differential, options.largest_radius));
    ratio += ratio[9] * gain;
  }
  ratio[9] = 0.0;
  return {least.outcome, sensitivity_of(ratio), sensitivity_of(gain)};
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template AmplitudeSensitivity amplitude_sensitivity(const TwoMass<double>&,
                                                           const AmplitudeOptions&, double, double);
#endif

}  // namespace holdfast
