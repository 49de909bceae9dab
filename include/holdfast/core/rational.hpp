#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "holdfast/core/errors.hpp"

namespace holdfast {

/// A fraction in lowest terms.
struct Rational {
  std::int64_t numerator = 0;    ///< numerator p, with the sign of the fraction
  std::int64_t denominator = 1;  ///< denominator q, ≥ 1
};

/// Recovers the fraction p/q, in lowest terms, whose rounded value is given.
///
/// A product such as f τ = 10 Hz · 0.011 s is rounded. The result is the first convergent of the
/// value's continued fraction with a relative error of at most 10⁻¹³, here 11/100.
///
/// @param value                number to be written as a fraction, |value| ≤ 9·10¹⁵
/// @param largest_denominator  largest admissible q, ≥ 1
/// @return fraction p/q; nullopt if this convergent has q > `largest_denominator` (the value may
///         then be treated as irrational)
/// @throws InvalidParameter when `value` is not finite or out of range
inline std::optional<Rational> reconstruct_rational(double value,
                                                    std::int64_t largest_denominator) {
  require_within("value to be written as a fraction", value, "", -9.0e15, 9.0e15);
  const double tolerance = 1e-13 * std::max(std::abs(value), 1e-300);
  std::int64_t previous_p = 1, previous_q = 0;
  double whole = std::floor(value);
  std::int64_t p = static_cast<std::int64_t>(whole), q = 1;
  double remainder = value - whole;
  while (std::abs(value - static_cast<double>(p) / static_cast<double>(q)) > tolerance) {
    remainder = 1.0 / remainder;
    whole = std::floor(remainder);
    remainder -= whole;
    const double next_q = whole * static_cast<double>(q) + static_cast<double>(previous_q);
    if (!(next_q <= static_cast<double>(largest_denominator))) return std::nullopt;
    const auto term = static_cast<std::int64_t>(whole);
    const std::int64_t next_p = term * p + previous_p;
    previous_p = p;
    previous_q = q;
    p = next_p;
    q = static_cast<std::int64_t>(next_q);
  }
  return Rational{p, q};
}

}  // namespace holdfast
