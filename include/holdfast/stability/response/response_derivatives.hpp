#pragma once

#include <Eigen/LU>
#include <cmath>
#include <complex>

#include "holdfast/control/gains.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/control/zero_order_hold.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/excitation/harmonic_input.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "holdfast/stability/polynomial/loop_derivatives.hpp"
#include "holdfast/stability/response/response.hpp"

namespace holdfast {

/// How the harmonic input moves with τ, per second: that of the held force with c_d, that of the
/// exact one by
///
///     cosine′ = A_d c + ω sine,   sine′ = −ω cosine
template <template <class> class Plant>
HarmonicInput<double> input_rate_by_period(const Plant<double>& plant,
                                           const SampledLoop<double>& loop, ForceHold hold,
                                           const HarmonicInput<double>& input,
                                           double angular_frequency) {
  const Vector<double, 4> late = loop.transition * plant.excitation_input();
  if (hold == ForceHold::sampled) return {late, Vector<double, 4>::Zero()};
  return {late + angular_frequency * input.sine, -angular_frequency * input.cosine};
}

/// How the exact harmonic input moves with a parameter of the plant: the exponential of
/// `exact_harmonic` beside its derivative, of twice the size.
/// @param plant              with the parameter at its value
/// @param rate               derivatives of A, b and c by the parameter
/// @param sampling_period    τ (s), > 0
/// @param angular_frequency  ω (rad/s)
template <template <class> class Plant>
HarmonicInput<double> exact_input_rate_by_plant(const Plant<double>& plant, const PlantRate& rate,
                                                double sampling_period, double angular_frequency) {
  Matrix<double, 12> generator = Matrix<double, 12>::Zero();
  for (const int corner : {0, 6}) {
    generator.block<4, 4>(corner, corner) = plant.state_matrix();
    generator.block<4, 1>(corner, corner + 4) = plant.excitation_input();
    generator(corner + 4, corner + 5) = -angular_frequency;
    generator(corner + 5, corner + 4) = angular_frequency;
  }
  generator.block<4, 4>(0, 6) = rate.state_matrix;
  generator.block<4, 1>(0, 10) = rate.excitation_input;
  const Matrix<double, 12> exponential =
      detail::balanced_exponential(Matrix<double, 12>(generator * sampling_period));
  return {exponential.block<4, 1>(0, 10), exponential.block<4, 1>(0, 11)};
}

/// How the phasors of the steady response move with one parameter:
///
///     (λI − A_d) Z = Q   gives   (λI − A_d) Z′ = Q′ − (λ′I − A_d′) Z
///
/// for both columns Q = [Γ₀ + Γ₁/λ, g] and their responses Z.
class ResponseRates {
 public:
  using Complex = std::complex<double>;  ///< the type of the phasors

  /// @param loop               of `sampled_loop`
  /// @param input              of the same loop and ω, held or exact
  /// @param angular_frequency  ω (rad/s), > 0
  ResponseRates(const SampledLoop<double>& loop, const HarmonicInput<double>& input,
                double angular_frequency)
      : loop_(loop), angle_(angular_frequency * loop.sampling.period) {
    lambda_ = std::polar(1.0, angle_);
    const double half_sine = std::sin(angle_ / 2.0);
    const Complex from_one(-2.0 * half_sine * half_sine, std::sin(angle_));
    const Matrix<Complex, 4> system =
        from_one * Matrix<Complex, 4>::Identity() - loop.increment.cast<Complex>();
    factors_.compute(system);
    response_ = factors_.solve(sources(loop.present_force, loop.previous_force, input));
  }

  /// The responses themselves, those of `SteadyResponse`.
  ResponsePhasors<double> phasors() const { return phasors_of(response_); }

  /// The derivatives of the phasors along a parameter.
  /// @param rate         of the loop's matrices, per unit of the parameter
  /// @param input_rate   of the harmonic input, likewise
  /// @param lambda_rate  of λ = e^{iωτ}: iωλ by τ, 0 by the plant's parameters and by δ
  ResponsePhasors<double> along(const LoopRate& rate, const HarmonicInput<double>& input_rate,
                                const Complex& lambda_rate) const {
    Matrix<Complex, 4, 2> right = sources(rate.present_force, rate.previous_force, input_rate);
    right.col(0) -= loop_.previous_force.cast<Complex>() * (lambda_rate / (lambda_ * lambda_));
    right -= lambda_rate * response_ - rate.transition.cast<Complex>() * response_;
    return phasors_of(factors_.solve(right));
  }

  /// λ = e^{iωτ}.
  const Complex& lambda() const { return lambda_; }

 private:
  Matrix<Complex, 4, 2> sources(const Vector<double, 4>& present, const Vector<double, 4>& previous,
                                const HarmonicInput<double>& input) const {
    Matrix<Complex, 4, 2> result;
    result.col(0) = present.cast<Complex>() + previous.cast<Complex>() / lambda_;
    result.col(1) = input.cosine.cast<Complex>() - Complex(0, 1) * input.sine.cast<Complex>();
    return result;
  }

  static ResponsePhasors<double> phasors_of(const Matrix<Complex, 4, 2>& response) {
    return {response(0, 0), response(1, 0), response(0, 1), response(1, 1)};
  }

  SampledLoop<double> loop_;
  double angle_;
  Complex lambda_;
  Eigen::PartialPivLU<Matrix<Complex, 4>> factors_;
  Matrix<Complex, 4, 2> response_;
};

/// The complex amplitude of z₁ over that without control and its rate, from the phasors and theirs.
struct AmplitudeRatio {
  std::complex<double> value;  ///< Z₁(P, D)/Z₁(0, 0)
  std::complex<double> rate;   ///< its derivative, per unit of the parameter
};

/// Z₁(P, D)/Z₁(0, 0) = (f₁ + D n)/(f₁ (1 − P t₁ − D t₂)), n = t₁ f₂ − t₂ f₁, differentiated.
inline AmplitudeRatio amplitude_ratio(const ResponsePhasors<double>& phasors,
                                      const ResponsePhasors<double>& rates,
                                      const PdGains<double>& gains) {
  using Complex = std::complex<double>;
  const auto& [t1, t2, f1, f2] = phasors;
  const auto& [t1_rate, t2_rate, f1_rate, f2_rate] = rates;
  const Complex slope_rate = t1_rate * f2 + t1 * f2_rate - t2_rate * f1 - t2 * f1_rate;
  const Complex above = f1 + gains.differential * phasors.numerator_slope();
  const Complex below = 1.0 - gains.proportional * t1 - gains.differential * t2;
  const Complex above_rate = f1_rate + gains.differential * slope_rate;
  const Complex below_rate = -gains.proportional * t1_rate - gains.differential * t2_rate;
  const Complex value = above / (f1 * below);
  return {value, above_rate / (f1 * below) - value * (f1_rate / f1 + below_rate / below)};
}

}  // namespace holdfast
