#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "holdfast/math/poly/polynomial.hpp"

namespace holdfast {

/// The positive roots of a real polynomial of low degree, ascending.
///
/// Round-off splits a double root by √ε off the real axis; such a pair counts as two real roots, so
/// that what depends on a change of sign between roots is at worst looked at once too often.
template <class Coefficients>
std::vector<typename Coefficients::Scalar> positive_roots(
    const Eigen::MatrixBase<Coefficients>& polynomial) {
  using Scalar = typename Coefficients::Scalar;
  std::vector<Scalar> result;
  for (const auto& root : roots(polynomial)) {
    const bool real = std::abs(root.imag()) <= Scalar(1e-5) * std::abs(root.real());
    if (root.real() > Scalar(0) && real) result.push_back(root.real());
  }
  std::sort(result.begin(), result.end());
  return result;
}

/// Number of roots in the open right half-plane Re w > 0, by finding all roots.
/// @param polynomial  degree 4 or 5, in s, or in w after `in_half_plane`, where Re w > 0 is |λ| > 1
template <class Coefficients>
int unstable_roots(const Eigen::MatrixBase<Coefficients>& polynomial) {
  using Scalar = typename Coefficients::Scalar;
  int count = 0;
  for (const auto& root : roots(polynomial)) count += root.real() > Scalar(0) ? 1 : 0;
  return count;
}

/// The polynomial divided by x − root, its last coefficient 0; the remainder is dropped.
template <class Scalar, int Size>
Vector<Scalar, Size> without_root(const Vector<Scalar, Size>& polynomial, const Scalar& root) {
  Vector<Scalar, Size> quotient = Vector<Scalar, Size>::Zero();
  for (int k = Size - 2; k >= 0; --k) quotient[k] = polynomial[k + 1] + root * quotient[k + 1];
  return quotient;
}

}  // namespace holdfast
