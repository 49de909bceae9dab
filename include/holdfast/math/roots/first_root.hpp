#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

#include "holdfast/math/roots/series.hpp"

namespace holdfast {

/// Whether and how a polynomial that is positive just after x = 0 reaches zero up to x = 1.
enum class RootOutcome {
  none,      ///< the polynomial stays positive up to x = 1
  crossing,  ///< the polynomial falls through zero
  grazing,   ///< the polynomial is zero within rounding, with a small slope: it may cross zero,
             ///< touch zero or stay just above zero
};

/// The first zero in [0, 1] of a polynomial that is positive just after x = 0.
struct FirstRoot {
  RootOutcome outcome;  ///< existence and kind of the zero
  double at;            ///< argument x of the zero, 0 ≤ x ≤ 1; 1 if there is no zero
  int evaluations;      ///< number of evaluations of the polynomial and its derivative
};

namespace detail {

/// The distance s > 0 at which height + slope s − bend s²/2 is zero, height > 0.
inline double safe_step(const ValueAndSlope& at, double height, double bend) {
  const double root = std::sqrt(at.slope * at.slope + 2.0 * bend * height);
  // The form without cancellation is used.
  const double step = at.slope > 0.0 ? (at.slope + root) / bend : 2.0 * height / (root - at.slope);
  return std::isnan(step) ? 1.0 : step;
}

/// The first root of a polynomial q in [0, 1], or the end of the part [0, x] proved free of roots.
/// @param rounding  rounding error of the values of q
inline FirstRoot root_in_stretch(const Series& q, double rounding, int most_evaluations) {
  double bend = 0.0;
  for (Eigen::Index k = 2; k < q.size(); ++k)
    bend += static_cast<double>(k * (k - 1)) * std::abs(q[k]);
  double x = 0.0;
  for (int evaluations = 1; evaluations <= most_evaluations; ++evaluations) {
    const ValueAndSlope here = value_and_slope(q, x);
    if (here.value <= rounding && here.slope < 0.0) {
      const bool touches = here.slope * here.slope <= 32.0 * bend * rounding;
      const double beyond = touches ? 0.0 : std::max(here.value, 0.0) / -here.slope;
      return {touches ? RootOutcome::grazing : RootOutcome::crossing, std::min(x + beyond, 1.0),
              evaluations};
    }
    x += safe_step(here, std::max(here.value, rounding), bend);
    if (x >= 1.0) return {RootOutcome::none, 1.0, evaluations};
  }
  return {RootOutcome::none, x, most_evaluations};
}

/// The first root of q(x), q(0) > 0.
///
/// Where terms of q cancel, the bound of |q″| is far too large and the steps are too short. Then q
/// is expanded again about the point reached, over a shorter interval.
inline FirstRoot first_root_of_positive(const Series& q) {
  const double rounding = 4.0 * std::numeric_limits<double>::epsilon() * q.cwiseAbs().sum();
  constexpr int most_evaluations = 2048, patience = 16;
  double begin = 0.0, length = 1.0;
  for (int evaluations = 0; evaluations < most_evaluations;) {
    const bool whole = begin == 0.0 && length == 1.0;
    const FirstRoot found =
        root_in_stretch(whole ? q : rescaled(shifted(q, begin), length), rounding, patience);
    evaluations += found.evaluations;
    if (found.outcome != RootOutcome::none)
      return {found.outcome, std::min(begin + length * found.at, 1.0), evaluations};
    begin += length * found.at;
    const bool through = found.at == 1.0;
    if (through && begin >= 1.0) return {RootOutcome::none, 1.0, evaluations};
    length = std::min(through ? 2.0 * length : 0.25 * length, 1.0 - begin);
  }
  return {RootOutcome::grazing, begin, most_evaluations};
}

}  // namespace detail

/// The first root in [0, 1] of a polynomial p(x) = Σ c_k xᵏ. No root is missed.
///
/// On [0, 1], |p″| ≤ M = Σ k (k − 1) |c_k| and hence p(x + s) ≥ p(x) + p′(x) s − M s²/2. Each step
/// goes from x to x + s, with s > 0 the root of this parabola; p has no root in between. The steps
/// converge quadratically to a crossing, linearly to a point where p touches zero. A root at x = 0
/// does not count if p > 0 just after x = 0. If p < 0 just after x = 0, the root 0 is returned.
///
/// Work: one Horner evaluation of p and p′ per step; about five steps for a crossing. After 2048
/// steps the x reached is returned as grazing.
/// @param p  coefficients c₀, c₁, …, one or more; if one is not finite, no root is reported
inline FirstRoot first_root(const Series& p) {
  Eigen::Index first = 0;
  while (first < p.size() && p[first] == 0.0) ++first;
  if (first == p.size()) return {RootOutcome::none, 1.0, 0};
  if (p[first] < 0.0) return {RootOutcome::crossing, 0.0, 0};
  const double size = p.cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
  if (!std::isfinite(size)) return {RootOutcome::none, 1.0, 0};
  const Series above = p.tail(p.size() - first);
  const bool squares_fit = size > 1e-100 && size < 1e100;
  return detail::first_root_of_positive(squares_fit ? above : Series(above / size));
}

}  // namespace holdfast
