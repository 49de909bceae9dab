#pragma once

#include <string>

namespace holdfast::program {

/// A column of a table that the program writes.
struct Column {
  std::string name;
  std::string unit;  // "" without dimension
  std::string description;
  std::string datatype = "double";  // of CSV on the Web: double, integer, boolean, string

  /// Whether cells may be NaN: the description then says what `nan` means.
  bool may_be_nan() const { return description.find("nan") != std::string::npos; }
};

}  // namespace holdfast::program
