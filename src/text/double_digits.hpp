#pragma once

#include <charconv>
#include <string_view>

namespace holdfast::program {

// Conversions between doubles and digits by std::to_chars and std::from_chars, if the standard
// library has them for doubles. Otherwise (LLVM before version 14, as in emscripten) the value is
// equal, but the text may have one more digit or an exponent.

/// Writes the fewest digits that read back as the same number; returns the position after them.
/// @param last  end of the buffer, at least 24 characters after `first`
char* shortest_digits(char* first, char* last, double value);

/// Writes at most `digits` significant digits; returns the position after them.
/// @param last  end of the buffer, at least 32 characters after `first`
char* rounded_digits(char* first, char* last, double value, int digits);

/// Reads a decimal number as std::from_chars does: no blank and no plus sign before it.
std::from_chars_result read_digits(std::string_view text, double& value);

}  // namespace holdfast::program
