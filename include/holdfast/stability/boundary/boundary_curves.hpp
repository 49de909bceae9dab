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

/// Straight line of the stability boundary in the plane of the gains P and D. For gains on the line
/// the sampled loop has the root λ = +1 or −1, or the continuous loop the root s = 0:
///
///     constant + P · proportional + D · differential = 0
template <class Scalar>
struct BoundaryLine {
  BoundaryCurve curve;  ///< kind of the line: `plus_one`, `minus_one` or `zero`
  Scalar angle;         ///< θ (rad) of the root e^{iθ}, 0 or π; 0 for the root s = 0
  Scalar constant;      ///< value of the characteristic polynomial at the root for P = D = 0
  Scalar proportional;  ///< derivative of this value by P, per N/m; 0: P does not move the root
  Scalar differential;  ///< derivative of this value by D, per N s/m; 0: D does not move the root

  /// Whether P is constant along the line, that is, `differential` is 0.
  bool is_vertical() const { return differential == Scalar(0); }

  /// The gain P (N/m) on the line at a given D (N s/m); not finite if `proportional` is 0.
  Scalar proportional_at(const Scalar& differential_gain) const {
    return -(constant + differential_gain * differential) / proportional;
  }

  /// The gain D (N s/m) on the line at a given P (N/m); not finite if the line is vertical.
  Scalar differential_at(const Scalar& proportional_gain) const {
    return -(constant + proportional_gain * proportional) / differential;
  }
};

namespace detail {

/// Appends the two ends of a line within a range of P; a vertical line has its ends at D = ∓∞.
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

/// All curves of the stability boundary in the plane of P and D: the curve of root pairs with the
/// parameter Y (`RootPairCurve`), and at most two straight lines (`BoundaryLine`).
///
/// For the sampled loop (degree 5) the polynomial's variable is w with λ = (1 + w)/(1 − w); the
/// pair e^{±iθ} has Y = tan²(θ/2)/unit². For the continuous loop (degree 4) it is s; the pair ±iω
/// has Y = ω²/unit²; unit is `RootPairCurve::unit()`. A line is absent if no gain moves its root.
template <class Scalar, int Degree>
class BoundaryCurves {
 public:
  /// True for the sampled loop (degree 5), false for the continuous one (degree 4).
  static constexpr bool sampled = Degree == 5;

  /// @param polynomial  `characteristic_polynomial` of the sampled or the continuous loop
  explicit BoundaryCurves(const AffinePolynomial<Scalar, Degree>& polynomial)
      : polynomial_(in_half_plane(polynomial)), pairs_(polynomial_) {
    add_line(polynomial, sampled ? BoundaryCurve::plus_one : BoundaryCurve::zero, Scalar(0),
             Scalar(0));
    // λ − 1 = −2
    if (sampled) add_line(polynomial, BoundaryCurve::minus_one, pi<Scalar>, Scalar(-2));
  }

  /// The characteristic polynomial in the variable w or s, in which stable roots have Re < 0.
  const HalfPlanePolynomial<Scalar, Degree>& polynomial() const { return polynomial_; }

  /// The curve of root pairs, with P and D as functions of its parameter Y.
  const RootPairCurve<Scalar>& pairs() const { return pairs_; }
  /// The straight lines of the boundary, at most two: first root λ = +1 (or s = 0), then λ = −1.
  const std::vector<BoundaryLine<Scalar>>& lines() const { return lines_; }

  /// The kind of the root pairs: `complex_pair`, or `imaginary_pair` in the continuous loop.
  BoundaryCurve pair_kind() const {
    return sampled ? BoundaryCurve::complex_pair : BoundaryCurve::imaginary_pair;
  }

  /// The gains on the curve of root pairs at Y = `square`; not finite at a pole of P(Y) or D(Y).
  PdGains<Scalar> gains(const Scalar& square) const { return pairs_.gains(square); }

  /// The geometric mean of two positive parameters Y, to divide the curve between them.
  static Scalar between(const Scalar& lower, const Scalar& upper) {
    return std::sqrt(lower) * std::sqrt(upper);
  }

  /// The angle θ (rad) of the pair e^{±iθ} at Y = `square`; continuous loop: ω (rad/s) of ±iω.
  Scalar angle(const Scalar& square) const {
    const Scalar y = pairs_.root(square);
    return sampled ? Scalar(2) * std::atan(y) : y;
  }

 private:
  /// Half of a bound on the moduli of the roots of the polynomial without control.
  static Scalar root_bound(const Polynomial<Scalar, Degree>& base) {
    Scalar largest(0);
    for (int k = 0; k < Degree; ++k) {
      const Scalar size = std::abs(base[k] / base[Degree]);
      largest = std::max(largest, Scalar(std::pow(size, Scalar(1) / Scalar(Degree - k))));
    }
    return largest;
  }

  /// Adds the line of gains with the root x (λ − 1 or s). The value of a part of the polynomial is
  /// round-off if below 1e−9 of its largest coefficient (s: 1e−13, in units of `root_bound`).
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
