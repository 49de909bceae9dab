#pragma once

#include <array>
#include <string>

#include "holdfast/core/select.hpp"
#include "holdfast/math/poly/polynomial.hpp"

namespace holdfast {

/// Hurwitz's conditions for a polynomial a₀ + a₁ s + … + a_n sⁿ of degree 4 or 5 with a_n > 0: all
/// roots lie in Re s < 0 ⇔ every a_j > 0 and H₂ > 0, H₃ > 0 (and H₄ > 0 for degree 5). Source:
/// Kollár 2022, Eq. (15).
template <class Scalar, int Degree>
struct HurwitzConditions {
  static_assert(Degree == 4 || Degree == 5, "the loop has 4 (continuous) or 5 (sampled) roots");

  Polynomial<Scalar, Degree> coefficients;      ///< a₀ … a_n
  std::array<Scalar, Degree - 2> determinants;  ///< H₂ … H_{n−1}

  /// True (lane by lane) when every condition holds. A NaN anywhere is "not stable".
  Mask<Scalar> satisfied() const {
    Mask<Scalar> result = coefficients[0] > Scalar(0);
    for (int j = 1; j <= Degree; ++j) result = result & (coefficients[j] > Scalar(0));
    for (const Scalar& determinant : determinants) result = result & (determinant > Scalar(0));
    return result;
  }

  /// One named condition, for reading: "a0", "H2", …; the condition is value > 0.
  struct Condition {
    std::string name;  ///< "a0" … "a5", "H2" … "H4"
    Scalar value;      ///< of the coefficient or determinant
  };

  /// All conditions by name, a₀ … a_n and then H₂ … H_{n−1}.
  std::array<Condition, 2 * Degree - 1> named() const {
    std::array<Condition, 2 * Degree - 1> result;
    std::size_t next = 0;
    for (int j = 0; j <= Degree; ++j) result[next++] = {"a" + std::to_string(j), coefficients[j]};
    for (std::size_t j = 0; j < determinants.size(); ++j) {
      result[next++] = {"H" + std::to_string(j + 2), determinants[j]};
    }
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

/// True (lane by lane) when all roots lie in Re s < 0, for either sign of the leading
/// coefficient.
///
/// Liénard and Chipart's half of Hurwitz's conditions, which suffices:
///
///     a_n a_j > 0 for j = 0, 2 and n − 1,
///     H₂ > 0 (degree 3),   a_n H₃ > 0 (degree 4),   H₂ > 0 and H₄ > 0 (degree 5)
///
/// Work: 4, 9 or 11 multiply-adds, no division. A NaN is "not stable".
/// Source: A. Liénard, M. H. Chipart, Journal de Mathématiques Pures et Appliquées 10 (1914).
template <class Scalar, int Size>
Mask<Scalar> lienard_chipart_stable(const Vector<Scalar, Size>& a) {
  static_assert(Size >= 4 && Size <= 6, "conditions are written for degree 3, 4 and 5");
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

/// `lienard_chipart_stable` for one polynomial of any size of coefficients: they are first divided
/// by the largest, so that no product overflows.
template <class Scalar, int Size>
bool is_hurwitz(const Vector<Scalar, Size>& a) {
  const Scalar largest = a.cwiseAbs().maxCoeff();
  return lienard_chipart_stable<Scalar, Size>(a / largest);
}

}  // namespace holdfast
