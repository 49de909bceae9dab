#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "holdfast/control/gains.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/math/poly/polynomial.hpp"
#include "holdfast/stability/boundary/boundary_point.hpp"
#include "holdfast/stability/boundary/root_pair_curve.hpp"
#include "holdfast/stability/polynomial/characteristic_polynomial.hpp"

namespace holdfast {

/// A straight part of the boundary, on which a real root sits at λ = ±1 (continuous loop: s = 0):
///
///     constant + P · proportional + D · differential = 0
template <class Scalar>
struct BoundaryLine {
  BoundaryCurve curve;  ///< `plus_one`, `minus_one` or `zero`
  Scalar angle;         ///< θ = 0 or π (rad); ω = 0 (rad/s) for the continuous loop
  Scalar constant;      ///< the polynomial without control at the root's place
  Scalar proportional;  ///< its change per N/m of P; 0 where P does not move the root
  Scalar differential;  ///< its change per N s/m of D; 0 where D does not move the root

  /// Velocity feedback is idle there: the line is P = const.
  bool is_vertical() const { return differential == Scalar(0); }

  /// P (N/m) of the line at D (N s/m); infinite where P does not move it.
  Scalar proportional_at(const Scalar& differential_gain) const {
    return -(constant + differential_gain * differential) / proportional;
  }

  /// D (N s/m) of the line at P (N/m); infinite where it is vertical.
  Scalar differential_at(const Scalar& proportional_gain) const {
    return -(constant + proportional_gain * proportional) / differential;
  }
};

namespace detail {

/// The two ends of a line within a P range; D = ∓∞ where it is vertical.
template <class Scalar>
void append_line(std::vector<BoundaryPoint<Scalar>>& points, const BoundaryLine<Scalar>& line,
                 const Interval<double>& range) {
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

}  // namespace detail

/// All curves of the gain plane on which a characteristic root is on the boundary of stability: the
/// curve of root pairs, parametrised by Y (`RootPairCurve`), and at most two lines.
///
/// The sampled loop (degree 5) is treated in w, λ = (1 + w)/(1 − w), with Y = tan²(θ/2), the
/// continuous loop (degree 4) in s with Y = ω², both but for the unit of Y. A line that no gain
/// moves is none.
template <class Scalar, int Degree>
class BoundaryCurves {
 public:
  /// True for the sampled loop (degree 5), false for the continuous one (degree 4).
  static constexpr bool sampled = Degree == 5;

  /// @param polynomial  `characteristic_polynomial` of the sampled loop or of the continuous one
  explicit BoundaryCurves(const AffinePolynomial<Scalar, Degree>& polynomial)
      : polynomial_(in_half_plane(polynomial)), pairs_(polynomial_) {
    add_line(polynomial, sampled ? BoundaryCurve::plus_one : BoundaryCurve::zero, Scalar(0),
             Scalar(0));
    // λ − 1 = −2
    if (sampled) add_line(polynomial, BoundaryCurve::minus_one, pi<Scalar>, Scalar(-2));
  }

  /// The polynomial in the variable whose stable half-plane is Re < 0.
  const HalfPlanePolynomial<Scalar, Degree>& polynomial() const { return polynomial_; }

  /// The curve of root pairs, parametrised by Y.
  const RootPairCurve<Scalar>& pairs() const { return pairs_; }
  /// Boundary lines that a gain moves, λ = +1 (s = 0) before λ = −1: none, one or two.
  const std::vector<BoundaryLine<Scalar>>& lines() const { return lines_; }

  /// Kind of a point of `pairs()`: `complex_pair`, or `imaginary_pair` in the continuous loop.
  BoundaryCurve pair_kind() const {
    return sampled ? BoundaryCurve::complex_pair : BoundaryCurve::imaginary_pair;
  }

  /// The gains of the pair that belongs to Y; infinite at a pole.
  PdGains<Scalar> gains(const Scalar& square) const { return pairs_.gains(square); }

  /// The middle of two Y, in ln Y.
  static Scalar between(const Scalar& lower, const Scalar& upper) {
    return std::sqrt(lower) * std::sqrt(upper);
  }

  /// θ (rad) of the pair λ = e^{±iθ} that belongs to Y, or ω (rad/s) of s = ±iω.
  Scalar angle(const Scalar& square) const {
    const Scalar y = pairs_.root(square);
    return sampled ? Scalar(2) * std::atan(y) : y;
  }

 private:
  /// No root without control has a larger modulus than twice this (Fujiwara).
  static Scalar root_bound(const Polynomial<Scalar, Degree>& base) {
    Scalar largest(0);
    for (int k = 0; k < Degree; ++k) {
      const Scalar size = std::abs(base[k] / base[Degree]);
      largest = std::max(largest, Scalar(std::pow(size, Scalar(1) / Scalar(Degree - k))));
    }
    return largest;
  }

  /// The line on which the polynomial vanishes at x. A gain whose part there is only round-off of
  /// its coefficients does not move the root: below 1e−13 of the largest at s = 0, s in units of
  /// the fastest root; below 1e−9 at λ = ±1, since the matrix exponential is less exact.
  void add_line(const AffinePolynomial<Scalar, Degree>& polynomial, BoundaryCurve curve,
                const Scalar& angle, const Scalar& x) {
    const Scalar unit = sampled ? Scalar(1) : root_bound(polynomial.base);
    const Scalar round_off(sampled ? 1e-9 : 1e-13);
    const auto slope = [&](const Polynomial<Scalar, Degree>& part) {
      const Scalar value = evaluate(part, x);
      const Scalar size = rescaled(part, unit).cwiseAbs().maxCoeff();
      return std::abs(value) > round_off * size ? value : Scalar(0);
    };
    const BoundaryLine<Scalar> line{curve, angle, evaluate(polynomial.base, x),
                                    slope(polynomial.proportional), slope(polynomial.differential)};
    if (line.proportional != Scalar(0) || line.differential != Scalar(0)) lines_.push_back(line);
  }

  HalfPlanePolynomial<Scalar, Degree> polynomial_;
  RootPairCurve<Scalar> pairs_;
  std::vector<BoundaryLine<Scalar>> lines_;
};

}  // namespace holdfast
