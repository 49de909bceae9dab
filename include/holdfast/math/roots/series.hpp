#pragma once

#include <Eigen/Core>

#include "holdfast/math/poly/polynomial.hpp"

namespace holdfast {

/// The largest number of coefficients of a `Series`.
inline constexpr int most_terms = 20;

/// The coefficients c₀, c₁, … of a polynomial, at most `most_terms`, without heap allocation.
using Series = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, most_terms, 1>;

/// A value p(x) of a polynomial with its slope p′(x).
struct ValueAndSlope {
  double value,  ///< value p(x)
      slope;     ///< slope p′(x)
};

/// The value p(x) and the slope p′(x) by Horner's rule.
/// @param polynomial  c₀, c₁, …, one coefficient or more
/// @param x           any number
template <class Coefficients>
ValueAndSlope value_and_slope(const Eigen::MatrixBase<Coefficients>& polynomial, double x) {
  ValueAndSlope result{polynomial[polynomial.size() - 1], 0.0};
  for (Eigen::Index k = polynomial.size() - 2; k >= 0; --k) {
    result.slope = result.slope * x + result.value;
    result.value = result.value * x + polynomial[k];
  }
  return result;
}

/// The coefficients of p(from + (1 − from) y) in powers of y; 0 ≤ y ≤ 1 maps to from ≤ x ≤ 1.
inline Series rest_of(const Series& p, double from) {
  return rescaled(shifted(p, from), 1.0 - from);
}

}  // namespace holdfast
