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

/// Straight line of the stability boundary in the plane of the gains P and D. On it λ = +1 or −1 is
/// a root of the sampled loop, or s = 0 of the continuous loop:
///
///     constant + P · proportional + D · differential = 0
template <class Scalar>
struct BoundaryLine {
  BoundaryCurve curve;  ///< kind of the line: `plus_one`, `minus_one` or `zero`
  Scalar angle;         ///< θ of the root, 0 or π (rad); for the continuous loop ω = 0 (rad/s)
  Scalar constant;      ///< characteristic polynomial at the root, without control (P = D = 0)
  Scalar proportional;  ///< polynomial's derivative by P at the root, per N/m; 0: no effect
  Scalar differential;  ///< polynomial's derivative by D at the root, per N s/m; 0: no effect

  /// Whether P is constant along the line, that is, `differential` is 0.
  bool is_vertical() const { return differential == Scalar(0); }

  /// The P (N/m) on the line at a given D (N s/m); not finite where `proportional` is 0.
  Scalar proportional_at(const Scalar& differential_gain) const {
    return -(constant + differential_gain * differential) / proportional;
  }

  /// The D (N s/m) on the line at a given P (N/m); not finite where the line is vertical.
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

/// All curves in the plane of P and D on which a characteristic root is on the stability boundary:
/// the curve of root pairs with parameter Y (`RootPairCurve`), and at most two straight lines.
///
/// In the sampled loop (degree 5) the polynomial's variable is w with λ = (1 + w)/(1 − w); roots
/// e^{±iθ} have Y = tan²(θ/2)/unit². In the continuous loop (degree 4) the variable is s; roots ±iω
/// have Y = ω²/unit²; unit is `RootPairCurve::unit()`. A line is absent if no gain moves its root.
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

  /// The characteristic polynomial in the variable w or s, whose stable half-plane is Re < 0.
  const HalfPlanePolynomial<Scalar, Degree>& polynomial() const { return polynomial_; }

  /// The curve of root pairs, with P and D as functions of its parameter Y.
  const RootPairCurve<Scalar>& pairs() const { return pairs_; }
  /// The straight lines of the boundary, at most two: first λ = +1 (or s = 0), then λ = −1.
  const std::vector<BoundaryLine<Scalar>>& lines() const { return lines_; }

  /// The kind of the root pairs: `complex_pair`, or `imaginary_pair` in the continuous loop.
  BoundaryCurve pair_kind() const {
    return sampled ? BoundaryCurve::complex_pair : BoundaryCurve::imaginary_pair;
  }

  /// The gains P and D of the curve of root pairs at the parameter Y; not finite at a pole.
  PdGains<Scalar> gains(const Scalar& square) const { return pairs_.gains(square); }

  /// The geometric mean of two positive parameters Y.
  static Scalar between(const Scalar& lower, const Scalar& upper) {
    return std::sqrt(lower) * std::sqrt(upper);
  }

  /// The angle θ (rad) of the pair e^{±iθ} at Y, or ω (rad/s) of ±iω in the continuous loop.
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

  /// Adds the line of gains for which x (λ − 1 or s) is a root. A gain that does not move this root
  /// gets the coefficient 0: its part of the polynomial at x is then round-off, below 1e−9 of the
  /// part's largest coefficient (continuous loop: 1e−13, s in units of `root_bound`).
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
