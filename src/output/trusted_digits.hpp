#pragma once

#include <optional>
#include <string>

namespace holdfast::program {

/// Largest Lyapunov exponent of a motion.
struct SeparationRate {
  double per_second;      ///< exponent (1/s), with the natural logarithm
  double standard_error;  ///< standard error of the exponent (1/s)
};

/// Number of trusted decimal digits of a table: the digits in which the computation in `double`
/// agrees with a second computation.
struct TrustedDigits {
  int digits = 17;              ///< smallest number of trusted digits in the table
  std::optional<double> until;  ///< time (s) up to which a motion has six trusted digits
  std::string least;            ///< quantity with the fewest; "" if not applicable
  /// Whether the second computation is in `double` with one more rounding per sample; else it is in
  /// `long double`.
  bool by_rounding = false;
  std::optional<SeparationRate> rate = {};  ///< only of a motion with fewer than six
};

/// Number of trusted digits below which a table reports their number.
inline constexpr int digits_taken_for_granted = 6;

inline bool is_worth_telling(const TrustedDigits& trusted) {
  return trusted.digits < digits_taken_for_granted;
}

/// Last part of the warning, with the largest exponent: "; neighbouring motions separate, the
/// largest exponent is 1.7 +- 0.1 per second"; "" if the exponent is unknown.
std::string rate_text(const TrustedDigits& trusted);

/// Warning of few trusted digits, one line; "" if there are six or more.
std::string trust_warning(const TrustedDigits& trusted);

}  // namespace holdfast::program
