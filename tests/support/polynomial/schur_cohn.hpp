#pragma once

#include "holdfast/core/select.hpp"
#include "holdfast/math/poly/polynomial.hpp"

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

namespace detail {

constexpr int binomial(int n, int k) { return k == 0 ? 1 : binomial(n - 1, k - 1) * n / k; }

/// c_j = (p − s p*)_j + m s p*_j for s = (−1)ⁿ, from q in powers of μ; see
/// `schur_cohn_stable_in_mu`.
template <class Scalar, int Size>
Scalar reduced_coefficient(const Vector<Scalar, Size>& q, int n, int j, const Scalar& m) {
  Scalar lower(0);
  for (int k = 0; k < j; ++k) {
    const int sign = (n - k) % 2 == 0 ? 1 : -1;
    lower += Scalar(sign * binomial(n - k, j - k)) * q[k];
  }
  const bool same_sign = (n - j) % 2 == 0;  // of q_j in p and in s p*: it cancels exactly
  const Scalar mirrored = same_sign ? Scalar(lower + q[j]) : Scalar(lower - q[j]);
  return m * mirrored - lower + (same_sign ? Scalar(0) : Scalar(2) * q[j]);
}

}  // namespace detail

/// The same test on a polynomial in powers of μ = λ − 1, for loops that sample fast.
///
/// When the roots crowd at λ = 1, every reflection coefficient k comes close to s = (−1)ⁿ and both
/// its distance from s and the difference p − k p* drown in round-off. With m = 1 − s k and s p*(μ)
/// = Σ (−1)^{n−k} q_k μᵏ (1+μ)^{n−k} the same recursion reads
///
///     m = (q_{n−1} − q_{n−2} + q_{n−3} − …) / q_n,   (1 + μ) q′ = (p − s p*) + m s p*,   0 < m < 2
///
/// in which no small number is the difference of large ones. Work: about three times that of
/// `schur_cohn_stable`.
/// @param in_powers_of_mu  constant coefficient first
template <class Scalar, int Size>
Mask<Scalar> schur_cohn_stable_in_mu(Vector<Scalar, Size> in_powers_of_mu) {
  auto& q = in_powers_of_mu;
  Mask<Scalar> stable = Scalar(0) < Scalar(1);
  for (int n = Size - 1; n > 0; --n) {
    Scalar alternating(0);
    for (int k = 0; k < n; ++k) alternating = q[k] - alternating;
    const Scalar m = alternating / q[n];
    stable = stable & (m > Scalar(0)) & (m < Scalar(2));
    const Vector<Scalar, Size> previous = q;
    Scalar quotient(0);
    for (int j = 0; j < n; ++j) {
      quotient = detail::reduced_coefficient(previous, n, j, m) - quotient;
      q[j] = quotient;
    }
  }
  return stable;
}

}  // namespace holdfast
