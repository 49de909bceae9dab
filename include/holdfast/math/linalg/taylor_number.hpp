#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <vector>

#include "holdfast/core/compiler.hpp"

namespace holdfast {

/// A Taylor model of a complex function of x, −1 ≤ x ≤ 1: the polynomial Σ_k terms[k] xᵏ plus a
/// remainder of bounded modulus.
struct TaylorNumber {
  std::vector<std::complex<double>> terms;  ///< coefficients of x⁰, x¹, …, at least one
  double remainder;                         ///< upper bound of the remainder's modulus, ≥ 0

  /// The sum Σ |terms[k]|, an upper bound of the polynomial's modulus for −1 ≤ x ≤ 1.
  double size() const {
    double sum = 0.0;
    for (const std::complex<double>& term : terms) sum += std::abs(term);
    return sum;
  }
};

/// The product a b of two Taylor models; round-off is not bounded.
inline TaylorNumber operator*(const TaylorNumber& a, const TaylorNumber& b) {
  TaylorNumber product{std::vector<std::complex<double>>(a.terms.size() + b.terms.size() - 1),
                       a.remainder * (b.size() + b.remainder) + a.size() * b.remainder};
  for (std::size_t i = 0; i < a.terms.size(); ++i)
    for (std::size_t k = 0; k < b.terms.size(); ++k)
      product.terms[i + k] += a.terms[i] * b.terms[k];
  return product;
}

/// The sum a + factor · b of two Taylor models; round-off is not bounded.
inline TaylorNumber sum_of(TaylorNumber a, const TaylorNumber& b, double factor) {
  a.terms.resize(std::max(a.terms.size(), b.terms.size()));
  for (std::size_t k = 0; k < b.terms.size(); ++k) a.terms[k] += factor * b.terms[k];
  a.remainder += std::abs(factor) * b.remainder;
  return a;
}

/// The difference |a(x)|² − |b(x)|² of two Taylor models: its value at x = 0 and a lower bound.
struct SquaresDifference {
  double at_centre,  ///< the difference of the polynomials' squared moduli at x = 0
      least;         ///< lower bound of the difference for −1 ≤ x ≤ 1, with the remainders
};

/// The difference |a(x)|² − |b(x)|² at x = 0 and a lower bound of it for −1 ≤ x ≤ 1. a and b must
/// have equally many terms.
inline SquaresDifference squares_difference(const TaylorNumber& a, const TaylorNumber& b) {
  const std::size_t last = a.terms.size() - 1;
  double first = 0.0, fall = 0.0;
  for (std::size_t k = 0; k <= 2 * last; ++k) {
    double q = 0.0;
    for (std::size_t l = k > last ? k - last : 0; l <= std::min(k, last); ++l)
      q += (a.terms[l] * std::conj(a.terms[k - l])).real() -
           (b.terms[l] * std::conj(b.terms[k - l])).real();
    if (k == 0)
      first = q;
    else
      fall += k % 2 == 0 ? std::max(-q, 0.0) : std::abs(q);
  }
  const double rounding = 64.0 * std::numeric_limits<double>::epsilon();
  const double unknown = a.remainder * (2.0 * a.size() + a.remainder) +
                         b.remainder * (2.0 * b.size() + b.remainder) +
                         rounding * (a.size() * a.size() + b.size() * b.size());
  return {first, first - fall - unknown};
}

}  // namespace holdfast
