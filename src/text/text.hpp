#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace holdfast::program {

/// The text on one line: every run of line ends and other control characters becomes one space.
std::string one_line(std::string_view text);

/// The text, or its first `longest` bytes and "..." if it is longer. No UTF-8 character is split.
std::string shortened(std::string text, std::size_t longest);

/// Whether the bytes are UTF-8 (RFC 3629).
bool is_utf8(std::string_view text);

/// Whether the text starts with `beginning`.
inline bool begins_with(std::string_view text, std::string_view beginning) {
  return text.substr(0, beginning.size()) == beginning;
}

/// The text without blanks and tabs at both ends.
std::string_view trimmed(std::string_view text);

/// The parts between separators; a text without separator is one part.
std::vector<std::string_view> split(std::string_view text, char separator);

/// Length of the longest number as text: "-2.2250738585072014e-308".
constexpr std::size_t longest_number = 24;

/// Writes format_number(), at most `longest_number` characters; returns the position after it.
char* put_number(char* place, double value);

/// The number with the shortest decimal digits that read back equal; `inf`, `-inf` or `nan`.
std::string format_number(double value);

/// The number with at most five significant digits, for messages: `0.6`, `1354.1`, `2e-07`.
std::string format_rounded(double value);

/// The lowest `digits` hexadecimal digits of a number: `00ff`.
std::string hexadecimal(std::uint64_t number, std::size_t digits);

/// The number that the whole text represents; nullopt for other text. `inf` and `nan` are numbers.
std::optional<double> parse_number(std::string_view text);

/// Edit distance of two texts: the smallest number of single-character insertions, deletions,
/// substitutions and swaps of neighbours that turn one into the other.
std::size_t edit_distance(std::string_view from, std::string_view to);

/// The first of the names with the smallest edit_distance() from the word; `names` is not empty.
std::string nearest_name(const std::vector<std::string>& names, std::string_view word);

/// Text of a range: "3 to 5" after `before`, or "3" alone if both ends are equal.
inline std::string range_text(const std::string& lowest, const std::string& highest,
                              const std::string& before = "") {
  return lowest == highest ? highest : before + lowest + " to " + highest;
}

/// The text with every occurrence of `part` replaced by `other`.
std::string replaced(const std::string& text, const std::string& part, const std::string& other);

/// Pairs of a key and the value that replaces @KEY@ in a text.
using Values = std::vector<std::pair<std::string, std::string>>;

/// The text with every @KEY@ replaced by the first value of its key; values are not searched for
/// keys, and unknown @KEY@ remain.
std::string filled(const std::string& text, const Values& values);

}  // namespace holdfast::program
