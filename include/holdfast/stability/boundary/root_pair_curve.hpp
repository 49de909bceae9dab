#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "holdfast/control/gains.hpp"
#include "holdfast/math/poly/polynomial.hpp"
#include "holdfast/stability/polynomial/characteristic_polynomial.hpp"

namespace holdfast {

/// End of a `MonotoneArc`: its parameter Y and the values of n and Δ at this Y, with P(Y) = n/Δ of
/// `RootPairCurve`. For Y = 0 (∞): their coefficients of the lowest (highest) power of Y.
template <class Scalar>
struct ArcEnd {
  Scalar square;     ///< parameter Y, 0 … ∞
  Scalar numerator;  ///< numerator n of P; n/|Y − Y_end| at a pole of D at which P is finite
  Scalar denominator;  ///< denominator Δ of P, 0 at a pole of P; Δ/|Y − Y_end| if only D has a pole

  /// The residual n − P Δ for a given P (N/m). P is on an arc if the signs at its ends differ.
  Scalar residual(const Scalar& proportional_gain) const {
    return numerator - proportional_gain * denominator;
  }
};

/// Arc: a part of the `RootPairCurve` on which P is finite and a monotone function of Y.
template <class Scalar>
struct MonotoneArc {
  ArcEnd<Scalar> start;  ///< end at the lower Y ≥ 0
  ArcEnd<Scalar> end;    ///< end at the upper Y ≤ ∞

  /// Whether P has the given value (N/m) somewhere on the arc.
  bool passes(const Scalar& proportional_gain) const {
    return (start.residual(proportional_gain) < Scalar(0)) !=
           (end.residual(proportional_gain) < Scalar(0));
  }

  /// A value of Y inside the arc: the geometric mean of the ends if both are finite and not 0.
  Scalar inside() const {
    if (std::isinf(end.square)) return start.square > 0 ? Scalar(2) * start.square : Scalar(1);
    if (!(start.square > Scalar(0))) return end.square / Scalar(2);
    return std::sqrt(start.square) * std::sqrt(end.square);
  }
};

/// Crossing of a line of constant P with the stability boundary in the plane of P and D.
template <class Scalar>
struct RowCrossing {
  Scalar differential;  ///< D of the crossing (N s/m)
  Scalar uncertainty;   ///< upper bound on the round-off error of D (N s/m)
};

/// Curve of the gains P and D at which the loop has a root pair w = ±iy on the imaginary axis. P
/// and D are rational functions of the parameter Y = (y/unit)², with the scale `unit()` of w.
/// Sampled loop: λ = (1 + w)/(1 − w) and y = tan(θ/2) for a pair e^{±iθ}. Continuous loop: w = s
/// and y = ω (rad/s).
///
/// The characteristic polynomial is b + P p + D d. Each polynomial a = b, p or d is divided into an
/// even and an odd part, a(iy) = a_e(Y) + iy a_o(Y), with y in units of `unit()`. Then
///
///     P(Y) = (b_o d_e − b_e d_o) / Δ,   D(Y) = (b_e p_o − b_o p_e) / Δ,   Δ(Y) = p_e d_o − p_o d_e
///
/// Both numerators and Δ have a degree of at most 4. Coefficients of p and d that are only
/// round-off of larger ones are set to zero.
template <class Scalar>
class RootPairCurve {
 public:
  /// @param polynomial  characteristic polynomial whose stable roots have Re < 0, from
  ///                    `in_half_plane` for the sampled loop
  template <int Degree>
  explicit RootPairCurve(const HalfPlanePolynomial<Scalar, Degree>& polynomial)
      : unit_(detail::mean_root_modulus(polynomial.base)),
        base_(polynomial.base, unit_),
        proportional_(detail::without_round_off(polynomial.proportional, unit_), unit_),
        differential_(detail::without_round_off(polynomial.differential, unit_), unit_),
        denominator_(cross(proportional_, differential_)),
        proportional_numerator_(cross(differential_, base_)),
        differential_numerator_(cross(base_, proportional_)) {}

  /// The scale of w in y = unit · √Y: geometric mean of the moduli of the roots w for P = D = 0.
  const Scalar& unit() const { return unit_; }

  /// The imaginary part y = unit · √Y of the root w at Y = `square`.
  Scalar root(const Scalar& square) const { return unit_ * std::sqrt(square); }

