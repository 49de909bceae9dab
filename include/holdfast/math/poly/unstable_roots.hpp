#pragma once

#include "holdfast/math/poly/polynomial.hpp"

namespace holdfast {

/// Number of roots in the open right half-plane Re w > 0, by finding all roots.
/// @param polynomial  degree 4 or 5, in s, or in w after `in_half_plane`, where Re w > 0 is |λ| > 1
template <class Coefficients>
int unstable_roots(const Eigen::MatrixBase<Coefficients>& polynomial) {
  using Scalar = typename Coefficients::Scalar;
  int count = 0;
  for (const auto& root : roots(polynomial)) count += root.real() > Scalar(0) ? 1 : 0;
  return count;
}

}  // namespace holdfast
