#pragma once

#include <cmath>
#include <complex>
#include <limits>
#include <optional>
#include <vector>

#include "holdfast/control/gains.hpp"
#include "holdfast/core/polynomial.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/stability/affine_polynomial.hpp"
#include "holdfast/stability/boundary_point.hpp"
#include "holdfast/stability/curve_tracer.hpp"

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
template <class Scalar>
std::optional<PdGains<Scalar>> complex_pair_gains(const AffinePolynomial<Scalar, 5>& polynomial,
                                                  const Scalar& angle) {
  return gains_with_root(polynomial, unit_circle_minus_one(angle));
}

/// Gains of the continuous loop with a root pair ±iω, ω > 0.
/// @param polynomial  `characteristic_polynomial(plant)`, in s
template <class Scalar>
std::optional<PdGains<Scalar>> imaginary_pair_gains(const AffinePolynomial<Scalar, 4>& polynomial,
                                                    const Scalar& angular_frequency) {
  return gains_with_root(polynomial, std::complex<Scalar>(0, angular_frequency));
}

namespace detail {

/// The two ends, within a P range, of the line base + P p + D d = 0 on which a real root sits at
/// `x`.
///
/// A line without D (velocity feedback is idle at λ = 1 and at s = 0) is vertical: its ends are D =
/// ∓∞.
template <class Scalar, int Degree>
void append_line(std::vector<BoundaryPoint<Scalar>>& points, BoundaryCurve curve,
                 const Scalar& angle, const AffinePolynomial<Scalar, Degree>& polynomial,
                 const Scalar& x, const ProportionalRange& range) {
  constexpr Scalar infinity = std::numeric_limits<Scalar>::infinity();
  const Scalar base = evaluate(polynomial.base, x);
  const Scalar p = evaluate(polynomial.proportional, x);
  const Scalar d = evaluate(polynomial.differential, x);
  if (std::abs(d) > Scalar(1e-9) * polynomial.differential.cwiseAbs().maxCoeff()) {
    for (const Scalar end : {Scalar(range.lower), Scalar(range.upper)}) {
      points.push_back({curve, angle, {end, -(base + end * p) / d}});
    }
    return;
  }
  if (std::abs(p) <= Scalar(1e-9) * polynomial.proportional.cwiseAbs().maxCoeff()) return;
  const Scalar vertical = -base / p;
  if (!(vertical >= Scalar(range.lower) && vertical <= Scalar(range.upper))) return;
  points.push_back({curve, angle, {vertical, -infinity}});
  points.push_back({curve, angle, {vertical, infinity}});
}

}  // namespace detail

/// The whole boundary of the sampled loop over a range of P: the lines λ = +1 and λ = −1 (their two
/// ends) and the curve λ = e^{±iθ} (ascending θ). A line that the plant does not have (no gain
/// moves the root there) is absent; λ = +1 is absent for the two-mass plant, whose force moves no
/// static equilibrium. θ runs from 10⁻⁴ of the plant's mean root angle to π − 2·10⁻⁶.
/// @param polynomial  `characteristic_polynomial(loop)`, in powers of λ − 1
/// @throws InvalidParameter unless range.lower < range.upper, both finite
template <class Scalar>
std::vector<BoundaryPoint<Scalar>> stability_boundary(const AffinePolynomial<Scalar, 5>& polynomial,
                                                      const ProportionalRange& range) {
  validate(range);
  std::vector<BoundaryPoint<Scalar>> points;
  // Mean |μ| of the plant's four roots; the fifth, of the stored force, is near −1.
  const Scalar plant_root = std::pow(std::abs(polynomial.base[0]), Scalar(0.25));
  detail::append_line(points, BoundaryCurve::plus_one, Scalar(0), polynomial, Scalar(0), range);
  detail::append_line(points, BoundaryCurve::minus_one, pi<Scalar>, polynomial, Scalar(-2), range);
  detail::append_pairs(
      points, BoundaryCurve::complex_pair, range, {Scalar(1e-4) * plant_root, Scalar(1e6)},
      [&polynomial](const Scalar& angle) { return complex_pair_gains(polynomial, angle); },
      [](const Scalar& parameter) { return Scalar(2) * std::atan(parameter); });
  return points;
}

/// The whole boundary of the continuous loop over a range of P: the line s = 0 (absent where no
/// gain moves a root there) and the curve s = ±iω (ascending ω, four decades on either side of the
/// plant's mean root).
/// @param polynomial  `characteristic_polynomial(plant)`, in s
/// @throws InvalidParameter unless range.lower < range.upper, both finite
template <class Scalar>
std::vector<BoundaryPoint<Scalar>> stability_boundary(const AffinePolynomial<Scalar, 4>& polynomial,
                                                      const ProportionalRange& range) {
  validate(range);
  std::vector<BoundaryPoint<Scalar>> points;
  const Scalar plant_root =
      std::pow(std::abs(polynomial.base[0] / polynomial.base[4]), Scalar(0.25));
  detail::append_line(points, BoundaryCurve::zero, Scalar(0), polynomial, Scalar(0), range);
  detail::append_pairs(
      points, BoundaryCurve::imaginary_pair, range,
      {Scalar(1e-4) * plant_root, Scalar(1e4) * plant_root},
      [&polynomial](const Scalar& omega) { return imaginary_pair_gains(polynomial, omega); },
      [](const Scalar& omega) { return omega; });
  return points;
}

}  // namespace holdfast
