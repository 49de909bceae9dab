#pragma once

#include <array>

#include "holdfast/core/select.hpp"
#include "holdfast/math/poly/polynomial.hpp"

namespace holdfast::test {

/// Hurwitz's conditions for a polynomial a₀ + a₁ s + … + a_n sⁿ of degree 4 or 5 with a_n > 0: all
/// roots lie in Re s < 0 ⇔ every a_j > 0 and H₂ > 0, H₃ > 0 (and H₄ > 0 for degree 5). Source:
/// Kollár 2022, Eq. (15).
template <class Scalar, int Degree>
struct HurwitzConditions {
  static_assert(Degree == 4 || Degree == 5, "the loop has 4 (continuous) or 5 (sampled) roots");

  Polynomial<Scalar, Degree> coefficients;                                ///< a₀ … a_n
  std::array<Scalar, static_cast<std::size_t>(Degree) - 2> determinants;  ///< H₂ … H_{n−1}

  /// True (lane by lane) when every condition holds. A NaN anywhere is "not stable".
  Mask<Scalar> satisfied() const {
    Mask<Scalar> result = coefficients[0] > Scalar(0);
    for (int j = 1; j <= Degree; ++j) result = result & (coefficients[j] > Scalar(0));
    for (const Scalar& determinant : determinants) result = result & (determinant > Scalar(0));
    return result;
  }
};

/// Hurwitz determinants without division, 5 (degree 4) or 10 (degree 5) multiplications.
///
///     x₁ = H₂ = a_{n−1} a_{n−2} − a_n a_{n−3},   x₂ = a_{n−1} a_{n−4} − a_n a_{n−5}
///     H₃ = a_{n−3} x₁ − a_{n−1} x₂,              H₄ = (a₁ a₂ − a₀ a₃) x₁ − x₂²   (degree 5)
template <class Scalar, int Size>
HurwitzConditions<Scalar, Size - 1> hurwitz_conditions(const Vector<Scalar, Size>& a) {
  HurwitzConditions<Scalar, Size - 1> result;
  result.coefficients = a;
  constexpr int n = Size - 1;
  const Scalar x1 = a[n - 1] * a[n - 2] - a[n] * a[n - 3];
  result.determinants[0] = x1;
  if constexpr (n == 4) {
    result.determinants[1] = a[1] * x1 - a[3] * (a[3] * a[0]);
  } else {
    const Scalar x2 = a[4] * a[1] - a[5] * a[0];
    result.determinants[1] = a[2] * x1 - a[4] * x2;
    result.determinants[2] = (a[1] * a[2] - a[0] * a[3]) * x1 - x2 * x2;
  }
  return result;
}

}  // namespace holdfast::test
