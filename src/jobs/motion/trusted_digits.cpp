#include "jobs/motion/trusted_digits.hpp"

#include "io/text/text.hpp"

namespace holdfast::program {

std::string trust_warning(const TrustedDigits& trusted) {
  if (!is_worth_telling(trusted)) return "";
  const std::string few = "fewer than six digits that the next wider number type confirms";
  if (trusted.until)
    return "after t = " + format_number(*trusted.until) + " s the result has " + few +
           ": rounding decides it (trusted_digits in the metadata)";
  return (trusted.least.empty() ? "the result" : trusted.least) + " has " + few +
         " (trusted_digits in the metadata)";
}

}  // namespace holdfast::program
