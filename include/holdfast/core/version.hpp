#pragma once

#include <string_view>

#include "holdfast/core/compiler.hpp"

namespace holdfast {

/// The version of the library and the program, "major.minor.patch" (semantic versioning). The build
/// reads the project's version from this line, so this is the only place where it is written.
inline constexpr std::string_view version_string = "0.1.0";

namespace detail {

/// The number at `position` (0 = major) of a dot-separated version text.
constexpr int version_part(std::string_view text, int position) {
  int part = 0;
  int value = 0;
  for (const char character : text) {
    if (character != '.') {
      value = part == position ? 10 * value + (character - '0') : value;
    } else {
      ++part;
    }
  }
  return value;
}

}  // namespace detail

/// The major version as a number, for comparisons at compile time.
inline constexpr int version_major = detail::version_part(version_string, 0);
/// The minor version as a number.
inline constexpr int version_minor = detail::version_part(version_string, 1);
/// The patch version as a number.
inline constexpr int version_patch = detail::version_part(version_string, 2);

}  // namespace holdfast