  /// The gains P and D at Y = `square`; not finite at a pole of P(Y) or D(Y).
  PdGains<Scalar> gains(const Scalar& square) const {
    const Scalar denominator = evaluate(denominator_, square);
    return {evaluate(proportional_numerator_, square) / denominator,
            evaluate(differential_numerator_, square) / denominator};
  }

  /// The numerator of P(Y), of degree ≤ 4.
  const Polynomial<Scalar, 4>& proportional_numerator() const { return proportional_numerator_; }
  /// The numerator of D(Y), of degree ≤ 4.
  const Polynomial<Scalar, 4>& differential_numerator() const { return differential_numerator_; }
  /// The common denominator Δ(Y) of P and D, of degree ≤ 4.
  const Polynomial<Scalar, 4>& denominator() const { return denominator_; }

  /// Point of the curve at which P has a given value.
  struct Place {
    Scalar square;           ///< parameter Y
    Scalar square_per_gain;  ///< derivative dY/dP (m/N)
  };

  /// The point of an arc at which P has a given value, by Newton's method for n − P Δ = 0 with the
  /// numerator n of P, with bisection where a step leaves the bracket or is over half the last one.
  /// @param arc                arc of this curve
  /// @param proportional_gain  P (N/m), which must occur on the arc (`MonotoneArc::passes`)
  /// @param guess              initial Y; any number, also NaN
  Place place(const MonotoneArc<Scalar>& arc, const Scalar& proportional_gain,
              const Scalar& guess) const {
    MonotoneArc<Scalar> bracket = arc;
    const bool negative_at_start = arc.start.residual(proportional_gain) < Scalar(0);
    Residual at{};
    Scalar square = guess, last_step = std::numeric_limits<Scalar>::infinity();
    for (int iteration = 0; iteration < 400; ++iteration) {
      if (!(square > bracket.start.square && square < bracket.end.square))
        square = bracket.inside();
      at = residual(square, proportional_gain);
      ((at.value < Scalar(0)) == negative_at_start ? bracket.start : bracket.end).square = square;
      const Scalar step = at.value / at.slope;
      if (std::abs(step) <= Scalar(2) * std::numeric_limits<Scalar>::epsilon() * square) break;
      const Scalar inside = bracket.inside();
      if (!(bracket.start.square < inside && inside < bracket.end.square)) break;
      const bool shrinks = std::abs(step) < std::abs(last_step) / Scalar(2);
      last_step = shrinks ? step : bracket.end.square - bracket.start.square;
      square = shrinks ? square - step : inside;
    }
    return {square, at.denominator / at.slope};
  }

  /// The parameter Y at which P has the given value (N/m) on an arc. If P does not occur on the
  /// arc: Y of the arc's end with the nearer P, as a positive finite number.
  Scalar square(MonotoneArc<Scalar> arc, const Scalar& proportional_gain) const {
    const Scalar largest = std::pow(std::numeric_limits<Scalar>::max(), Scalar(0.125));
    arc.start.square = std::max(arc.start.square, Scalar(1) / largest);
    arc.end.square = std::min(arc.end.square, largest);
    if (arc.passes(proportional_gain)) return place(arc, proportional_gain, arc.inside()).square;
    const auto distance = [&](const ArcEnd<Scalar>& end) {
      return std::abs(end.residual(proportional_gain) / end.denominator);
    };
    return distance(arc.start) < distance(arc.end) ? arc.start.square : arc.end.square;
  }

  /// The point of the curve with the given P (N/m), at its parameter Y = `square`. D is computed
  /// from the even or the odd part of the polynomial, from the one with less round-off.
  RowCrossing<Scalar> crossing(const Scalar& proportional_gain, const Scalar& square) const {
    const Scalar even_slope = evaluate(differential_.even, square);
    const Scalar odd_slope = evaluate(differential_.odd, square);
    const bool even = even_slope * even_slope > odd_slope * odd_slope * square;
    const auto part = even ? &ParityParts<Scalar>::even : &ParityParts<Scalar>::odd;
    const Scalar slope = even ? even_slope : odd_slope;
    const Vector<Scalar, 3>&base = base_.*part, &by_gain = proportional_.*part;
    const Vector<Scalar, 3> sum = base + proportional_gain * by_gain;
    const Vector<Scalar, 3> sizes =
        base.cwiseAbs() + std::abs(proportional_gain) * by_gain.cwiseAbs();
    return {-evaluate(sum, square) / slope, rounding * evaluate(sizes, square) / std::abs(slope)};
  }

