#pragma once

#include <Eigen/Core>

#include "holdfast/math/poly/polynomial.hpp"

namespace holdfast {

/// Most coefficients of a series.
inline constexpr int most_terms = 20;

/// Coefficients of p(x) = c₀ + c₁ x + … , at most `most_terms` of them; never on the heap.
using Series = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, most_terms, 1>;

/// p(x) and p′(x).
struct ValueAndSlope {
  double value,  ///< p(x)
      slope;     ///< p′(x)
};

/// p(x) and p′(x) by Horner's rule.
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

/// Rest of p(x), 0 ≤ x ≤ 1, from some x on: the coefficients of p(from + y (1 − from)).
inline Series rest_of(const Series& p, double from) {
  return rescaled(shifted(p, from), 1.0 - from);
}

}  // namespace holdfast
