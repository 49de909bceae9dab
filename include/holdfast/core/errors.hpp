#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "holdfast/core/compiler.hpp"

namespace holdfast {

/// The exception for a caller's parameter outside its admissible range.
///
/// Numerical outcomes (not converged, unstable, no solution) are reported in the result instead.
class InvalidParameter : public std::invalid_argument {
 public:
  /// @param name        the parameter's technical name ("sampling period")
  /// @param value       the rejected value
  /// @param unit        SI unit of the value, empty for pure numbers
  /// @param admissible  admissible values, a phrase that continues "must be" (for instance "> 0")
  InvalidParameter(std::string name, double value, std::string unit, std::string admissible)
      : std::invalid_argument(sentence(name, value, unit, admissible)),
        name_(std::move(name)),
        value_(value),
        unit_(std::move(unit)),
        admissible_(std::move(admissible)) {}

  /// The technical name of the rejected parameter.
  const std::string& name() const noexcept { return name_; }
  /// The rejected value, in `unit()`; may be NaN or infinite.
  double value() const noexcept { return value_; }
  /// SI unit of the value; empty for a pure number.
  const std::string& unit() const noexcept { return unit_; }
  /// The admissible values, as words that follow "must be", for instance "> 0".
  const std::string& admissible() const noexcept { return admissible_; }

 private:
  static std::string sentence(const std::string& name, double value, const std::string& unit,
                              const std::string& admissible) {
    std::ostringstream text;
    text << name << " = " << value << (unit.empty() ? "" : " ") << unit
         << " is not admissible: must be " << admissible;
    return text.str();
  }

  std::string name_;
  double value_;
  std::string unit_;
  std::string admissible_;
};

/// Checks that the value of the parameter `name`, in `unit`, is neither NaN nor infinite.
/// @throws InvalidParameter otherwise
inline void require_finite(std::string_view name, double value, std::string_view unit) {
  if (!std::isfinite(value))
    throw InvalidParameter(std::string(name), value, std::string(unit), "finite");
}

/// Checks 0 < value < ∞ for the parameter `name` in `unit`. @throws InvalidParameter otherwise
inline void require_positive(std::string_view name, double value, std::string_view unit) {
  if (!(std::isfinite(value) && value > 0))
    throw InvalidParameter(std::string(name), value, std::string(unit), "finite and > 0");
}

/// Checks 0 ≤ value < ∞ for the parameter `name` in `unit`. @throws InvalidParameter otherwise
inline void require_non_negative(std::string_view name, double value, std::string_view unit) {
  if (!(std::isfinite(value) && value >= 0)) {
    throw InvalidParameter(std::string(name), value, std::string(unit), "finite and >= 0");
  }
}

/// Checks lower ≤ value ≤ upper for the parameter `name` in `unit`. For "no upper limit", set
/// `upper` to the largest double. @throws InvalidParameter if the value is outside the range
inline void require_within(std::string_view name, double value, std::string_view unit, double lower,
                           double upper) {
  if (value >= lower && value <= upper) return;
  std::ostringstream range;
  if (lower == upper) {
    range << lower;
  } else if (upper < std::numeric_limits<double>::max()) {
    range << "between " << lower << " and " << upper;
  } else {
    range << "finite and >= " << lower;
  }
  throw InvalidParameter(std::string(name), value, std::string(unit), range.str());
}

/// Checks the number of entries of a vector, or of rows or columns of a matrix. `name` is the name
/// of this number in the message. @throws InvalidParameter unless size = wanted
inline void require_size(std::string_view name, std::ptrdiff_t size, std::ptrdiff_t wanted) {
  const auto entries = static_cast<double>(wanted);
  if (size != wanted) require_within(name, static_cast<double>(size), "", entries, entries);
}

}  // namespace holdfast
