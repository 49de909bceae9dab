#pragma once

#include <algorithm>
#include <limits>

#include "holdfast/core/types.hpp"
#include "holdfast/math/enclosure/complex_enclosure.hpp"
#include "holdfast/math/enclosure/enclosed_exponential.hpp"
#include "holdfast/math/enclosure/enclosure.hpp"

namespace holdfast {

/// A curve z(t) in the complex plane, −1 ≤ t ≤ 1, enclosed to the second order: by z(0), z′(0) and
/// what |z″| is at most. Every operation gives one that holds its result on all curves that its
/// arguments may be.
class EnclosedCurve {
 public:
  /// That number, which does not move; implicit, as in formulas it is such a curve.
  EnclosedCurve(const ComplexEnclosure& number)  // NOLINT(google-explicit-constructor)
      : EnclosedCurve(number, {}, 0.0) {}
  /// @param value  z(0)
  /// @param slope  z′(0)
  /// @param bend   at least |z″| everywhere; a NaN: nothing is known of it
  EnclosedCurve(const ComplexEnclosure& value, const ComplexEnclosure& slope, double bend)
      : value_(value),
        slope_(slope),
        bend_(bend >= 0.0 ? bend : std::numeric_limits<double>::infinity()),
        slope_size_(slope.magnitude()),
        size_(value.magnitude()) {}

  /// z(0).
  const ComplexEnclosure& value() const { return value_; }
  /// z′(0).
  const ComplexEnclosure& slope() const { return slope_; }
  /// At least |z| everywhere.
  double most() const { return detail::above_roundings(size_ + slope_size_ + 0.5 * bend_); }
  /// Not above |z| anywhere; 0 where z may pass 0.
  double least() const {
    const double left = value_.least_modulus() - detail::above_roundings(slope_size_ + 0.5 * bend_);
    return left > 0.0 ? left * (1.0 - 0x1.0p-50) : 0.0;
  }
  /// At least |z′| everywhere.
  double steepest() const { return detail::above_roundings(slope_size_ + bend_); }
  /// At least |z″| everywhere.
  double bend() const { return bend_; }

  /// −z.
  EnclosedCurve operator-() const { return {-value_, -slope_, bend_}; }
  /// a + b.
  friend EnclosedCurve operator+(const EnclosedCurve& a, const EnclosedCurve& b) {
    return {a.value_ + b.value_, a.slope_ + b.slope_, detail::above_roundings(a.bend_ + b.bend_)};
  }
  /// a − b.
  friend EnclosedCurve operator-(const EnclosedCurve& a, const EnclosedCurve& b) {
    return a + (-b);
  }
  /// a b: (ab)″ = a″b + 2a′b′ + ab″.
  friend EnclosedCurve operator*(const EnclosedCurve& a, const EnclosedCurve& b) {
    const double bend = a.bend_ * b.most() + 2.0 * a.steepest() * b.steepest() + a.most() * b.bend_;
    return {a.value_ * b.value_, a.slope_ * b.value_ + a.value_ * b.slope_,
            detail::above_roundings(bend)};
  }
  /// 1/z: (1/z)′ = −z′/z², |(1/z)″| ≤ (2|z′|²/|z| + |z″|)/|z|²; unknown where z may pass 0.
  friend EnclosedCurve inverse(const EnclosedCurve& z) {
    const ComplexEnclosure inverted = inverse(z.value_);
    // 1/|z| and a rounding, 0 · ∞ being of no use.
    const double most = detail::above_roundings(1.0 / z.least()), fast = z.steepest();
    const double bend = 2.0 * (fast * most) * (fast * most) * most + z.bend_ * most * most;
    return {inverted, -(z.slope_ * inverted * inverted), detail::above_roundings(bend)};
  }

 private:
  ComplexEnclosure value_, slope_;
  double bend_, slope_size_, size_;
};

/// A spiral c e^{σt}, −1 ≤ t ≤ 1.
class EnclosedSpiral {
 public:
  /// @param start  c
  /// @param rate   σ
  EnclosedSpiral(const ComplexEnclosure& start, const ComplexEnclosure& rate)
      : start_(start), rate_(rate), turn_(rate.magnitude()) {
    const Matrix<Enclosure, 1> growth(Enclosure(rate.real().magnitude()));
    most_ = (Enclosure(start.magnitude()) * exponential(growth)(0, 0)).upper();
  }

  /// c.
  const ComplexEnclosure& start() const { return start_; }
  /// σ.
  const ComplexEnclosure& rate() const { return rate_; }
  /// At least |z| everywhere.
  double most() const { return most_; }
  /// At least |z − c| everywhere.
  double way() const { return detail::above_roundings(turn_ * most_); }

  /// This spiral as a curve.
  EnclosedCurve curve() const { return {start_, start_ * rate_, bend()}; }
  /// cⁿ e^{nσt}.
  EnclosedSpiral to_the(int n) const {
    return {power(start_, n), rate_ * ComplexEnclosure(static_cast<double>(n))};
  }
  /// The one on the other side of the real line.
  friend EnclosedSpiral conj(const EnclosedSpiral& z) { return {conj(z.start_), conj(z.rate_)}; }

  /// a − b. Little is lost where both turn alike, ν = σ_a − σ_b:
  ///
  ///     z′ = ν a + σ_b z,   |z| ≤ (|z(0)| + |ν||a|)/(1 − |σ_b|),   z″ = ν (σ_a + σ_b) a + σ_b² z
  friend EnclosedCurve difference(const EnclosedSpiral& a, const EnclosedSpiral& b) {
    const ComplexEnclosure value = a.start_ - b.start_, faster = a.rate_ - b.rate_;
    const double relative = faster.magnitude();
    const double most =
        over_what_is_left(detail::above_roundings(value.magnitude() + relative * a.most_), b.turn_);
    const double together = relative * (a.turn_ + b.turn_) * a.most_ + b.turn_ * b.turn_ * most;
    // Where one turns fast, but has died out.
    const double bend =
        std::min(detail::above_roundings(together), detail::above_roundings(a.bend() + b.bend()));
    return {value, faster * a.start_ + b.rate_ * value, bend};
  }

 private:
  double bend() const { return detail::above_roundings(turn_ * turn_ * most_); }
  /// At least a/(1 − x), a and x ≥ 0; ∞ where x may be 1.
  static double over_what_is_left(double a, double x) {
    const double left = (1.0 - x) * (1.0 - 0x1.0p-50);
    return left > 0.0 ? detail::above_roundings(a / left) : std::numeric_limits<double>::infinity();
  }

  ComplexEnclosure start_, rate_;
  double turn_, most_;
};

}  // namespace holdfast
