#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "csv.hpp"
#include "holdfast/attractor/multipliers.hpp"
#include "table.hpp"

namespace holdfast::program {

/// The columns of `orbit`.
std::vector<Column> orbit_columns();

/// Those of `orbit --certificate`: quantity, value, unit.
std::vector<Column> certificate_columns();

/// Rows of a table of certificate_columns().
class QuantityRows {
 public:
  explicit QuantityRows(Table& table) : table_(table) {}

  void row(const std::string& quantity, double value, const char* unit = "") {
    table_.row(quantity, value, unit);
  }

 private:
  Table& table_;
};

/// Modulus, angle and exponent per sample of each multiplier of `samples` samples.
void write_multipliers(QuantityRows& rows, const std::vector<Multiplier>& multipliers,
                       std::int64_t samples);

}  // namespace holdfast::program
