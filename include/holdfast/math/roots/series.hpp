#pragma once

#include <Eigen/Core>

#include "holdfast/math/poly/polynomial.hpp"

namespace holdfast {

/// The largest number of coefficients of a `Series`.
inline constexpr int most_terms = 20;

/// The coefficients c₀, c₁, … of a polynomial Σ c_k xᵏ, at most `most_terms`, not on the heap.
using Series = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, most_terms, 1>;

/// The value and the derivative of a polynomial p at one x.
struct ValueAndSlope {
  double value,  ///< value p(x)
      slope;     ///< derivative p′(x)
};

/// The value p(x) and the derivative p′(x) of a polynomial by Horner's rule.
/// @param polynomial  coefficients c₀, c₁, … of p, one or more
/// @param x           argument, any number
template <class Coefficients>
ValueAndSlope value_and_slope(const Eigen::MatrixBase<Coefficients>& polynomial, double x) {
  ValueAndSlope result{polynomial[polynomial.size() - 1], 0.0};
  for (Eigen::Index k = polynomial.size() - 2; k >= 0; --k) {
    result.slope = result.slope * x + result.value;
    result.value = result.value * x + polynomial[k];
  }
  return result;
}

/// The coefficients of p(a + (1 − a) y) in powers of y, a = `from`; 0 ≤ y ≤ 1 covers a ≤ x ≤ 1.
inline Series rest_of(const Series& p, double from) {
  return rescaled(shifted(p, from), 1.0 - from);
}

}  // namespace holdfast
