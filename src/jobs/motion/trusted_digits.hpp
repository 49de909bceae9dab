#pragma once

#include <optional>
#include <string>

namespace holdfast::program {

/// How many decimal digits of a table may be trusted: those in which the computation in `double`
/// and the same one in `long double` agree.
struct TrustedDigits {
  int digits = 17;              ///< the fewest in the table
  std::optional<double> until;  ///< s; of a motion: the samples up to here have six
  std::string least;            ///< the quantity that has the fewest; "" where that says nothing
};

/// With fewer than this many digits a table says how many it has.
inline constexpr int digits_taken_for_granted = 6;

inline bool is_worth_telling(const TrustedDigits& trusted) {
  return trusted.digits < digits_taken_for_granted;
}

/// What to tell a user of it in one line; "" where there is nothing to tell.
std::string trust_warning(const TrustedDigits& trusted);

}  // namespace holdfast::program
