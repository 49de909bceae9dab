#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "holdfast/core/interval.hpp"
#include "holdfast/math/poly/polynomial.hpp"
#include "holdfast/math/poly/routh_hurwitz.hpp"
#include "holdfast/stability/polynomial/characteristic_polynomial.hpp"

namespace holdfast {

/// Values x, ascending, at which the polynomial a(w) + x d(w) has a root on the imaginary axis or
/// at infinity. The arguments a (`constant_part`) and d (`slope_part`) begin with the constant
/// coefficient. A root w = 0 needs a₀ + x d₀ = 0, a root w = ∞ needs a_n + x d_n = 0. At a root
/// w = iy the even part (e) and the odd part (o) of a + x d are both 0. Hence, for Y = y²,
///
///     a_e(Y) d_o(Y) − a_o(Y) d_e(Y) = 0,   x = −a_e / d_e = −a_o / d_o
///
/// All positive Y are found. An x is left out if its denominator is below 1e−12 of the largest
/// coefficient of d, with w in units of the geometric mean of the root moduli of a.
template <class Scalar, int Size>
std::vector<Scalar> boundary_crossings(const Vector<Scalar, Size>& constant_part,
                                       const Vector<Scalar, Size>& slope_part) {
  const Scalar unit = detail::mean_root_modulus(constant_part);
  const Vector<Scalar, Size> a = rescaled(constant_part, unit);
  const Vector<Scalar, Size> d = rescaled(slope_part, unit);
  const Scalar negligible = Scalar(1e-12) * d.cwiseAbs().maxCoeff();
  std::vector<Scalar> crossings;
  const auto solve = [&](const Scalar& constant, const Scalar& slope) {
    if (std::abs(slope) > negligible) crossings.push_back(-constant / slope);
  };
  solve(a[0], d[0]);
  solve(a[Size - 1], d[Size - 1]);

  const auto a_even = detail::parity_part(a, 0), a_odd = detail::parity_part(a, 1);
  const auto d_even = detail::parity_part(d, 0), d_odd = detail::parity_part(d, 1);
  const Vector<Scalar, 5> eliminated =
      multiply<Scalar, 3, 3>(a_even, d_odd) - multiply<Scalar, 3, 3>(a_odd, d_even);
  for (const Scalar& y2 : positive_roots(eliminated, 1e-6)) {
    const Scalar even_slope = evaluate(d_even, y2), odd_slope = evaluate(d_odd, y2);
    if (even_slope * even_slope > odd_slope * odd_slope * y2) {
      solve(evaluate(a_even, y2), even_slope);
    } else {
      solve(evaluate(a_odd, y2), odd_slope);
    }
  }
  std::sort(crossings.begin(), crossings.end());
  return crossings;
}

namespace detail {

/// The gaps between ascending `ends` in which the loop is stable; the first and the last gap are
/// unbounded. Adjacent stable gaps are joined where the loop is stable at their common end too.
/// @param inside     function that returns a point inside a gap
/// @param stable_at  predicate: whether the loop is stable at a point
template <class Scalar, class Inside, class StableAt>
std::vector<Interval<Scalar>> stable_gaps(const std::vector<Scalar>& ends, const Inside& inside,
                                          const StableAt& stable_at) {
  constexpr Scalar infinity = std::numeric_limits<Scalar>::infinity();
  std::vector<Interval<Scalar>> result;
  for (std::size_t k = 0; k <= ends.size(); ++k) {
    const Interval<Scalar> gap{k == 0 ? -infinity : ends[k - 1],
                               k == ends.size() ? infinity : ends[k]};
    if (!(gap.lower < gap.upper) || !stable_at(inside(gap))) continue;
    if (!result.empty() && result.back().upper == gap.lower && stable_at(gap.lower)) {
      result.back().upper = gap.upper;
    } else {
      result.push_back(gap);
    }
  }
  return result;
}

}  // namespace detail

/// The open intervals of x, ascending, in which all roots w of a(w) + x d(w) have Re w < 0.
///
/// The values of `boundary_crossings` divide the x axis into intervals. One x in each interval is
/// tested with the Hurwitz criterion. Adjacent stable intervals are joined if all Re w < 0 at their
/// common end, too. Coefficients begin with the constant one; the leading one may change sign.
template <class Scalar, int Size>
std::vector<Interval<Scalar>> stable_intervals(const Vector<Scalar, Size>& a,
                                               const Vector<Scalar, Size>& d) {
  return detail::stable_gaps(
      boundary_crossings(a, d), [](const Interval<Scalar>& gap) { return gap.representative(); },
      [&](const Scalar& x) { return is_hurwitz<Scalar, Size>(a + x * d); });
}

namespace detail {

template <class Scalar, int Degree>
std::vector<Interval<Scalar>> differential_intervals(
    const AffinePolynomial<Scalar, Degree>& polynomial, const Scalar& proportional_gain) {
  const auto q = in_half_plane(polynomial);
  return stable_intervals<Scalar, Degree + 1>(q.base + proportional_gain * q.proportional,
                                              q.differential);
}

}  // namespace detail

/// The open intervals of D (N s/m), ascending, in which the loop is stable at a given P (N/m).
/// @param polynomial  `characteristic_polynomial` of the sampled or the continuous loop
/// @param proportional_gain  P (N/m), finite
/// @throws InvalidParameter where an argument is not finite
template <class Scalar, int Degree>
std::vector<Interval<Scalar>> stable_differential_gains(
    const AffinePolynomial<Scalar, Degree>& polynomial, const Scalar& proportional_gain) {
  validate(polynomial);
  require_finite("proportional gain P", static_cast<double>(proportional_gain), "N/m");
  return detail::differential_intervals(polynomial, proportional_gain);
}

/// The open intervals of P (N/m), ascending, in which the loop is stable at a given D (N s/m).
/// @param polynomial         `characteristic_polynomial` of the sampled or the continuous loop
/// @param differential_gain  D (N s/m), finite
/// @throws InvalidParameter where an argument is not finite
template <class Scalar, int Degree>
std::vector<Interval<Scalar>> stable_proportional_gains(
    const AffinePolynomial<Scalar, Degree>& polynomial, const Scalar& differential_gain) {
  validate(polynomial);
  require_finite("differential gain D", static_cast<double>(differential_gain), "N s/m");
  return detail::differential_intervals<Scalar, Degree>(
      {polynomial.base, polynomial.differential, polynomial.proportional}, differential_gain);
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template std::vector<Interval<double>> stable_intervals(const Vector<double, 5>&,
                                                               const Vector<double, 5>&);
extern template std::vector<Interval<double>> stable_intervals(const Vector<double, 6>&,
                                                               const Vector<double, 6>&);
#endif

}  // namespace holdfast