  /// Upper bound on the round-off error of a polynomial's value, relative to Σ |its terms|.
  static constexpr Scalar rounding = Scalar(32) * std::numeric_limits<Scalar>::epsilon();

  /// Even and odd part of b, the polynomial at P = D = 0, with w in units of `unit()`.
  const ParityParts<Scalar>& base() const { return base_; }
  /// Even and odd part of p, the polynomial's derivative by P, per N/m.
  const ParityParts<Scalar>& proportional() const { return proportional_; }
  /// Even and odd part of d, the polynomial's derivative by D, per N s/m.
  const ParityParts<Scalar>& differential() const { return differential_; }

  /// Coefficients of the even or the odd part of the characteristic polynomial at given P and D.
  struct Terms {
    Vector<Scalar, 3> sum,  ///< coefficients b + P p + D d in powers of Y
        size;               ///< |b| + |P p| + |D d| of each coefficient, a measure of its round-off
  };

  /// The coefficients of the even or the odd part of the polynomial at given gains.
  /// @param part   pointer to member, `&ParityParts<Scalar>::even` or `odd`
  /// @param gains  P (N/m) and D (N s/m)
  Terms terms(Vector<Scalar, 3> ParityParts<Scalar>::*part, const PdGains<Scalar>& gains) const {
    const Vector<Scalar, 3>& b = base_.*part;
    const Vector<Scalar, 3> p = gains.proportional * (proportional_.*part);
    const Vector<Scalar, 3> d = gains.differential * (differential_.*part);
    return {b + p + d, b.cwiseAbs() + p.cwiseAbs() + d.cwiseAbs()};
  }

  /// The poles of the curve, ascending: values Y > 0 at which P or D is infinite.
  std::vector<Scalar> poles() const { return positive_roots(denominator_); }

  /// The Y > 0 at which dP/dY = 0, ascending; the curve has a tangent parallel to the D axis there.
  std::vector<Scalar> proportional_extremes() const {
    return positive_roots(slope(reduced(proportional_numerator_, differential_)));
  }

  /// The Y > 0 at which dD/dY = 0, ascending; the curve has a tangent parallel to the P axis there.
  std::vector<Scalar> differential_extremes() const {
    return positive_roots(slope(reduced(differential_numerator_, proportional_)));
  }

  /// All arcs of the curve by ascending Y: 0 < Y < ∞ is divided at poles and where dP/dY = 0.
  std::vector<MonotoneArc<Scalar>> arcs() const {
    const ArcEnd<Scalar> first = outer_end(Scalar(0), 0, 4),
                         last = outer_end(std::numeric_limits<Scalar>::infinity(), 4, 0);
    std::vector<Cut> cuts = {{first, first}, {last, last}};
    for (const Scalar& square : poles()) cuts.push_back(cut_at_pole(square));
    for (const Scalar& square : proportional_extremes()) {
      const ArcEnd<Scalar> end{square, evaluate(proportional_numerator_, square),
                               evaluate(denominator_, square)};
      cuts.push_back({end, end});
    }
    std::sort(cuts.begin(), cuts.end(),
              [](const Cut& a, const Cut& b) { return a.below.square < b.below.square; });
    std::vector<MonotoneArc<Scalar>> result;
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
      const MonotoneArc<Scalar> arc{cuts[k].above, cuts[k + 1].below};
      if (arc.start.square < arc.end.square) result.push_back(arc);
    }
    return result;
  }

 private:
  /// The value n − P Δ and its derivative by Y, with n and Δ the numerator and denominator of P.
  struct Residual {
    Scalar value, slope, denominator;
  };

  Residual residual(const Scalar& square, const Scalar& proportional_gain) const {
    const Polynomial<Scalar, 4>&n = proportional_numerator_, &d = denominator_;
    Scalar value = n[4] - proportional_gain * d[4], slope(0), denominator = d[4];
    for (int k = 3; k >= 0; --k) {
      slope = slope * square + value;
      value = value * square + (n[k] - proportional_gain * d[k]);
      denominator = denominator * square + d[k];
    }
    return {value, slope, denominator};
  }

