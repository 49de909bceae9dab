#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <optional>
#include <vector>

#include "holdfast/core/errors.hpp"
#include "holdfast/core/interval.hpp"
#include "holdfast/core/polynomial.hpp"
#include "holdfast/stability/affine_polynomial.hpp"

namespace holdfast {

/// Where a characteristic root crosses as the gains cross a boundary curve.
enum class BoundaryCurve {
  plus_one,  ///< sampled loop: real root λ = +1 (divergence)
  minus_one,  ///< sampled loop: real root λ = −1 (flip: the force alternates from sample to sample)
  complex_pair,    ///< sampled loop: pair λ = e^{±iθ} (oscillation)
  zero,            ///< continuous loop: real root s = 0
  imaginary_pair,  ///< continuous loop: pair s = ±iω
};

/// One point of the boundary in the gain plane.
template <class Scalar>
struct BoundaryPoint {
  BoundaryCurve curve;
  Scalar angle;  ///< θ (rad) of the sampled loop's root, 0 … π; ω (rad/s) for the continuous loop
  PdGains<Scalar> gains;
};

/// A range of proportional gains, N/m.
struct ProportionalRange {
  double lower;
  double upper;
};

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

/// Follows one curve of root pairs from angle to angle and keeps what lies in the P range.
///
/// Starts from geometrically spaced tan(θ/2)-like parameters and halves each step until the curve's
/// middle lies on its chord to 1/500 of its length or the step no longer matters.
template <class Scalar, class GainsAt>
class CurveTracer {
 public:
  CurveTracer(BoundaryCurve curve, ProportionalRange range, GainsAt gains_at)
      : curve_(curve), range_(range), gains_at_(std::move(gains_at)) {}

  void trace(const Scalar& from, const Scalar& to,
             std::vector<BoundaryPoint<Scalar>>& points) const {
    const auto start = gains_at_(from), end = gains_at_(to);
    if (start && inside(*start)) points.push_back({curve_, from, *start});
    refine(from, start, to, end, deepest_, points);
  }

 private:
  using Gains = std::optional<PdGains<Scalar>>;
  static constexpr int deepest_ = 14;

  bool inside(const PdGains<Scalar>& gains) const {
    return gains.proportional >= Scalar(range_.lower) && gains.proportional <= Scalar(range_.upper);
  }

  void refine(const Scalar& from, const Gains& start, const Scalar& to, const Gains& end, int depth,
              std::vector<BoundaryPoint<Scalar>>& points) const {
    const Scalar middle = (from + to) / Scalar(2);
    const Gains between = gains_at_(middle);
    if (depth == 0 || !worth_splitting(start, between, end)) return;
    refine(from, start, middle, between, depth - 1, points);
    if (inside(*between)) points.push_back({curve_, middle, *between});
    refine(middle, between, to, end, depth - 1, points);
  }

  bool worth_splitting(const Gains& start, const Gains& between, const Gains& end) const {
    if (!start || !between || !end) return false;
    // A narrow range may lie between two points: what counts is whether the curve passes through
    // it.
    const auto [lowest, highest] =
        std::minmax({start->proportional, between->proportional, end->proportional});
    if (highest < Scalar(range_.lower) || lowest > Scalar(range_.upper)) return false;
    if (!inside(*start) || !inside(*between) || !inside(*end)) return true;
    return deviation(*start, *between, *end) > Scalar(0.002) || width(*start, *end) > Scalar(0.01);
  }

  Scalar width(const PdGains<Scalar>& a, const PdGains<Scalar>& b) const {
    return std::abs(a.proportional - b.proportional) / Scalar(range_.upper - range_.lower);
  }

  /// Distance of the middle from the chord's middle, in units of the P range and of the D in
  /// question.
  Scalar deviation(const PdGains<Scalar>& a, const PdGains<Scalar>& m,
                   const PdGains<Scalar>& b) const {
    const Scalar d_scale = std::abs(a.differential) + std::abs(b.differential) + Scalar(1e-12);
    const Scalar p_off = m.proportional - (a.proportional + b.proportional) / Scalar(2);
    const Scalar d_off = m.differential - (a.differential + b.differential) / Scalar(2);
    return std::hypot(p_off / Scalar(range_.upper - range_.lower), d_off / d_scale);
  }

  BoundaryCurve curve_;
  ProportionalRange range_;
  GainsAt gains_at_;
};

/// Traces a root-pair curve over angles of which a parameter takes geometric steps, 40 a decade.
template <class Scalar, class GainsAt, class AngleOf>
void append_pairs(std::vector<BoundaryPoint<Scalar>>& points, BoundaryCurve curve,
                  const ProportionalRange& range, const Interval<Scalar>& parameter,
                  GainsAt gains_at, AngleOf angle_of) {
  const CurveTracer<Scalar, GainsAt> tracer(curve, range, std::move(gains_at));
  const Scalar decades = std::log10(parameter.upper / parameter.lower);
  const int steps = static_cast<int>(std::ceil(Scalar(40) * decades));
  Scalar from = angle_of(parameter.lower);
  for (int k = 1; k <= steps; ++k) {
    const Scalar exponent = decades * Scalar(k) / Scalar(steps);
    const Scalar to = angle_of(parameter.lower * std::pow(Scalar(10), exponent));
    tracer.trace(from, to, points);
    from = to;
  }
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
  require_finite("lower end of the proportional gains", range.lower, "N/m");
  require_positive("width of the range of proportional gains", range.upper - range.lower, "N/m");
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
  require_finite("lower end of the proportional gains", range.lower, "N/m");
  require_positive("width of the range of proportional gains", range.upper - range.lower, "N/m");
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
