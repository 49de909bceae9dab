#pragma once

#include <cmath>
#include <complex>
#include <limits>
#include <optional>
#include <vector>

#include "holdfast/control/gains.hpp"
#include "holdfast/core/interval.hpp"
#include "holdfast/math/poly/polynomial.hpp"
#include "holdfast/stability/boundary/boundary_curves.hpp"
#include "holdfast/stability/boundary/boundary_point.hpp"
#include "holdfast/stability/boundary/curve_tracer.hpp"
#include "holdfast/stability/polynomial/affine_polynomial.hpp"

namespace holdfast {

/// The gains for which p(x; P, D) vanishes at a point x off the real axis: two real linear
/// equations,
///
///     Re, Im [ base(x) + P · proportional(x) + D · differential(x) ] = 0
///
/// This is the D-decomposition. @return nothing where the two equations are dependent (no finite
/// gains)
template <class Scalar, int Degree>
std::optional<PdGains<Scalar>> gains_with_root(const AffinePolynomial<Scalar, Degree>& polynomial,
                                               const std::complex<Scalar>& x) {
  const std::complex<Scalar> base = evaluate(polynomial.base, x);
  const std::complex<Scalar> p = evaluate(polynomial.proportional, x);
  const std::complex<Scalar> d = evaluate(polynomial.differential, x);
  const Scalar determinant = std::imag(std::conj(p) * d);
  const PdGains<Scalar> gains{-std::imag(std::conj(base) * d) / determinant,
                              std::imag(std::conj(base) * p) / determinant};
  if (!std::isfinite(gains.proportional) || !std::isfinite(gains.differential)) return std::nullopt;
  return gains;
}

/// μ = e^{iθ} − 1 without cancellation: −2 sin²(θ/2) + i sin θ.
template <class Scalar>
std::complex<Scalar> unit_circle_minus_one(const Scalar& angle) {
  const Scalar half_sine = std::sin(angle / Scalar(2));
  return {Scalar(-2) * half_sine * half_sine, std::sin(angle)};
}

/// Gains of the sampled loop with a root pair e^{±iθ}, 0 < θ < π.
/// @param polynomial  `characteristic_polynomial(loop)`, in powers of λ − 1
/// @param angle       θ (rad), 0 < θ < π
/// @return nothing where no finite gains have that pair
template <class Scalar>
std::optional<PdGains<Scalar>> complex_pair_gains(const AffinePolynomial<Scalar, 5>& polynomial,
                                                  const Scalar& angle) {
  return gains_with_root(polynomial, unit_circle_minus_one(angle));
}

namespace detail {

/// The two ends of a line within a P range; D = ∓∞ where it is vertical.
template <class Scalar>
void append_line(std::vector<BoundaryPoint<Scalar>>& points, const BoundaryLine<Scalar>& line,
                 const ProportionalRange& range) {
  constexpr Scalar infinity = std::numeric_limits<Scalar>::infinity();
  const Scalar lower(range.lower), upper(range.upper);
  if (!line.is_vertical()) {
    for (const Scalar& p : {lower, upper}) {
      points.push_back({line.curve, line.angle, {p, line.differential_at(p)}});
    }
    return;
  }
  const Scalar p = line.proportional_at(Scalar(0));
  if (!(p >= lower && p <= upper)) return;
  points.push_back({line.curve, line.angle, {p, -infinity}});
  points.push_back({line.curve, line.angle, {p, infinity}});
}

/// Y of the traced pairs: from 10⁻⁶ of the plant's mean root up to 10⁶ of it, or for the sampled
/// loop to θ = π − 2·10⁻⁶.
template <class Scalar, int Degree>
Interval<Scalar> traced_squares(const BoundaryCurves<Scalar, Degree>& curves) {
  const Scalar largest = curves.sampled ? Scalar(1e6) / curves.pairs().unit() : Scalar(1e6);
  return {Scalar(1e-12), largest * largest};
}

}  // namespace detail

/// The whole boundary over a range of P: first the lines (their two ends), then the curve of root
/// pairs (ascending angle), its points as close together as its bends need, and exactly at the ends
/// of the range.
///
/// Sampled loop (degree 5): λ = +1, λ = −1 and λ = e^{±iθ}. Continuous loop (degree 4): s = 0 and
/// s = ±iω. A line that the plant does not have (no gain moves the root there) is absent; λ = +1
/// and s = 0 are absent for the two-mass plant, whose force moves no static equilibrium.
/// @param polynomial  `characteristic_polynomial(loop)`, in powers of λ − 1, or
/// `characteristic_polynomial(plant)`, in s
/// @param range       P (N/m), its ends included
/// @throws InvalidParameter unless range.lower < range.upper, both finite
template <class Scalar, int Degree>
std::vector<BoundaryPoint<Scalar>> stability_boundary(
    const AffinePolynomial<Scalar, Degree>& polynomial, const ProportionalRange& range) {
  validate(range);
  const BoundaryCurves<Scalar, Degree> curves(polynomial);
  std::vector<BoundaryPoint<Scalar>> points;
  for (const auto& line : curves.lines()) detail::append_line(points, line, range);
  const detail::CurveTracer<Scalar, Degree> tracer(curves, range);
  tracer.trace(detail::traced_squares(curves), points);
  return points;
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template std::vector<BoundaryPoint<double>> stability_boundary(
    const AffinePolynomial<double, 4>&, const ProportionalRange&);
extern template std::vector<BoundaryPoint<double>> stability_boundary(
    const AffinePolynomial<double, 5>&, const ProportionalRange&);
#endif

}  // namespace holdfast
