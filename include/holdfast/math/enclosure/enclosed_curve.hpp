#pragma once

#include <algorithm>
#include <limits>

#include "holdfast/core/types.hpp"
#include "holdfast/math/enclosure/complex_enclosure.hpp"
#include "holdfast/math/enclosure/enclosed_exponential.hpp"
#include "holdfast/math/enclosure/enclosure.hpp"

namespace holdfast {

/// A curve z(t) in the complex plane, −1 ≤ t ≤ 1, enclosed by discs of z(0) and z′(0) and a bound
/// of |z″|. Every operation encloses the exact result for all curves enclosed by the arguments.
class EnclosedCurve {
 public:
  /// The constant curve z(t) = number; implicit, so that numbers may be used in formulas.
  EnclosedCurve(const ComplexEnclosure& number)  // NOLINT(google-explicit-constructor)
      : EnclosedCurve(number, {}, 0.0) {}
  /// @param value  value z(0)
  /// @param slope  derivative z′(0)
  /// @param bend   upper bound of |z″| for all t, ≥ 0; NaN or a negative number means ∞ (unknown)
  EnclosedCurve(const ComplexEnclosure& value, const ComplexEnclosure& slope, double bend)
      : value_(value),
        slope_(slope),
        bend_(bend >= 0.0 ? bend : std::numeric_limits<double>::infinity()),
        slope_size_(slope.magnitude()),
        size_(value.magnitude()) {}

  /// A disc that encloses the value z(0), at the middle of the parameter range.
  const ComplexEnclosure& value() const { return value_; }
  /// A disc that encloses the derivative z′(0), at the middle of the parameter range.
  const ComplexEnclosure& slope() const { return slope_; }
  /// An upper bound of |z| for all t.
  double most() const { return detail::above_roundings(size_ + slope_size_ + 0.5 * bend_); }
  /// A lower bound of |z| for all t; 0 if z may be 0 for some t.
  double least() const {
    const double left = value_.least_modulus() - detail::above_roundings(slope_size_ + 0.5 * bend_);
    return left > 0.0 ? left * (1.0 - 0x1.0p-50) : 0.0;
  }
  /// An upper bound of |z′| for all t.
  double steepest() const { return detail::above_roundings(slope_size_ + bend_); }
  /// An upper bound of |z″| for all t.
  double bend() const { return bend_; }

  /// The curve −z(t).
  EnclosedCurve operator-() const { return {-value_, -slope_, bend_}; }
  /// The sum of two curves, a(t) + b(t).
  friend EnclosedCurve operator+(const EnclosedCurve& a, const EnclosedCurve& b) {
    return {a.value_ + b.value_, a.slope_ + b.slope_, detail::above_roundings(a.bend_ + b.bend_)};
  }
  /// The difference of two curves, a(t) − b(t).
  friend EnclosedCurve operator-(const EnclosedCurve& a, const EnclosedCurve& b) {
    return a + (-b);
  }
  /// The product of two curves, a(t) b(t), with (ab)″ = a″b + 2a′b′ + ab″.
  friend EnclosedCurve operator*(const EnclosedCurve& a, const EnclosedCurve& b) {
    const double bend = a.bend_ * b.most() + 2.0 * a.steepest() * b.steepest() + a.most() * b.bend_;
    return {a.value_ * b.value_, a.slope_ * b.value_ + a.value_ * b.slope_,
            detail::above_roundings(bend)};
  }
  /// The curve 1/z: (1/z)′ = −z′/z², |(1/z)″| ≤ (2|z′|²/|z| + |z″|)/|z|²; bounds ∞ if z may be 0.
  friend EnclosedCurve inverse(const EnclosedCurve& z) {
    const ComplexEnclosure inverted = inverse(z.value_);
    // An upper bound of 1/|z| that is > 0, so that 0 · ∞ does not arise.
    const double most = detail::above_roundings(1.0 / z.least()), fast = z.steepest();
    const double bend = 2.0 * (fast * most) * (fast * most) * most + z.bend_ * most * most;
    return {inverted, -(z.slope_ * inverted * inverted), detail::above_roundings(bend)};
  }

 private:
  ComplexEnclosure value_, slope_;
  double bend_, slope_size_, size_;
};

/// A logarithmic spiral z(t) = c e^{σt} in the complex plane, −1 ≤ t ≤ 1, with c and σ in discs.
class EnclosedSpiral {
 public:
  /// @param start  value c = z(0), a disc
  /// @param rate   complex rate σ, a disc
  EnclosedSpiral(const ComplexEnclosure& start, const ComplexEnclosure& rate)
      : start_(start), rate_(rate), turn_(rate.magnitude()) {
    const Matrix<Enclosure, 1> growth(Enclosure(rate.real().magnitude()));
    most_ = (Enclosure(start.magnitude()) * exponential(growth)(0, 0)).upper();
  }

  /// A disc that encloses the value c = z(0).
  const ComplexEnclosure& start() const { return start_; }
  /// A disc that encloses the complex rate σ.
  const ComplexEnclosure& rate() const { return rate_; }
  /// An upper bound of the modulus |z| for all t.
  double most() const { return most_; }
  /// An upper bound of the distance |z(t) − z(0)| for all t.
  double way() const { return detail::above_roundings(turn_ * most_); }

  /// The spiral as an EnclosedCurve.
  EnclosedCurve curve() const { return {start_, start_ * rate_, bend()}; }
  /// The n-th power of the spiral, cⁿ e^{nσt}.
  EnclosedSpiral to_the(int n) const {
    return {power(start_, n), rate_ * ComplexEnclosure(static_cast<double>(n))};
  }
  /// The complex conjugate of a spiral.
  friend EnclosedSpiral conj(const EnclosedSpiral& z) { return {conj(z.start_), conj(z.rate_)}; }

  /// The difference z = a − b of two spirals as a curve. If |σ_b| < 1, |z″| is bounded by means of
  /// ν = σ_a − σ_b, a bound that is tight for similar rates; |a″| + |b″| is used where smaller:
  ///
  ///     z′ = ν a + σ_b z,   |z| ≤ (|z(0)| + |ν||a|)/(1 − |σ_b|),   z″ = ν (σ_a + σ_b) a + σ_b² z
  friend EnclosedCurve difference(const EnclosedSpiral& a, const EnclosedSpiral& b) {
    const ComplexEnclosure value = a.start_ - b.start_, faster = a.rate_ - b.rate_;
    const double relative = faster.magnitude();
    const double most =
        over_what_is_left(detail::above_roundings(value.magnitude() + relative * a.most_), b.turn_);
    const double together = relative * (a.turn_ + b.turn_) * a.most_ + b.turn_ * b.turn_ * most;
    // The second bound is lower if one spiral turns fast but is small.
    const double bend =
        std::min(detail::above_roundings(together), detail::above_roundings(a.bend() + b.bend()));
    return {value, faster * a.start_ + b.rate_ * value, bend};
  }

 private:
  double bend() const { return detail::above_roundings(turn_ * turn_ * most_); }
  /// An upper bound of a/(1 − x), a and x ≥ 0; ∞ where x may be 1.
  static double over_what_is_left(double a, double x) {
    const double left = (1.0 - x) * (1.0 - 0x1.0p-50);
    return left > 0.0 ? detail::above_roundings(a / left) : std::numeric_limits<double>::infinity();
  }

  ComplexEnclosure start_, rate_;
  double turn_, most_;
};

}  // namespace holdfast
