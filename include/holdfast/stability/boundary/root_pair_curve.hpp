#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "holdfast/control/gains.hpp"
#include "holdfast/core/interval.hpp"
#include "holdfast/math/poly/parity.hpp"
#include "holdfast/math/poly/polynomial.hpp"
#include "holdfast/math/poly/positive_roots.hpp"
#include "holdfast/stability/polynomial/affine_polynomial.hpp"

namespace holdfast {

/// One end of an arc: Y and there the numerator and the denominator of P (at Y = 0 and ∞ their
/// first coefficients that do not both vanish; at a pole the denominator is 0).
template <class Scalar>
struct ArcEnd {
  Scalar square;       ///< Y, 0 … ∞
  Scalar numerator;    ///< of P; where P stays finite at a pole, over |Y − pole|
  Scalar denominator;  ///< Δ; likewise

  /// Sign tells on which side of a proportional gain the curve is, without dividing at a pole.
  Scalar residual(const Scalar& proportional_gain) const {
    return numerator - proportional_gain * denominator;
  }
};

/// A stretch of the curve of root pairs on which P is monotone and finite.
template <class Scalar>
struct MonotoneArc {
  ArcEnd<Scalar> start;  ///< at the lower Y ≥ 0
  ArcEnd<Scalar> end;    ///< at the upper Y ≤ ∞

  /// True when the arc takes the proportional gain (N/m), which it then does once.
  bool passes(const Scalar& proportional_gain) const {
    return (start.residual(proportional_gain) < Scalar(0)) !=
           (end.residual(proportional_gain) < Scalar(0));
  }

  /// A Y inside: the geometric mean of the ends where both are finite and not 0.
  Scalar inside() const {
    if (std::isinf(end.square)) return start.square > 0 ? Scalar(2) * start.square : Scalar(1);
    if (!(start.square > Scalar(0))) return end.square / Scalar(2);
    return std::sqrt(start.square) * std::sqrt(end.square);
  }
};

/// The gains at which the loop has a pair of roots w = ±iy on the imaginary axis, as rational
/// functions of Y = y².
///
/// With even and odd parts a(iy) = a_e(Y) + iy a_o(Y) of base b, proportional p and differential d,
///
///     P(Y) = (b_o d_e − b_e d_o) / Δ,   D(Y) = (b_e p_o − b_o p_e) / Δ,   Δ(Y) = p_e d_o − p_o d_e
///
/// numerators and Δ are of degree ≤ 4 in Y. Y is measured in squares of `unit()`, the mean root
/// modulus without control, in which the coefficients are of like size. Coefficients of
/// the gains below round-off of the largest are zeros (no gain moves the root there).
///
/// For the sampled loop w = i tan(θ/2) is the pair λ = e^{±iθ}; for the continuous loop w = iω.
template <class Scalar>
class RootPairCurve {
 public:
  /// @param polynomial  in a variable whose stable half-plane is Re < 0:
  /// `characteristic_polynomial(plant)`, or that of the sampled loop after `in_half_plane`
  template <int Degree>
  explicit RootPairCurve(const AffinePolynomial<Scalar, Degree>& polynomial)
      : unit_(detail::mean_root_modulus(polynomial.base)),
        base_(polynomial.base, unit_),
        proportional_(detail::without_round_off(polynomial.proportional, unit_), unit_),
        differential_(detail::without_round_off(polynomial.differential, unit_), unit_),
        denominator_(cross(proportional_, differential_)),
        proportional_numerator_(cross(differential_, base_)),
        differential_numerator_(cross(base_, proportional_)) {}

  /// The modulus of w in which Y is measured: y = unit · √Y.
  const Scalar& unit() const { return unit_; }

  /// y = Im w of the root pair.
  Scalar root(const Scalar& square) const { return unit_ * std::sqrt(square); }

  /// The gains at Y; infinite at a pole.
  PdGains<Scalar> gains(const Scalar& square) const {
    const Scalar denominator = evaluate(denominator_, square);
    return {evaluate(proportional_numerator_, square) / denominator,
            evaluate(differential_numerator_, square) / denominator};
  }

  /// Numerator of P, degree 4 in Y.
  const Polynomial<Scalar, 4>& proportional_numerator() const { return proportional_numerator_; }
  /// Numerator of D, degree 4 in Y.
  const Polynomial<Scalar, 4>& differential_numerator() const { return differential_numerator_; }
  /// Δ, the denominator of both, degree 4 in Y.
  const Polynomial<Scalar, 4>& denominator() const { return denominator_; }

