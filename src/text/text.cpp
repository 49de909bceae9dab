#include "text/text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "text/double_digits.hpp"

namespace holdfast::program {
namespace {

/// Whether the byte is not the first of a character of UTF-8.
bool is_continuation(char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U; }

bool is_control(char character) {
  const auto code = static_cast<unsigned char>(character);
  return code < 0x20 || code == 0x7f;
}

bool is_blank(char character) { return character == ' ' || character == '\t'; }

}  // namespace

std::string one_line(std::string_view text) {
  std::string line;
  bool in_run = false;
  for (const char character : text) {
    const bool control = is_control(character);
    if (!control) line += character;
    if (control && !in_run) line += ' ';
    in_run = control;
  }
  return std::string(trimmed(line));
}

std::string shortened(std::string text, std::size_t longest) {
  if (text.size() <= longest) return text;
  std::size_t end = longest;
  while (end > 0 && is_continuation(text[end])) --end;
  text.resize(end);
  return text + "...";
}

bool is_utf8(std::string_view text) {
  try {
    nlohmann::json(text).dump();  // which refuses other bytes
    return true;
  } catch (const nlohmann::json::type_error&) {
    return false;
  }
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  std::size_t begin = 0;
  for (;;) {
    const std::size_t end = text.find(separator, begin);
    parts.push_back(text.substr(begin, end - begin));
    if (end == std::string_view::npos) return parts;
    begin = end + 1;
  }
}

char* put_number(char* place, double value) {
  if (!std::isnan(value)) return shortest_digits(place, place + longest_number, value);
  constexpr std::string_view none = "nan";  // to_chars would write the sign of a NaN
  return std::copy(none.begin(), none.end(), place);
}

std::string format_number(double value) {
  std::array<char, longest_number> digits{};
  return std::string(digits.data(), put_number(digits.data(), value));
}

std::string format_rounded(double value) {
  std::array<char, 32> digits{};
  return std::string(digits.data(),
                     rounded_digits(digits.data(), digits.data() + digits.size(), value, 5));
}

std::string hexadecimal(std::uint64_t number, std::size_t digits) {
  std::string text(digits, '0');
  for (std::size_t i = 0; i < digits; ++i)
    text[digits - 1 - i] = "0123456789abcdef"[(number >> (4 * i)) & 0xF];
  return text;
}

std::optional<double> parse_number(std::string_view text) {
  const bool plus = text.size() > 1 && text[0] == '+' && text[1] != '-';
  if (plus) text.remove_prefix(1);
  double value = 0.0;
  const auto result = read_digits(text, value);
  const bool whole = result.ptr == text.data() + text.size() && !text.empty();
  if (!whole || result.ec == std::errc::invalid_argument) return std::nullopt;
  // Outside the range of double: too small a number becomes 0, too large a number infinity.
  if (result.ec == std::errc::result_out_of_range) {
    const bool tiny =
        text.find("e-") != std::string_view::npos || text.find("E-") != std::string_view::npos;
    const double size = tiny ? 0.0 : std::numeric_limits<double>::infinity();
    return text.front() == '-' ? -size : size;
  }
  return value;
}

std::size_t edit_distance(std::string_view from, std::string_view to) {
  // Row i holds the distances of the first i characters of `from` to every beginning of `to`.
  std::vector<std::size_t> row_before_last(to.size() + 1);
  std::vector<std::size_t> last_row(to.size() + 1);
  std::vector<std::size_t> row(to.size() + 1);
  for (std::size_t j = 0; j <= to.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= from.size(); ++i) {
    row_before_last.swap(last_row);
    last_row.swap(row);
    row[0] = i;
    for (std::size_t j = 1; j <= to.size(); ++j) {
      const std::size_t change = from[i - 1] == to[j - 1] ? 0 : 1;
      row[j] = std::min({last_row[j] + 1, row[j - 1] + 1, last_row[j - 1] + change});
      const bool swapped = i > 1 && j > 1 && from[i - 1] == to[j - 2] && from[i - 2] == to[j - 1];
      if (swapped) row[j] = std::min(row[j], row_before_last[j - 2] + 1);
    }
  }
  return row[to.size()];
}

std::string nearest_name(const std::vector<std::string>& names, std::string_view word) {
  return *std::min_element(names.begin(), names.end(),
                           [&](const std::string& a, const std::string& b) {
                             return edit_distance(word, a) < edit_distance(word, b);
                           });
}

std::string replaced(const std::string& text, const std::string& part, const std::string& other) {
  std::string result;
  std::size_t done = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, done)) {
    result.append(text, done, at - done) += other;
    done = at + part.size();
  }
  return result.append(text, done);
}

std::string filled(const std::string& text, const Values& values) {
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text[at] == '@' ? text.find('@', at + 1) : std::string::npos;
    const std::string key = end == std::string::npos ? "" : text.substr(at + 1, end - at - 1);
    const auto value = std::find_if(values.begin(), values.end(),
                                    [&key](const auto& known) { return known.first == key; });
    const bool is_value = end != std::string::npos && value != values.end();
    result += is_value ? value->second : std::string(1, text[at]);
    at = is_value ? end + 1 : at + 1;
  }
  return result;
}

}  // namespace holdfast::program
