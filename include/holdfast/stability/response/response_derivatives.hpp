#pragma once

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
///
/// @tparam Plant  anything with `excitation_input()`
template <class Plant, class Scalar>
HarmonicInput<Scalar> input_derivative_by_period(const Plant& plant,
                                                 const SampledLoop<Scalar>& loop, ForceHold hold,
                                                 const HarmonicInput<Scalar>& input,
                                                 const Scalar& angular_frequency) {
  const Vector<Scalar, 4> late = loop.transition * plant.excitation_input();
  if (hold == ForceHold::sampled) return {late, Vector<Scalar, 4>::Zero()};
  return {late + angular_frequency * input.sine, -angular_frequency * input.cosine};
}

/// How the exact harmonic input moves with a parameter of the plant: the exponential of
/// `exact_harmonic` beside its derivative, of twice the size.
/// @param plant              with the parameter at its value
/// @param rate               derivatives of A, b and c by the parameter
/// @param sampling_period    τ (s), > 0
/// @param angular_frequency  ω (rad/s)
template <class Plant, class Scalar>
HarmonicInput<Scalar> exact_input_derivative_by_plant(const Plant& plant,
                                                      const BasicPlantDerivative<Scalar>& rate,
                                                      const Scalar& sampling_period,
                                                      const Scalar& angular_frequency) {
  Matrix<Scalar, 12> generator = Matrix<Scalar, 12>::Zero();
  for (const int corner : {0, 6}) {
    generator.template block<4, 4>(corner, corner) = plant.state_matrix();
    generator.template block<4, 1>(corner, corner + 4) = plant.excitation_input();
    generator(corner + 4, corner + 5) = -angular_frequency;
    generator(corner + 5, corner + 4) = angular_frequency;
  }
  generator.template block<4, 4>(0, 6) = rate.state_matrix;
  generator.template block<4, 1>(0, 10) = rate.excitation_input;
  const auto whole = exponential(Matrix<Scalar, 12>(generator * sampling_period));
  return {whole.template block<4, 1>(0, 10), whole.template block<4, 1>(0, 11)};
}

/// How the phasors of the steady response move with one parameter:
///
///     (λI − A_d) Z = Q   gives   (λI − A_d) Z′ = Q′ − (λ′I − A_d′) Z
///
/// for both columns Q = [Γ₀ + Γ₁/λ, g] and their responses Z.
template <class Scalar>
class BasicResponseDerivatives {
 public:
  using Complex = std::complex<Scalar>;  ///< the type of the phasors

  /// @param loop               of `sampled_loop`
  /// @param input              of the same loop and ω, held or exact
  /// @param angular_frequency  ω (rad/s), > 0
  BasicResponseDerivatives(const SampledLoop<Scalar>& loop, const HarmonicInput<Scalar>& input,
                           const Scalar& angular_frequency);

  /// The responses themselves, those of `SteadyResponse`.
  ResponsePhasors<Scalar> phasors() const { return phasors_of(response_); }

  /// The derivatives of the phasors along a parameter.
  /// @param rate         of the loop's matrices, per unit of the parameter
  /// @param input_rate   of the harmonic input, likewise
  /// @param period_rate  of τ, likewise: λ′ = iωλτ′
  ResponsePhasors<Scalar> along(const BasicLoopDerivative<Scalar>& rate,
                                const HarmonicInput<Scalar>& input_rate,
                                const Scalar& period_rate) const;

 private:
  Matrix<Complex, 4, 2> sources(const Vector<Scalar, 4>& present, const Vector<Scalar, 4>& previous,
                                const HarmonicInput<Scalar>& input) const;

  static ResponsePhasors<Scalar> phasors_of(const Matrix<Complex, 4, 2>& response) {
    return {response(0, 0), response(1, 0), response(0, 1), response(1, 1)};
  }

  SampledLoop<Scalar> loop_;
  Complex lambda_;                // e^{iωτ}
  Complex lambda_rate_;           // iωλ
  Matrix<Complex, 4> resolvent_;  // λI − A_d
  Matrix<Complex, 4, 2> response_;
};

/// The derivatives of phasors in `double`.
using ResponseDerivatives = BasicResponseDerivatives<double>;

template <class Scalar>
BasicResponseDerivatives<Scalar>::BasicResponseDerivatives(const SampledLoop<Scalar>& loop,
                                                           const HarmonicInput<Scalar>& input,
                                                           const Scalar& angular_frequency)
    : loop_(loop) {
  const Scalar angle = angular_frequency * loop.sampling.period;
  lambda_ = std::polar(Scalar(1), angle);
  lambda_rate_ = Complex(0, angular_frequency) * lambda_;
  const Scalar half_sine = std::sin(angle / Scalar(2));
  const Complex from_one(Scalar(-2) * half_sine * half_sine, std::sin(angle));
  resolvent_ = from_one * Matrix<Complex, 4>::Identity() - loop.increment.template cast<Complex>();
  response_ = eliminated(resolvent_, sources(loop.present_force, loop.previous_force, input));
}

template <class Scalar>
ResponsePhasors<Scalar> BasicResponseDerivatives<Scalar>::along(
    const BasicLoopDerivative<Scalar>& rate, const HarmonicInput<Scalar>& input_rate,
    const Scalar& period_rate) const {
  const Complex lambda_rate = period_rate * lambda_rate_;
  Matrix<Complex, 4, 2> right = sources(rate.present_force, rate.previous_force, input_rate);
  right.col(0) -=
      loop_.previous_force.template cast<Complex>() * (lambda_rate / (lambda_ * lambda_));
  right -= lambda_rate * response_ - rate.transition.template cast<Complex>() * response_;
  return phasors_of(eliminated(resolvent_, right));
}

template <class Scalar>
Matrix<std::complex<Scalar>, 4, 2> BasicResponseDerivatives<Scalar>::sources(
    const Vector<Scalar, 4>& present, const Vector<Scalar, 4>& previous,
    const HarmonicInput<Scalar>& input) const {
  Matrix<Complex, 4, 2> result;
  result.col(0) = present.template cast<Complex>() + previous.template cast<Complex>() / lambda_;
  result.col(1) =
      input.cosine.template cast<Complex>() - Complex(0, 1) * input.sine.template cast<Complex>();
  return result;
}

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

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template HarmonicInput<double> input_derivative_by_period(const TwoMass<double>&,
                                                                 const SampledLoop<double>&,
                                                                 ForceHold,
                                                                 const HarmonicInput<double>&,
                                                                 const double&);
extern template HarmonicInput<double> exact_input_derivative_by_plant(const TwoMass<double>&,
                                                                      const PlantDerivative&,
                                                                      const double&, const double&);
extern template class BasicResponseDerivatives<double>;
#endif

}  // namespace holdfast
