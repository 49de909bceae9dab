#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "holdfast/core/types.hpp"

namespace holdfast {

/// The upper limit of trusted_digits(): 17 decimal digits, which identify every `double`.
inline constexpr double most_trusted_digits = 17.0;

/// Whether `long double` has more digits than `double` on this platform. If not (Microsoft's
/// compiler, macOS on ARM), a reference in `long double` has the same errors and tests nothing.
inline constexpr bool long_double_is_wider =
    std::numeric_limits<long double>::digits > std::numeric_limits<double>::digits;

namespace detail {

/// The number of digits −log₁₀(difference/scale), 0 … 17, for a finite difference ≥ 0.
inline double digits_of(long double difference, long double scale) {
  if (difference == 0.0L) return most_trusted_digits;
  const auto digits = static_cast<double>(-std::log10(difference / scale));
  return std::min(std::max(digits, 0.0), most_trusted_digits);
}

}  // namespace detail

/// The number d of decimal digits in which a value agrees with a reference in a wider number type:
///
///     d = −log₁₀(|value − reference|/scale),   0 ≤ d ≤ 17
///
/// d = 17 if value and reference are equal (two equal infinities included) or both NaN. Otherwise
/// d = 0 if either is not finite, or if they differ by the scale or more.
///
///     trusted_digits(3.14, 3.14159265L, 1.0L)   // 2.8
///
/// @param value      result computed in double
/// @param reference  result from the same inputs in the wider type
/// @param scale      magnitude to which the difference is relative, finite, ≥ 0; for a quantity
///                   that crosses zero, its largest magnitude
inline double trusted_digits(double value, long double reference, long double scale) {
  const long double wide = value;
  if (wide == reference || (std::isnan(wide) && std::isnan(reference))) return most_trusted_digits;
  if (!std::isfinite(wide) || !std::isfinite(reference)) return 0.0;
  return detail::digits_of(std::abs(wide - reference), scale);
}

/// The agreeing decimal digits relative to |reference|; for reference = 0: 17 if value = 0, else 0.
inline double trusted_digits(double value, long double reference) {
  return trusted_digits(value, reference, std::abs(reference));
}

/// The number of decimal digits in which a vector or matrix agrees with a reference as a whole:
/// −log₁₀(‖value − reference‖/‖reference‖), Euclidean norm of all entries, limited to 0 … 17; 0 if
/// an entry is not finite. Entries with different units must first be scaled to a common unit.
/// @param value      vector or matrix of any shape
/// @param reference  vector or matrix of the same shape, in the wider number type
template <class Value, class Reference>
double trusted_digits(const Eigen::MatrixBase<Value>& value,
                      const Eigen::MatrixBase<Reference>& reference) {
  const auto wide = value.template cast<long double>().eval();
  const auto same = reference.template cast<long double>().eval();
  if (!wide.allFinite() || !same.allFinite()) return 0.0;
  return detail::digits_of((wide - same).norm(), same.norm());
}

}  // namespace holdfast
