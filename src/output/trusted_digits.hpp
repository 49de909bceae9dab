#pragma once

#include <optional>
#include <string>

namespace holdfast::program {

/// The largest Lyapunov exponent of a motion.
struct SeparationRate {
  double per_second;      ///< natural logarithm
  double standard_error;  ///< likewise
};

/// How many decimal digits of a table may be trusted: those in which the computation in `double`
/// and another one of the same agree.
struct TrustedDigits {
  int digits = 17;              ///< the fewest in the table
  std::optional<double> until;  ///< s; of a motion: the samples up to here have six
  std::string least;            ///< the quantity that has the fewest; "" where that says nothing
  /// The other computation is in `double` too, with a rounding more at every sample; else it is in
  /// `long double`.
  bool by_rounding = false;
  std::optional<SeparationRate> rate = {};  ///< of a motion that has fewer than six
};

/// With fewer than this many digits a table says how many it has.
inline constexpr int digits_taken_for_granted = 6;

inline bool is_worth_telling(const TrustedDigits& trusted) {
  return trusted.digits < digits_taken_for_granted;
}

/// "; neighbours part, the largest exponent is 1.7 +- 0.1 per second"; "" where it is not known.
std::string rate_text(const TrustedDigits& trusted);

/// Warning of few trusted digits in one line; "" where there is nothing to tell.
std::string trust_warning(const TrustedDigits& trusted);

}  // namespace holdfast::program
