#pragma once

#include "holdfast/control/gains.hpp"
#include "holdfast/math/poly/mobius_zhukovsky.hpp"
#include "holdfast/math/poly/polynomial.hpp"

namespace holdfast {

/// A polynomial whose coefficients are affine in the two gains:
///
///     p(x; P, D) = base(x) + P · proportional(x) + D · differential(x)
///
/// The characteristic polynomial of the loop has this form because both gains sit in one row of the
/// feedback matrix (a rank-one change of the plant). Its coefficients are found once for a plant
/// and a sampling; each (P, D) then costs 2 (Degree + 1) multiply-adds.
template <class Scalar, int Degree>
struct AffinePolynomial {
  Polynomial<Scalar, Degree> base;          ///< without control, constant coefficient first
  Polynomial<Scalar, Degree> proportional;  ///< ∂p/∂P, per N/m of P
  Polynomial<Scalar, Degree> differential;  ///< ∂p/∂D, per N s/m of D

  /// The polynomial at one pair of gains, constant coefficient first.
  Polynomial<Scalar, Degree> at(const PdGains<Scalar>& gains) const {
    return base + gains.proportional * proportional + gains.differential * differential;
  }

  /// The same linear change of variable applied to all three parts.
  template <class LinearMap>
  AffinePolynomial transformed(const LinearMap& map) const {
    return {map(base), map(proportional), map(differential)};
  }
};

namespace detail {

/// A loop's characteristic polynomial, of degree 4 in s or of degree 5 in powers of λ − 1, in a
/// variable whose stable half-plane is Re < 0.
template <class Scalar, int Degree>
AffinePolynomial<Scalar, Degree> in_stable_half_plane(
    const AffinePolynomial<Scalar, Degree>& polynomial) {
  static_assert(Degree == 4 || Degree == 5, "4 roots of the continuous loop, 5 of the sampled one");
  if constexpr (Degree == 4) {
    return polynomial;
  } else {
    return polynomial.transformed(in_half_plane<Scalar, 6>);
  }
}

}  // namespace detail

}  // namespace holdfast
