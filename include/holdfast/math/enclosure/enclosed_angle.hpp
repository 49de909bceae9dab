#pragma once

#include <cmath>

#include "holdfast/core/types.hpp"
#include "holdfast/math/enclosure/enclosure.hpp"

namespace holdfast {

namespace detail {

/// The enclosures of the cosine and the sine of an angle.
struct EnclosedPhasor {
  Enclosure cosine, sine;
};

/// The series 1 − y²/(a (a + 1)) (1 − y²/((a + 2)(a + 3)) (1 − …)) for y² = `squared` ≤ 1. The
/// first bracket that is not computed is enclosed by [0, 1].
inline Enclosure nested_series(const Enclosure& squared, double a, int factors = 10) {
  Enclosure sum(0.0, 1.0);
  for (int k = factors - 1; k >= 0; --k) {
    const double at = a + 2.0 * k;
    sum = Enclosure(1.0) - squared / Enclosure(at * (at + 1.0)) * sum;
  }
  return sum;
}

/// The cosine and sine of x (rad), |x| < 10⁶: series at x − k π/2, then k quarter turns.
inline EnclosedPhasor phasor_at(double x) {
  const double quarters = std::nearbyint(x * (2.0 / pi<double>));
  const Enclosure rest = Enclosure(x) - Enclosure(0.5 * quarters) * pi<Enclosure>;
  const Enclosure squared = square(rest);
  const Enclosure cosine = nested_series(squared, 1.0), sine = rest * nested_series(squared, 2.0);
  switch (static_cast<int>(std::fmod(quarters, 4.0) + 4.0) % 4) {
    case 1:
      return {-sine, cosine};
    case 2:
      return {-cosine, -sine};
    case 3:
      return {sine, -cosine};
    default:
      return {cosine, sine};
  }
}

/// The cosine and sine of an angle (rad): values at its midpoint ± its radius, as |derivative| ≤ 1.
inline EnclosedPhasor phasor_of(const Enclosure& angle) {
  const Enclosure all(-1.0, 1.0);
  const double x = angle.middle(), radius = angle.radius();
  if (!(std::abs(x) < 1e6 && radius < 2.0)) return {all, all};
  const EnclosedPhasor middle = phasor_at(x);
  const Enclosure width(-radius, radius);
  return {intersection(middle.cosine + width, all), intersection(middle.sine + width, all)};
}

}  // namespace detail

/// An interval that encloses cos x for all angles x (rad) in an interval.
inline Enclosure cos(const Enclosure& angle) { return detail::phasor_of(angle).cosine; }
/// An interval that encloses sin x for all angles x (rad) in an interval.
inline Enclosure sin(const Enclosure& angle) { return detail::phasor_of(angle).sine; }

}  // namespace holdfast
