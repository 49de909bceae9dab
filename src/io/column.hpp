#pragma once

#include <string>

namespace holdfast::program {

/// A column of a table that the program writes.
struct Column {
  std::string name;
  std::string unit;  // "" without dimension
  std::string description;
  std::string datatype = "double";  // of CSV on the Web: double, integer, boolean, string
};

}  // namespace holdfast::program
