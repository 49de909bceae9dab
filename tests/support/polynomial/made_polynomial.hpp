#pragma once

#include "holdfast/control/gains.hpp"
#include "holdfast/math/poly/polynomial.hpp"
#include "holdfast/stability/polynomial/characteristic_polynomial.hpp"
#include "support/random.hpp"

namespace holdfast::test {

/// A monic quadratic, c + b x + x².
inline Polynomial<double, 2> quadratic(double c, double b) { return {c, b, 1.0}; }

/// The product of two quadratics, and for degree 5 of x + rest too.
template <int Degree>
Polynomial<double, Degree> product(const Polynomial<double, 2>& a, const Polynomial<double, 2>& b,
                                   double rest = 0.0) {
  const Polynomial<double, 4> both = multiply<double, 3, 3>(a, b);
  if constexpr (Degree == 4) {
    return both;
  } else {
    return multiply<double, 5, 2>(both, Polynomial<double, 1>(rest, 1.0));
  }
}

/// A polynomial that has the given one at the given gains, its other coefficients random; like that
/// of the continuous loop, degree 4 keeps its leading coefficient.
template <int Degree>
AffinePolynomial<double, Degree> through(const Polynomial<double, Degree>& at_gains,
                                         const PdGains<double>& gains, Random& random) {
  AffinePolynomial<double, Degree> result;
  result.proportional = random.matrix<Polynomial<double, Degree>>();
  result.differential = random.matrix<Polynomial<double, Degree>>();
  if (Degree == 4) result.proportional[4] = result.differential[4] = 0.0;
  result.base = at_gains - gains.proportional * result.proportional -
                gains.differential * result.differential;
  return result;
}

/// The same in a variable of the half-plane.
template <int Degree>
HalfPlanePolynomial<double, Degree> through_in_half_plane(
    const Polynomial<double, Degree>& at_gains, const PdGains<double>& gains, Random& random) {
  const auto made = through<Degree>(at_gains, gains, random);
  return {made.base, made.proportional, made.differential};
}

}  // namespace holdfast::test
