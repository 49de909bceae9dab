#include "report/picture/plain_label.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "io/text/filled.hpp"

namespace holdfast::program {
namespace {

/// Digits as indices, all else as it is.
std::string lowered(const std::string& index) {
  constexpr std::array<const char*, 10> indices = {"₀", "₁", "₂", "₃", "₄",
                                                   "₅", "₆", "₇", "₈", "₉"};
  std::string text;
  for (const char character : index) {
    const bool is_digit = character >= '0' && character <= '9';
    text +=
        is_digit ? indices[static_cast<std::size_t>(character - '0')] : std::string(1, character);
  }
  return text;
}

/// The index that begins at a place behind "_": what braces hold, or one character.
std::string index_at(const std::string& label, std::size_t at) {
  if (label[at] != '{') return label.substr(at, 1);
  return label.substr(at, label.find('}', at) + 1 - at);
}

/// Without braces, nor the font that one of them begins with.
std::string without_braces(const std::string& label) {
  std::string text;
  for (std::size_t at = 0; at < label.size(); ++at) {
    const bool opens = label[at] == '{';
    if (opens && label.compare(at, 2, "{/") == 0) at = std::min(label.find(' ', at), label.size());
    if (!opens && label[at] != '}') text += label[at];
  }
  return text;
}

}  // namespace

std::string plain_label(const std::string& label) {
  std::string text;
  for (std::size_t at = 0; at < label.size(); ++at) {
    if (label[at] != '_' || at + 1 == label.size()) {
      text += label[at];
      continue;
    }
    const std::string index = index_at(label, at + 1);
    text += lowered(index);
    at += index.size();
  }
  return without_braces(replaced(text, "\u00a0", " "));
}

}  // namespace holdfast::program
