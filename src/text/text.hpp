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

/// The text, or its beginning of so many bytes at most and "...". No character is cut apart.
std::string shortened(std::string text, std::size_t longest);

/// Whether the bytes are UTF-8 (RFC 3629).
bool is_utf8(std::string_view text);

/// Whether the text begins so.
inline bool begins_with(std::string_view text, std::string_view beginning) {
  return text.substr(0, beginning.size()) == beginning;
}

/// The text without blanks at its two ends.
std::string_view trimmed(std::string_view text);

/// The parts between separators; a text without separator is one part.
std::vector<std::string_view> split(std::string_view text, char separator);

/// "-2.2250738585072014e-308"
constexpr std::size_t longest_number = 24;

/// Writes what format_number() gives, longest_number characters at most, and gives the place
/// behind.
char* put_number(char* place, double value);

/// The shortest decimal digits that read back as the same double; `inf`, `-inf` and `nan`.
std::string format_number(double value);

/// Five significant digits at most, for messages: `0.6`, `1354.1`, `2e-07`.
std::string format_rounded(double value);

/// So many lowest hexadecimal digits of a number: `00ff`.
std::string hexadecimal(std::uint64_t number, std::size_t digits);

/// The number that the whole text stands for, or nothing. `inf` and `nan` are numbers here.
std::optional<double> parse_number(std::string_view text);

/// The fewest single-character insertions, deletions, substitutions and swaps of neighbours that
/// turn one text into the other.
std::size_t edit_distance(std::string_view from, std::string_view to);

/// The first of the names that are fewest edits away from the word; there must be one.
std::string nearest_name(const std::vector<std::string>& names, std::string_view word);

/// "3 to 5", and "3" where both ends read the same; `before` is said before two ends alone.
inline std::string range_text(const std::string& lowest, const std::string& highest,
                              const std::string& before = "") {
  return lowest == highest ? highest : before + lowest + " to " + highest;
}

/// The text with another one wherever a part stands.
std::string replaced(std::string text, const std::string& part, const std::string& other);

/// Values of each @KEY@ in a text, key by key.
using Values = std::vector<std::pair<std::string, std::string>>;

/// The text with every @KEY@ replaced by its first value, which stays as it is; an unknown KEY
/// stays too.
std::string filled(const std::string& text, const Values& values);

}  // namespace holdfast::program
