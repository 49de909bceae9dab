#pragma once

#include <charconv>
#include <string_view>

namespace holdfast::program {

// Doubles as digits, as std::to_chars and std::from_chars say, where the standard library has them
// for doubles; where it does not (LLVM's before version 14, as emscripten has it), with the same
// value and at times a digit or an exponent more.

/// Writes the fewest digits that are read as the same number; gives the place behind them.
/// @param last  at least 24 behind `first`
char* shortest_digits(char* first, char* last, double value);

/// Writes so many significant digits at most.
/// @param last  at least 32 behind `first`
char* rounded_digits(char* first, char* last, double value, int digits);

/// Reads a number, in decimal, without blanks or a plus before it; as std::from_chars does.
std::from_chars_result read_digits(std::string_view text, double& value);

}  // namespace holdfast::program
