#include "case/library/named_conductor.hpp"

#include <algorithm>
#include <cmath>

#include "case/case_keys.hpp"
#include "case/library/conductor_library.hpp"
#include "case/units.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

/// " (is it in lb/ft, 1.628 kg/m?)", of the unit by which the value is nearest to what it should
/// be: within what conductors of one name differ by, as an area in kcmil is of the aluminium alone.
std::string mistaken_unit_text(const std::string& own, double given, double ratio) {
  double nearest = 0.15;
  const Unit* found = nullptr;
  for (const Unit& unit : other_units()) {
    const double off = std::abs(unit.factor() * ratio - 1.0);
    if (own != unit.own || !unit.is_mistaken || off >= nearest) continue;
    nearest = off;
    found = &unit;
  }
  if (found == nullptr) return "";
  return std::string(" (is it in ") + found->name + ", " + format_rounded(found->in_own(given)) +
         " " + own + "?)";
}

}  // namespace

bool is_from_library(const Case& the_case, std::string_view key) {
  const auto& keys = library_keys();
  return !the_case.conductor.name.empty() && the_case.places.count(std::string(key)) == 0 &&
         std::any_of(keys.begin(), keys.end(),
                     [&](const LibraryKey& known) { return known.name == key; });
}

std::string contradicted_name_text(const Case& the_case) {
  const LibraryConductor* conductor = find_conductor(the_case.conductor.name);
  if (conductor == nullptr) return "";
  constexpr double tolerance = 0.1;
  std::string differ;
  for (const LibraryKey& key : library_keys()) {
    // How many layers, and how stiffly they hold together, no name tells.
    if (key.name == "conductor.layers" || key.name == "conductor.bending_stiffness") continue;
    const double given = case_value(the_case, key.name), ratio = given / (conductor->*key.value);
    if (is_from_library(the_case, key.name) || !std::isfinite(ratio)) continue;
    if (std::abs(ratio - 1.0) <= tolerance) continue;
    const std::string& unit = find_case_key(key.name)->unit;
    differ += (differ.empty() ? "" : "; ") + std::string(key.name) + " " + format_rounded(given) +
              " instead of " + format_rounded(conductor->*key.value) + " " + unit + ", " +
              format_rounded(ratio) + " of it" + mistaken_unit_text(unit, given, ratio);
  }
  if (differ.empty()) return "";
  return the_case.places.at("conductor.name") + ": values beside conductor.name = \"" +
         conductor->name + "\" are not those of the library: " + differ;
}

std::string borrowed_damping_text(const Case& the_case) {
  if (the_case.stands_alone || the_case.conductor.name.empty() ||
      the_case.places.count("conductor.damping_ratio") > 0)
    return "";
  return "conductor.damping_ratio is " + format_number(the_case.conductor.damping_ratio) +
         ", that of the built-in cable: a stranded conductor at its tension has some 0.0001 to "
         "0.002, which no library tells; give it";
}

}  // namespace holdfast::program
