#pragma once

#include <cmath>
#include <complex>
#include <vector>

#include "holdfast/control/gains.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/math/poly/polynomial.hpp"
#include "holdfast/stability/polynomial/affine_polynomial.hpp"
#include "holdfast/stability/polynomial/loop_derivatives.hpp"

namespace holdfast {

/// A root λ of the loop's characteristic polynomial p and how it moves with the parameters x that
/// the polynomial's coefficients carry and with the gains:
///
///     ∂λ/∂x = −(∂p/∂x) / (∂p/∂λ)
///
/// At a multiple root the rates are infinite or not a number.
template <int Directions>
struct RootSensitivity {
  using Complex = std::complex<double>;  ///< the type of a root

  Complex offset;                     ///< μ = λ − centre
  double centre = 1.0;                ///< 1, or 0 where the roots crowd there (`LoopPolynomial`)
  Vector<Complex, Directions> rates;  ///< ∂λ/∂x, per unit of each parameter
  Complex derivative_by_proportional_gain;  ///< ∂λ/∂P (m/N)
  Complex derivative_by_differential_gain;  ///< ∂λ/∂D (m/(N s))

  /// λ; where sampling is fast `offset` holds it with more digits.
  Complex value() const { return centre + offset; }

  /// |λ| − centre without cancellation.
  double radius_offset() const {
    if (centre == 0.0) return std::abs(offset);
    return (2.0 * offset.real() + std::norm(offset)) / (1.0 + std::abs(value()));
  }

  /// |λ| − 1.
  double excess() const { return radius_offset() - (1.0 - centre); }

  /// ln |λ|, −∞ for λ = 0.
  double logarithm() const {
    const double square = 2.0 * offset.real() + std::norm(offset);  // |λ|² − 1 about 1
    const bool near_one = centre == 1.0 && square > -0.5;
    return near_one ? 0.5 * std::log1p(square) : std::log(std::abs(value()));
  }

  /// ∂ ln|λ| belonging to ∂λ.
  double logarithmic_derivative(const Complex& rate) const { return (rate / value()).real(); }
};

/// The polynomial in powers of μ alone, without the derivatives that it carries.
template <int Directions, int Degree>
Polynomial<double, Degree> values_of(const Polynomial<DualNumber<Directions>, Degree>& dual) {
  Polynomial<double, Degree> values;
  for (int k = 0; k <= Degree; ++k) values[k] = dual[k].value();
  return values;
}

/// The derivative along direction number `direction`.
template <int Directions, int Degree>
Polynomial<double, Degree> derivative_of(const Polynomial<DualNumber<Directions>, Degree>& dual,
                                         int direction) {
  Polynomial<double, Degree> rates;
  for (int k = 0; k <= Degree; ++k) rates[k] = dual[k].derivatives()[direction];
  return rates;
}

/// All roots with their rates.
/// @param polynomial  of a `dual_loop`, in powers of μ = λ − centre
/// @param gains       P (N/m) and D (N s/m), finite
/// @param centre      1, or 0 for a polynomial in powers of λ
template <int Directions>
std::vector<RootSensitivity<Directions>> root_sensitivities(
    const AffinePolynomial<DualNumber<Directions>, 5>& polynomial, const PdGains<double>& gains,
    double centre = 1.0) {
  const Polynomial<DualNumber<Directions>, 5> p = polynomial.at(PdGains<DualNumber<Directions>>{
      DualNumber<Directions>(gains.proportional), DualNumber<Directions>(gains.differential)});
  const Polynomial<double, 5> values = values_of<Directions, 5>(p);
  const Polynomial<double, 4> slope = derivative<double, 6>(values);
  std::vector<RootSensitivity<Directions>> result;
  for (const std::complex<double>& mu : roots(values)) {
    const std::complex<double> inverse = -1.0 / evaluate(slope, mu);
    RootSensitivity<Directions> root;
    root.offset = mu;
    root.centre = centre;
    for (int i = 0; i < Directions; ++i) {
      root.rates[i] = evaluate(derivative_of<Directions, 5>(p, i), mu) * inverse;
    }
    root.derivative_by_proportional_gain =
        evaluate(values_of<Directions, 5>(polynomial.proportional), mu) * inverse;
    root.derivative_by_differential_gain =
        evaluate(values_of<Directions, 5>(polynomial.differential), mu) * inverse;
    result.push_back(root);
  }
  return result;
}

}  // namespace holdfast
