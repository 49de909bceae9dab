#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "holdfast/math/poly/polynomial.hpp"
#include "holdfast/stability/boundary/root_pair_curve.hpp"

namespace holdfast {

/// A monotone arc of the curve of root pairs read backwards: Y, and so D, as a function of P.
template <class Scalar>
class ArcCrossing {
 public:
  /// @param curve  must outlive this object
  /// @param arc    one of `curve.arcs()`; copied
  ArcCrossing(const RootPairCurve<Scalar>& curve, const MonotoneArc<Scalar>& arc)
      : curve_(&curve), arc_(arc), rising_(rises(curve, arc)) {}

  /// The arc as it was given; its ends may lie at Y = 0 and Y = ∞.
  const MonotoneArc<Scalar>& arc() const { return arc_; }

  /// True where P grows with Y.
  bool rising() const { return rising_; }

  /// Y at which P takes the value (N/m), to round-off: Newton's method, and where its steps do not
  /// shrink or leave the bracket, halving the bracket in ln Y. The nearer end of the arc where the
  /// arc does not take the value.
  Scalar square(const Scalar& proportional_gain) const {
    MonotoneArc<Scalar> bracket = bounded();
    Scalar square = bracket.inside(), last_step = square;
    for (int iteration = 0; iteration < 400; ++iteration) {
      const auto at = curve_->residual(square, proportional_gain);
      const bool below = (at.value < Scalar(0)) != (at.denominator < Scalar(0));
      (below == rising_ ? bracket.start : bracket.end).square = square;
      const Scalar step = at.value / at.slope, next = square - step, inside = bracket.inside();
      if (std::abs(step) <= std::numeric_limits<Scalar>::epsilon() * square) break;
      if (!(bracket.start.square < inside && inside < bracket.end.square)) break;
      const bool shrinks = std::abs(step) < std::abs(last_step) / Scalar(2);
      const bool stays = next > bracket.start.square && next < bracket.end.square;
      last_step = shrinks && stays ? step : bracket.end.square - bracket.start.square;
      square = shrinks && stays ? next : inside;
    }
    return square;
  }

  /// D (N s/m) on the arc at P (N/m), from the even or the odd part, whichever holds D better:
  /// D = −(b + P p) / d.
  Scalar differential(const Scalar& proportional_gain) const {
    const Scalar y2 = square(proportional_gain);
    const Scalar even_slope = evaluate(curve_->differential().even, y2);
    const Scalar odd_slope = evaluate(curve_->differential().odd, y2);
    const bool even = even_slope * even_slope > odd_slope * odd_slope * y2;
    const auto part = even ? &ParityParts<Scalar>::even : &ParityParts<Scalar>::odd;
    return -(evaluate(curve_->base().*part, y2) +
             proportional_gain * evaluate(curve_->proportional().*part, y2)) /
           (even ? even_slope : odd_slope);
  }

 private:
  /// Y = 0 and ∞ put off to where all powers of Y are still numbers, and P is that of the end.
  MonotoneArc<Scalar> bounded() const {
    const Scalar largest = std::pow(std::numeric_limits<Scalar>::max(), Scalar(0.125));
    MonotoneArc<Scalar> result = arc_;
    result.start.square = std::max(result.start.square, Scalar(1) / largest);
    result.end.square = std::min(result.end.square, largest);
    return result;
  }

  static bool rises(const RootPairCurve<Scalar>& curve, const MonotoneArc<Scalar>& arc) {
    const Scalar middle = arc.inside();
    MonotoneArc<Scalar> first_half = arc;
    first_half.end.square = middle;
    return curve.gains(first_half.inside()).proportional < curve.gains(middle).proportional;
  }

  const RootPairCurve<Scalar>* curve_;
  MonotoneArc<Scalar> arc_;
  bool rising_;
};

}  // namespace holdfast
