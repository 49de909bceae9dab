#pragma once

#include "holdfast/control/gains.hpp"
#include "holdfast/math/poly/polynomial.hpp"
#include "holdfast/stability/polynomial/characteristic_polynomial.hpp"
#include "support/testing.hpp"

namespace holdfast::test {

/// The gains for which p(x; P, D) vanishes at a point x off the real axis: two real linear
/// equations,
///
///     Re, Im [ base(x) + P · proportional(x) + D · differential(x) ] = 0
///
/// This is the D-decomposition. @return nothing where the two equations are dependent (no finite
/// gains)
template <class Scalar, int Degree>
std::optional<PdGains<Scalar>> gains_with_root(const AffinePolynomial<Scalar, Degree>& polynomial,
                                               const std::complex<Scalar>& x) {
  const std::complex<Scalar> base = evaluate(polynomial.base, x);
  const std::complex<Scalar> p = evaluate(polynomial.proportional, x);
  const std::complex<Scalar> d = evaluate(polynomial.differential, x);
  const Scalar determinant = std::imag(std::conj(p) * d);
  const PdGains<Scalar> gains{-std::imag(std::conj(base) * d) / determinant,
                              std::imag(std::conj(base) * p) / determinant};
  if (!std::isfinite(gains.proportional) || !std::isfinite(gains.differential)) return std::nullopt;
  return gains;
}

/// μ = e^{iθ} − 1 without cancellation: −2 sin²(θ/2) + i sin θ.
template <class Scalar>
std::complex<Scalar> unit_circle_minus_one(const Scalar& angle) {
  const Scalar half_sine = std::sin(angle / Scalar(2));
  return {Scalar(-2) * half_sine * half_sine, std::sin(angle)};
}

/// Gains of the sampled loop with a root pair e^{±iθ}, 0 < θ < π.
/// @param polynomial  `characteristic_polynomial(loop)`, in powers of λ − 1
/// @param angle       θ (rad), 0 < θ < π
/// @return nothing where no finite gains have that pair
template <class Scalar>
std::optional<PdGains<Scalar>> complex_pair_gains(const AffinePolynomial<Scalar, 5>& polynomial,
                                                  const Scalar& angle) {
  return gains_with_root(polynomial, unit_circle_minus_one(angle));
}

}  // namespace holdfast::test