  /// The difference a − c of two polynomials, with coefficients that are only round-off set to 0.
  template <int Size>
  static Vector<Scalar, Size> difference(const Vector<Scalar, Size>& a,
                                         const Vector<Scalar, Size>& c) {
    constexpr Scalar round_off = Scalar(8) * std::numeric_limits<Scalar>::epsilon();
    Vector<Scalar, Size> result = a - c;
    for (int k = 0; k < Size; ++k) {
      if (std::abs(result[k]) <= round_off * std::abs(a[k])) result[k] = Scalar(0);
    }
    return result;
  }

  /// The polynomial a_e c_o − a_o c_e in Y, of degree ≤ 4; it is Im(ā c)/y for a(iy) and c(iy).
  static Polynomial<Scalar, 4> cross(const ParityParts<Scalar>& a, const ParityParts<Scalar>& c) {
    return difference<5>(multiply<Scalar, 3, 3>(a.even, c.odd),
                         multiply<Scalar, 3, 3>(a.odd, c.even));
  }

  /// Cut of the curve at one Y, where the arc of smaller Y ends and the arc of larger Y starts.
  struct Cut {
    ArcEnd<Scalar> below, above;
  };

  struct Fraction {
    Polynomial<Scalar, 4> numerator, denominator;
  };

  /// The fraction numerator/Δ of P or D in lowest terms. Numerator and Δ have a common zero at each
  /// pole at which `factor` is 0; the factor is d(iy) for P and p(iy) for D.
  Fraction reduced(const Polynomial<Scalar, 4>& numerator,
                   const ParityParts<Scalar>& factor) const {
    Fraction result{numerator, denominator_};
    for (const Scalar& pole : poles()) {
      if (!vanishes(factor, pole)) continue;
      result.numerator = without_root<Scalar, 5>(result.numerator, pole);
      result.denominator = without_root<Scalar, 5>(result.denominator, pole);
    }
    return result;
  }

  static bool vanishes(const ParityParts<Scalar>& factor, const Scalar& square) {
    const Scalar even = evaluate(factor.even, square), odd = evaluate(factor.odd, square);
    const Scalar size =
        evaluate(factor.even.cwiseAbs() + std::sqrt(square) * factor.odd.cwiseAbs(), square);
    return std::abs(even) + std::sqrt(square) * std::abs(odd) <= Scalar(1e-12) * size;
  }

  /// The ends of the two arcs that meet at a pole, with n and Δ as stated at `ArcEnd`.
  Cut cut_at_pole(const Scalar& pole) const {
    const Polynomial<Scalar, 4>& numerator = proportional_numerator_;
    if (!vanishes(differential_, pole)) {
      const ArcEnd<Scalar> end{pole, evaluate(numerator, pole), Scalar(0)};
      return {end, end};
    }
    const Scalar above = evaluate(without_root<Scalar, 5>(numerator, pole), pole);
    const Scalar denominator = evaluate(without_root<Scalar, 5>(denominator_, pole), pole);
    return {{pole, -above, -denominator}, {pole, above, denominator}};
  }

  /// The polynomial n′ Δ − n Δ′ of a fraction n/Δ. Its leading terms cancel: the degree is ≤ 6.
  static Polynomial<Scalar, 6> slope(const Fraction& fraction) {
    const auto& [n, d] = fraction;
    return difference<8>(multiply<Scalar, 4, 5>(derivative<Scalar, 5>(n), d),
                         multiply<Scalar, 5, 4>(n, derivative<Scalar, 5>(d)))
        .template head<7>();
  }

  /// The end of an arc at Y = 0 or ∞, with the coefficients of the first power of Y, in the order
  /// `from` … `last`, for which n or Δ is not 0.
  ArcEnd<Scalar> outer_end(const Scalar& square, int from, int last) const {
    int order = from;
    while (order != last && proportional_numerator_[order] == Scalar(0) &&
           denominator_[order] == Scalar(0))
      order += from < last ? 1 : -1;
    return {square, proportional_numerator_[order], denominator_[order]};
  }

  Scalar unit_;
  ParityParts<Scalar> base_, proportional_, differential_;
  Polynomial<Scalar, 4> denominator_, proportional_numerator_, differential_numerator_;
};

}  // namespace holdfast
