#include "report/figures/figure_text.hpp"

namespace holdfast::program {
namespace {

std::string unbroken(const std::string& label) {
  std::string result;
  for (const char character : label) {
    if (character == ' ') {
      result += "\u00a0";
    } else {
      result += character;
    }
  }
  // Inside the braces the blank belongs to gnuplot's syntax.
  const std::string italic = "{/:Italic\u00a0";
  for (std::size_t at = result.find(italic); at != std::string::npos;
       at = result.find(italic, at + 1)) {
    result.replace(at, italic.size(), "{/:Italic ");
  }
  return result;
}

}  // namespace

std::vector<std::string> joined(std::vector<std::string> first,
                                const std::vector<std::string>& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

std::string axes(const std::string& x, const std::string& y) {
  return "set xlabel \"" + unbroken(x) + "\"\nset ylabel \"" + unbroken(y) + "\"\n";
}

}  // namespace holdfast::program
