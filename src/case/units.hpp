#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace holdfast::program {

/// A unit that a quantity may be written in beside its own.
struct Unit {
  const char* own;           ///< that of the key, in which the case has it: "N/m"
  const char* name;          ///< "kN/m"
  double numerator;          ///< a value in it is so many numerator/denominator of the own unit:
  double denominator = 1.0;  ///< two numbers, so that 5.5 mm2 is 5.5e-6 m2 to the last digit
  double offset = 0.0;       ///< of a temperature, before the factor
  bool is_mistaken = true;   ///< numbers are often given in it where the own one is meant

  double factor() const { return numerator / denominator; }
  double in_own(double value) const { return (value + offset) * numerator / denominator; }
};

/// All of them, by the own unit.
const std::vector<Unit>& other_units();

/// "28.2 kN", "1.23 lb/ft", "-20 °F", "5.5 mm^2": a number, a blank or none, and a unit; nothing
/// where the text is not that.
struct WrittenQuantity {
  double value;
  std::string unit;  ///< in the table's writing: "mm2", "degF"
};
std::optional<WrittenQuantity> written_quantity(std::string_view text);

/// The value in the own unit; nothing where the quantity's unit is none of it.
std::optional<double> in_own_unit(const WrittenQuantity& quantity, std::string_view own);

/// The units that would do: "N, mN, kN, MN, lbf, kip or kgf"; empty where there is none.
std::string units_in_words(std::string_view own);

}  // namespace holdfast::program
