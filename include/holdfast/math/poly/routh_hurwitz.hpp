#pragma once

#include "holdfast/core/select.hpp"
#include "holdfast/math/poly/polynomial.hpp"

namespace holdfast {

/// Whether all roots s of a polynomial Σ a_k sᵏ of degree n = 3, 4 or 5 have Re s < 0, in each SIMD
/// lane of the coefficients a₀ … a_n; a_n may be negative. The conditions of Liénard and Chipart
/// are necessary and sufficient (Kollár 2022, Eq. (15)). With the Hurwitz determinants H_k they are
///
///     a_n a_j > 0 for j = 0, 2 and n − 1,
///     H₂ > 0 (degree 3),   a_n H₃ > 0 (degree 4),   H₂ > 0 and H₄ > 0 (degree 5)
///
/// A NaN coefficient gives `false`. Work: 4, 9 or 11 multiply-adds for n = 3, 4, 5. Source:
/// A. Liénard, M. H. Chipart, Journal de Mathématiques Pures et Appliquées 10 (1914).
template <class Scalar, int Size>
Mask<Scalar> lienard_chipart_stable(const Vector<Scalar, Size>& a) {
  static_assert(Size >= 4 && Size <= 6, "the polynomial must have degree 3, 4 or 5");
  constexpr int n = Size - 1;
  const Scalar zero(0);
  const Scalar x1 = a[n - 1] * a[n - 2] - a[n] * a[n - 3];
  const Mask<Scalar> last_sign = a[n] * a[n - 1] > zero;
  const Mask<Scalar> middle_sign = a[n] * a[2] > zero;
  const Mask<Scalar> first_sign = a[n] * a[0] > zero;
  const Mask<Scalar> one_sign = last_sign & middle_sign & first_sign;
  if constexpr (n == 4) {
    const Mask<Scalar> determinant = a[4] * (a[1] * x1 - a[3] * (a[3] * a[0])) > zero;
    return one_sign & determinant;
  } else {
    const Mask<Scalar> second = x1 > zero;
    if constexpr (n == 3) return one_sign & second;
    if constexpr (n == 5) {
      const Scalar x2 = a[4] * a[1] - a[5] * a[0];
      const Scalar x3 = a[1] * a[2] - a[0] * a[3];
      const Mask<Scalar> fourth = x3 * x1 - x2 * x2 > zero;
      return one_sign & second & fourth;
    }
  }
}

/// Whether all roots s of a polynomial Σ a_k sᵏ of degree 3, 4 or 5 have Re s < 0. Coefficients of
/// any size are admissible, since they are first divided by the largest of their moduli.
template <class Scalar, int Size>
bool is_hurwitz(const Vector<Scalar, Size>& a) {
  const Scalar largest = a.cwiseAbs().maxCoeff();
  return lienard_chipart_stable<Scalar, Size>(a / largest);
}

}  // namespace holdfast
