#pragma once

#include <vector>

#include "holdfast/control/gains.hpp"
#include "holdfast/core/interval.hpp"
#include "holdfast/math/poly/polynomial.hpp"
#include "holdfast/stability/boundary/boundary_curves.hpp"
#include "holdfast/stability/boundary/boundary_point.hpp"
#include "holdfast/stability/boundary/curve_tracer.hpp"
#include "holdfast/stability/polynomial/affine_polynomial.hpp"

namespace holdfast {

namespace detail {

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
