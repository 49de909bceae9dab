#pragma once

#include "holdfast/core/polynomial.hpp"
#include "holdfast/core/select.hpp"

namespace holdfast {

/// Schur–Cohn (Jury) test: true (lane by lane) when all roots of the real polynomial lie in |λ|
/// < 1.
///
/// From p of degree n the recursion forms the reflection coefficient k = p₀ / p_n and
///
///     p'_{j−1} = p_j − k p_{n−j},   j = 1 … n
///
/// of degree n − 1; all roots are inside the unit circle ⇔ every |k| < 1. A zero leading
/// coefficient or a NaN makes |k| < 1 false. Work: n divisions and n (n + 1) / 2 multiply-adds.
/// @param in_powers_of_lambda  constant coefficient first
/// Source: E. I. Jury, Theory and Application of the z-Transform Method, 1964.
template <class Scalar, int Size>
Mask<Scalar> schur_cohn_stable(Vector<Scalar, Size> in_powers_of_lambda) {
  auto& p = in_powers_of_lambda;
  Mask<Scalar> stable = Scalar(0) < Scalar(1);
  for (int n = Size - 1; n > 0; --n) {
    const Scalar reflection = p[0] / p[n];
    stable = stable & (reflection < Scalar(1)) & (reflection > Scalar(-1));
    const Vector<Scalar, Size> previous = p;
    for (int j = 1; j <= n; ++j) p[j - 1] = previous[j] - reflection * previous[n - j];
  }
  return stable;
}

}  // namespace holdfast
