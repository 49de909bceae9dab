#pragma once

#include "holdfast/math/poly/polynomial.hpp"

namespace holdfast {

/// Möbius–Zhukovsky transformation of a polynomial given in powers of μ = λ − 1.
///
///     λ = (1 + w) / (1 − w),   μ = 2w / (1 − w),   q(w) = (1 − w)ⁿ p(2w / (1 − w))
///
/// maps |λ| < 1 onto Re w < 0, so that Hurwitz's conditions on q decide the sampled loop:
/// q₀ = 0 is a root λ = +1, q_n = 0 a root λ = −1 (w = ∞), and H_{n−1} = 0 a pair on the unit
/// circle. Source: Kollár 2022, §4.1; its b_j belong to the loop with δ = 0 without the root λ = 0,
/// of degree 4, so that these coefficients are the b_j times (1 + w).
/// @return q, constant coefficient first, same degree as p
template <class Scalar, int Size>
Vector<Scalar, Size> in_half_plane(const Vector<Scalar, Size>& in_powers_of_mu) {
  Vector<Scalar, Size> result = Vector<Scalar, Size>::Zero();
  // Horner's rule in the homogeneous pair (2w, 1 − w): result ← result · 2w + p_k (1 − w)^{n−k}.
  Vector<Scalar, Size> power = Vector<Scalar, Size>::Unit(0);
  for (int k = Size - 1; k >= 0; --k) {
    for (int j = Size - 1; j > 0; --j) result[j] = Scalar(2) * result[j - 1];
    result[0] = Scalar(0);
    result += in_powers_of_mu[k] * power;
    for (int j = Size - 1; j > 0; --j) power[j] -= power[j - 1];
  }
  return result;
}

}  // namespace holdfast
