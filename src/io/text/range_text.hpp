#pragma once

#include <string>

namespace holdfast::program {

/// "3 to 5", and "3" where both ends read the same; `before` is said before two ends alone.
inline std::string range_text(const std::string& lowest, const std::string& highest,
                              const std::string& before = "") {
  return lowest == highest ? highest : before + lowest + " to " + highest;
}

}  // namespace holdfast::program
