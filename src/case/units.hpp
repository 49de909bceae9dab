#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace holdfast::program {

/// A unit in which the value of a key may be written, other than the key's own unit.
struct Unit {
  const char* own;           ///< unit of the key, in which the case stores it: "N/m"
  const char* name;          ///< name of the unit: "kN/m"
  double numerator;          ///< one unit is numerator/denominator of the own unit;
  double denominator = 1.0;  ///< two numbers make 5.5 mm2 exactly 5.5e-6 m2
  double offset = 0.0;       ///< added to a temperature before it is scaled
  bool is_mistaken = true;   ///< whether numbers are often given in this unit by mistake

  double factor() const { return numerator / denominator; }
  double in_own(double value) const { return (value + offset) * numerator / denominator; }
};

/// All units other than own units, grouped by own unit.
const std::vector<Unit>& other_units();

/// A number with a unit, such as "28.2 kN", "1.23 lb/ft", "-20 °F" or "5.5 mm^2", with or without
/// the blank. written_quantity() returns none for any other text.
struct WrittenQuantity {
  double value;
  std::string unit;  ///< spelled as in other_units(): "mm2", "degF"
};
std::optional<WrittenQuantity> written_quantity(std::string_view text);

/// The value converted to a key's own unit; none if the written unit cannot be converted to it.
std::optional<double> in_own_unit(const WrittenQuantity& quantity, std::string_view own);

/// The admissible units for an own unit: "N, mN, kN, MN, lbf, kip or kgf"; "" without any.
std::string units_in_words(std::string_view own);

}  // namespace holdfast::program
