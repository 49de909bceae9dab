#include "report/figures/figure.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "io/text/text.hpp"

namespace holdfast::program {

std::string replaced(std::string text, const std::string& part, const std::string& other) {
  for (std::size_t at = text.find(part); at != std::string::npos;
       at = text.find(part, at + other.size()))
    text.replace(at, part.size(), other);
  return text;
}

std::string filled(std::string text, const Values& values) {
  for (const auto& [key, value] : values) text = replaced(text, "@" + key + "@", value);
  return text;
}

std::vector<std::string> words_of(const std::string& command) {
  std::vector<std::string> words;
  for (const std::string_view word : split(command, ' '))
    if (!word.empty()) words.emplace_back(word);
  return words;
}

double rounded_up(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)));
  return std::ceil(1.02 * value / unit) * unit;
}

LengthUnit length_unit_for(double length) {
  constexpr std::array<LengthUnit, 3> units = {{{"mm", 1e3}, {"µm", 1e6}, {"nm", 1e9}}};
  const auto fits = [length](const LengthUnit& unit) { return length * unit.per_metre >= 0.1; };
  const auto* const found = std::find_if(units.begin(), units.end(), fits);
  if (found != units.end()) return *found;
  return length > 0.0 ? units.back() : units.front();  // the latter: nothing moves
}

}  // namespace holdfast::program
