#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "holdfast/core/types.hpp"

namespace holdfast {

/// The largest number of trusted decimal digits, that of a `double`: the result for equal numbers.
inline constexpr double most_trusted_digits = 17.0;

/// Whether `long double` is wider than `double` on this platform. Where it is not (Microsoft's
/// compiler, macOS on ARM), a comparison of the two gives `most_trusted_digits` and shows nothing.
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

/// The number of decimal digits in which a result agrees with a computation in a wider number type:
///
///     d = −log₁₀(|value − reference|/scale),   0 ≤ d ≤ 17
///
/// The result is 17 where value and reference are equal (infinities too) or both NaN. It is 0 where
/// only one is finite, they differ by as much as the scale, or they differ and the scale is 0.
///
///     trusted_digits(3.14, 3.14159265L, 1.0L)   // 2.8
///
/// @param value      result computed in double
/// @param reference  result from the same inputs in the wider type
/// @param scale      size of the quantity, finite, ≥ 0; for a quantity that passes through zero its
///                   largest size
inline double trusted_digits(double value, long double reference, long double scale) {
  const long double wide = value;
  if (wide == reference || (std::isnan(wide) && std::isnan(reference))) return most_trusted_digits;
  if (!std::isfinite(wide) || !std::isfinite(reference)) return 0.0;
  return detail::digits_of(std::abs(wide - reference), scale);
}

/// The trusted digits of a number relative to its reference; a reference of 0 gives 17 or 0.
inline double trusted_digits(double value, long double reference) {
  return trusted_digits(value, reference, std::abs(reference));
}

/// The trusted digits of a vector or matrix as a whole, −log₁₀(‖value − reference‖/‖reference‖) in
/// the Euclidean norm of all entries, limited to 0 … 17; 0 where an entry is not finite. Entries of
/// different units must be scaled before.
/// @param value      any shape
/// @param reference  matrix or vector of the same shape
template <class Value, class Reference>
double trusted_digits(const Eigen::MatrixBase<Value>& value,
                      const Eigen::MatrixBase<Reference>& reference) {
  const auto wide = value.template cast<long double>().eval();
  const auto same = reference.template cast<long double>().eval();
  if (!wide.allFinite() || !same.allFinite()) return 0.0;
  return detail::digits_of((wide - same).norm(), same.norm());
}

}  // namespace holdfast
