#pragma once

#include <optional>
#include <string>

namespace holdfast::program {

/// Number of trusted decimal digits of a table: the digits in which the computation in `double`
/// agrees with a second computation.
struct TrustedDigits {
  int digits = 17;              ///< smallest number of trusted digits in the table
  std::optional<double> until;  ///< time (s) up to which a motion has six trusted digits
  std::string least;            ///< quantity with the fewest; "" if not applicable
  /// Whether the second computation is in `double` with one more rounding per sample; else it is in
  /// `long double`.
  bool by_rounding = false;
};

/// Number of trusted digits below which a table reports their number.
inline constexpr int digits_taken_for_granted = 6;

inline bool is_worth_telling(const TrustedDigits& trusted) {
  return trusted.digits < digits_taken_for_granted;
}

/// Warning of few trusted digits, one line; "" if there are six or more.
std::string trust_warning(const TrustedDigits& trusted);

}  // namespace holdfast::program
