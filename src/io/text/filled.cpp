#include "io/text/filled.hpp"

#include <algorithm>

namespace holdfast::program {

std::string replaced(std::string text, const std::string& part, const std::string& other) {
  for (std::size_t at = text.find(part); at != std::string::npos;
       at = text.find(part, at + other.size()))
    text.replace(at, part.size(), other);
  return text;
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
