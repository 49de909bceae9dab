#include "case/units.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "text/text.hpp"

namespace holdfast::program {
namespace {

constexpr double pound = 0.45359237, foot = 0.3048, inch = 0.0254, mile = 1609.344;  // exact
constexpr double pound_force = pound * 9.80665, turn = 6.283185307179586;
constexpr bool seldom = false;

const std::vector<Unit> listed_units = {
    {"m", "mm", 1, 1e3},
    {"m", "cm", 1, 1e2},
    {"m", "km", 1e3},
    {"m", "um", 1, 1e6, 0, seldom},
    {"m", "in", inch},
    {"m", "ft", foot},
    {"m", "mi", mile, 1, 0, seldom},
    {"m2", "mm2", 1, 1e6},
    {"m2", "cm2", 1, 1e4},
    {"m2", "kcmil", 5.067074790974977e-7},
    {"m2", "in2", inch* inch},
    {"kg", "g", 1, 1e3},
    {"kg", "t", 1e3},
    {"kg", "lb", pound},
    {"kg/m", "g/m", 1, 1e3},
    {"kg/m", "t/m", 1e3},
    {"kg/m", "kg/km", 1, 1e3, 0, seldom},
    {"kg/m", "lb/ft", pound, foot},
    {"kg/m", "lb/kft", pound, foot * 1e3},
    {"Pa", "GPa", 1e9},
    {"Pa", "MPa", 1e6},
    {"Pa", "kPa", 1e3},
    {"Pa", "psi", pound_force, inch* inch},
    {"Pa", "ksi", pound_force * 1e3, inch* inch},
    {"Pa", "Mpsi", pound_force * 1e6, inch* inch, 0, seldom},
    {"Pa", "N/mm2", 1e6, 1, 0, seldom},
    {"N", "mN", 1, 1e3},
    {"N", "kN", 1e3},
    {"N", "MN", 1e6, 1, 0, seldom},
    {"N", "lbf", pound_force},
    {"N", "kip", pound_force * 1e3, 1, 0, seldom},
    {"N", "kgf", 9.80665, 1, 0, seldom},
    {"N/m", "kN/m", 1e3},
    {"N/m", "mN/m", 1, 1e3},
    {"N/m", "N/mm", 1e3, 1, 0, seldom},
    {"N/m", "lbf/ft", pound_force, foot},
    {"N/m", "lbf/in", pound_force, inch},
    {"N s/m", "kN s/m", 1e3},
    {"N s/m", "mN s/m", 1, 1e3},
    {"N s/m", "lbf s/ft", pound_force, foot},
    {"N s/m", "lbf s/in", pound_force, inch},
    {"N m2", "kN m2", 1e3, 1, 0, seldom},
    {"N m2", "lbf ft2", pound_force* foot* foot, 1, 0, seldom},
    {"N m2", "lbf in2", pound_force* inch* inch, 1, 0, seldom},
    {"s", "ms", 1, 1e3},
    {"s", "us", 1, 1e6},
    {"s", "min", 60, 1, 0, seldom},
    {"h", "min", 1, 60, 0, seldom},
    {"h", "d", 24, 1, 0, seldom},
    {"years", "year", 1, 1, 0, seldom},
    {"years", "a", 1, 1, 0, seldom},
    {"m/s", "km/h", 1, 3.6},
    {"m/s", "mm/s", 1, 1e3},
    {"m/s", "m/min", 1, 60},
    {"m/s", "cm/s", 1, 1e2, 0, seldom},
    {"m/s", "mph", mile, 3600, 0, seldom},
    {"m/s", "ft/s", foot, 1, 0, seldom},
    {"m/s", "kn", 1852, 3600, 0, seldom},
    {"Hz", "rad/s", 1, turn},
    {"Hz", "1/min", 1, 60},
    {"Hz", "kHz", 1e3, 1, 0, seldom},
    {"Hz", "1/s", 1, 1, 0, seldom},
    {"rad", "deg", turn, 360, 0, seldom},
    {"m/s2", "cm/s2", 1, 1e2},
    {"m/s2", "ft/s2", foot},
    {"kg/m3", "g/cm3", 1e3},
    {"kg/m3", "lb/ft3", pound, foot* foot* foot},
    {"degC", "degF", 5, 9, -32},
    {"degC", "K", 1, 1, -273.15, seldom},
    {"", "%", 1, 1e2},
};

/// Signs in the spelling of a unit, and their replacements in the table of units.
constexpr std::array<std::pair<const char*, const char*>, 9> writings = {{
    {"\u00b2", "2"},
    {"\u00b3", "3"},
    {"\u00b5", "u"},
    {"\u03bc", "u"},
    {"\u00b0", "deg"},
    {"\u00b7", " "},
    {"\u22c5", " "},
    {"^", ""},
    {"*", " "},
}};

std::string in_table_writing(std::string_view text) {
  std::string unit(trimmed(text));
  for (const auto& [from, to] : writings) unit = replaced(unit, from, to);
  return unit;
}

/// Whether a text begins with a letter, % or 1/ and has only characters of units.
bool is_like_a_unit(std::string_view text) {
  const auto is_letter = [](char sign) {
    return (sign >= 'a' && sign <= 'z') || (sign >= 'A' && sign <= 'Z') || sign == '%';
  };
  const bool begins = !text.empty() && (is_letter(text.front()) || text.substr(0, 2) == "1/");
  return begins && std::all_of(text.begin(), text.end(), [&](char sign) {
           return is_letter(sign) || sign == '/' || sign == ' ' || (sign >= '0' && sign <= '9');
         });
}

}  // namespace

const std::vector<Unit>& other_units() { return listed_units; }

std::optional<WrittenQuantity> written_quantity(std::string_view text) {
  constexpr std::size_t longest = 60;
  text = trimmed(text);
  if (text.size() > longest || text.find_first_of("0123456789") > 2) return std::nullopt;
  for (std::size_t end = text.size(); end > 0; --end) {
    // The longest number that the text begins with: 5e3 m, and 5 ergs.
    const auto value = parse_number(text.substr(0, end));
    if (!value) continue;
    const std::string unit = in_table_writing(text.substr(end));
    if (!is_like_a_unit(unit)) return std::nullopt;
    return WrittenQuantity{*value, unit};
  }
  return std::nullopt;
}

std::optional<double> in_own_unit(const WrittenQuantity& quantity, std::string_view own) {
  if (quantity.unit == own) return quantity.value;
  for (const Unit& unit : listed_units)
    if (own == unit.own && quantity.unit == unit.name) return unit.in_own(quantity.value);
  return std::nullopt;
}

std::string units_in_words(std::string_view own) {
  std::vector<std::string> names;
  if (!own.empty()) names.emplace_back(own);
  for (const Unit& unit : listed_units)
    if (own == unit.own) names.emplace_back(unit.name);
  std::string words;
  for (std::size_t k = 0; k < names.size(); ++k)
    words += (k == 0 ? "" : k + 1 == names.size() ? " or " : ", ") + names[k];
  return words;
}

}  // namespace holdfast::program