  /// n − P Δ with n the numerator of P: zero where the curve takes P; its slope by Y, and Δ.
  struct Residual {
    Scalar value,     ///< n − P Δ
        slope,        ///< its derivative by Y at a fixed P
        denominator;  ///< Δ
  };

  /// At Y and the proportional gain P (N/m).
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

  /// Even and odd part of the polynomial without control, w in `unit()`.
  const ParityParts<Scalar>& base() const { return base_; }
  /// Those of its change per N/m of P.
  const ParityParts<Scalar>& proportional() const { return proportional_; }
  /// Those of its change per N s/m of D.
  const ParityParts<Scalar>& differential() const { return differential_; }

  /// Y > 0 at which the curve leaves to infinity, ascending.
  std::vector<Scalar> poles() const { return positive_roots(denominator_); }

  /// Y > 0 at which P is stationary (the curve is vertical in a plane with P across), ascending.
  std::vector<Scalar> proportional_extremes() const {
    return positive_roots(slope(reduced(proportional_numerator_, differential_)));
  }

  /// Y > 0 at which D is stationary, ascending.
  std::vector<Scalar> differential_extremes() const {
    return positive_roots(slope(reduced(differential_numerator_, proportional_)));
  }

  /// The whole curve, 0 < Y < ∞, cut at its poles and at the extremes of P.
  std::vector<MonotoneArc<Scalar>> arcs() const {
    std::vector<Cut> cuts = {{end_at_zero(), end_at_zero()},
                             {end_at_infinity(), end_at_infinity()}};
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
  /// The difference, with zeros for coefficients that are only the round-off of their terms.
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

  /// Im(ā c) / y for a(iy), c(iy): a_e c_o − a_o c_e, degree 4 in Y.
  static Polynomial<Scalar, 4> cross(const ParityParts<Scalar>& a, const ParityParts<Scalar>& c) {
    return difference<5>(multiply<Scalar, 3, 3>(a.even, c.odd),
                         multiply<Scalar, 3, 3>(a.odd, c.even));
  }

  /// The ends of the two arcs that meet.
  struct Cut {
    ArcEnd<Scalar> below, above;
  };

  struct Fraction {
    Polynomial<Scalar, 4> numerator, denominator;
  };

  /// numerator / Δ without the poles at which `factor` vanishes, which is a factor of both: d(iy)
  /// of P, p(iy) of D. Without damping the velocity has zeros on the axis: there D is infinite, P
  /// not.
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

  /// True when the even and the odd part are both zero but for round-off.
  static bool vanishes(const ParityParts<Scalar>& factor, const Scalar& square) {
    const Scalar even = evaluate(factor.even, square), odd = evaluate(factor.odd, square);
    const Scalar size =
        evaluate(factor.even.cwiseAbs() + std::sqrt(square) * factor.odd.cwiseAbs(), square);
    return std::abs(even) + std::sqrt(square) * std::abs(odd) <= Scalar(1e-12) * size;
  }

  /// Where P stays finite both numerator and Δ change sign: their ratio to |Y − pole| is taken.
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

  /// numerator′ Δ − numerator Δ′; the leading terms cancel, so that the degree is at most 6.
  static Polynomial<Scalar, 6> slope(const Fraction& fraction) {
    const auto& [n, d] = fraction;
    return difference<8>(multiply<Scalar, 4, 5>(derivative<Scalar, 5>(n), d),
                         multiply<Scalar, 5, 4>(n, derivative<Scalar, 5>(d)))
        .template head<7>();
  }

  ArcEnd<Scalar> end_at_zero() const {
    int order = 0;
    while (order < 4 && no_term(order)) ++order;
    return {Scalar(0), proportional_numerator_[order], denominator_[order]};
  }

  ArcEnd<Scalar> end_at_infinity() const {
    int order = 4;
    while (order > 0 && no_term(order)) --order;
    return {std::numeric_limits<Scalar>::infinity(), proportional_numerator_[order],
            denominator_[order]};
  }

  bool no_term(int order) const {
    return proportional_numerator_[order] == Scalar(0) && denominator_[order] == Scalar(0);
  }

  Scalar unit_;
  ParityParts<Scalar> base_, proportional_, differential_;
  Polynomial<Scalar, 4> denominator_, proportional_numerator_, differential_numerator_;
};

/// The curve's type does not tell the degree of the polynomial that it was made from.
template <class Scalar, int Degree>
RootPairCurve(const AffinePolynomial<Scalar, Degree>&) -> RootPairCurve<Scalar>;

}  // namespace holdfast
