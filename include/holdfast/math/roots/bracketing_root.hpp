#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "holdfast/core/compiler.hpp"

namespace holdfast {

/// A bracket of a root: two arguments between which a function changes sign, with both values.
template <class Scalar>
struct SignChange {
  Scalar lower,           ///< smaller argument
      upper;              ///< larger argument; equal to `lower` if the function is exactly 0 there
  Scalar value_at_lower;  ///< function value at `lower`
  Scalar value_at_upper;  ///< function value at `upper`; its sign is opposite unless a value is 0
  int evaluations = 0;    ///< number of function calls made so far
};

namespace detail {

template <class Scalar>
struct Ordinate {
  Scalar x, value;
};

/// The next argument, as a share 0 … 1 of the distance from `near` to `far`: by inverse quadratic
/// interpolation through the last three points if it is monotone between them, otherwise 1/2.
template <class Scalar>
Scalar chandrupatla_share(const Ordinate<Scalar>& near, const Ordinate<Scalar>& far,
                          const Ordinate<Scalar>& old) {
  const Scalar xi = (near.x - far.x) / (old.x - far.x);
  const Scalar phi = (near.value - far.value) / (old.value - far.value);
  const bool monotone = phi * phi < xi && (Scalar(1) - phi) * (Scalar(1) - phi) < Scalar(1) - xi;
  if (!monotone) return Scalar(0.5);
  return near.value / (far.value - near.value) * (old.value / (far.value - old.value)) +
         (old.x - near.x) / (far.x - near.x) * (near.value / (old.value - near.value)) *
             (far.value / (old.value - far.value));
}

}  // namespace detail

/// Narrows the bracket of a root to a width of at most `tolerance`, or to two neighbouring numbers.
///
/// Chandrupatla's method uses inverse quadratic interpolation where it is monotone, else bisection.
/// The order of convergence is about 1.8 at a simple root; at a jump the method bisects. If the
/// function is exactly 0 at an argument that is tried, both ends become this argument.
/// @param function   function Scalar → Scalar; NaN counts as negative
/// @param bracket    lower < upper; returned unchanged unless the value is > 0 at exactly one end
/// @param tolerance  largest width of the result, ≥ 0, in the unit of the argument
/// Source: T. R. Chandrupatla, A new event quadratic/bisection algorithm for finding the zero of
/// a nonlinear function without using derivatives, Advances in Engineering Software 28 (1997).
template <class Scalar, class Function>
SignChange<Scalar> bracketing_root(const Function& function, const SignChange<Scalar>& bracket,
                                   const Scalar& tolerance) {
  detail::Ordinate<Scalar> near{bracket.lower, bracket.value_at_lower};
  detail::Ordinate<Scalar> far{bracket.upper, bracket.value_at_upper};
  if ((near.value > Scalar(0)) == (far.value > Scalar(0))) return bracket;
  int evaluations = bracket.evaluations;
  Scalar share(0.5);
  while (true) {
    const Scalar spacing =
        std::numeric_limits<Scalar>::epsilon() * std::max(std::abs(near.x), std::abs(far.x));
    const Scalar width = std::abs(far.x - near.x);
    if (width <= std::max(tolerance, spacing)) break;
    // A minimal distance to the near end makes the other end move too.
    const Scalar margin = std::max(tolerance / Scalar(2), spacing / Scalar(2)) / width;
    const Scalar kept = std::min(std::max(share, margin), Scalar(1) - margin);
    const Scalar x = near.x + kept * (far.x - near.x);
    if (x == near.x || x == far.x) break;
    const detail::Ordinate<Scalar> found{x, function(x)};
    ++evaluations;
    if (found.value == Scalar(0)) return {x, x, found.value, found.value, evaluations};
    const bool same_side = (found.value > Scalar(0)) == (near.value > Scalar(0));
    const detail::Ordinate<Scalar> old = same_side ? near : far;
    if (!same_side) far = near;
    near = found;
    share = detail::chandrupatla_share(near, far, old);
  }
  if (far.x < near.x) std::swap(near, far);
  return {near.x, far.x, near.value, far.value, evaluations};
}

namespace detail {

/// The argument of a function's minimum in an interval, by golden section with one value per step.
template <class Scalar, class Value>
Scalar narrow_to_minimum(Scalar lower, Scalar upper, int steps, const Value& value) {
  const Scalar golden(0.3819660112501051);
  Scalar left = lower + golden * (upper - lower), right = upper - golden * (upper - lower);
  Scalar at_left = value(left), at_right = value(right);
  for (int k = 0; k < steps; ++k) {
    if (at_left < at_right) {
      upper = std::exchange(right, left);
      left = lower + golden * (upper - lower);
      at_right = std::exchange(at_left, value(left));
    } else {
      lower = std::exchange(left, right);
      right = upper - golden * (upper - lower);
      at_left = std::exchange(at_right, value(right));
    }
  }
  return (lower + upper) / Scalar(2);
}

}  // namespace detail

}  // namespace holdfast
