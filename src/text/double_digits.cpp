#include "text/double_digits.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>

namespace holdfast::program {

#ifdef __cpp_lib_to_chars

char* shortest_digits(char* first, char* last, double value) {
  return std::to_chars(first, last, value).ptr;
}

char* rounded_digits(char* first, char* last, double value, int digits) {
  return std::to_chars(first, last, value, std::chars_format::general, digits).ptr;
}

std::from_chars_result read_digits(std::string_view text, double& value) {
  return std::from_chars(text.data(), text.data() + text.size(), value);
}

#else

char* rounded_digits(char* first, char* last, double value, int digits) {
  // One more character, for the zero that ends a C string and is then overwritten.
  std::array<char, 40> text{};
  const int length = std::snprintf(text.data(), text.size(), "%.*g", digits, value);
  return std::copy_n(text.data(), std::min<std::ptrdiff_t>(length, last - first), first);
}

// Much faster than a search for the number of digits with the C library.
char* shortest_digits(char* first, char* last, double value) {
  if (!std::isfinite(value)) return rounded_digits(first, last, value, 1);
  std::string digits = nlohmann::json(value).dump();
  if (digits.size() > 2 && digits.compare(digits.size() - 2, 2, ".0") == 0)
    digits.resize(digits.size() - 2);
  return std::copy_n(digits.data(), std::min(last - first, std::ptrdiff_t(digits.size())), first);
}

std::from_chars_result read_digits(std::string_view text, double& value) {
  const char* const begin = text.data();
  const bool decimal = text.find_first_of("xX") == std::string_view::npos;
  const char before = text.empty() ? ' ' : text.front();
  const bool starts = before != '+' && before != ' ' && before != '\t' && before != '\n';
  if (!decimal || !starts) return {begin, std::errc::invalid_argument};
  const std::string copy(text);
  char* end = nullptr;
  const double read = std::strtod(copy.c_str(), &end);
  const char* const rest = begin + (end - copy.c_str());
  if (rest == begin) return {begin, std::errc::invalid_argument};
  // The caller recognises a number out of range by its text, whatever strtod returns.
  const bool written_infinite = copy.find_first_of("iI") != std::string::npos;
  if (std::isinf(read) && !written_infinite) return {rest, std::errc::result_out_of_range};
  value = read;
  return {rest, std::errc{}};
}

#endif

}  // namespace holdfast::program
