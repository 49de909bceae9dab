#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "holdfast/math/linalg/multipliers.hpp"
#include "io/text/csv.hpp"
#include "io/text/table.hpp"

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

/// How long the orbit is, how large, how often engaged, and how well it closes.
/// @param amplitude  m
template <class Orbit>
void write_orbit_rows(QuantityRows& rows, const Orbit& orbit, double amplitude) {
  rows.row("coincidence_samples", static_cast<double>(orbit.ratio.denominator));
  rows.row("coincidence_forcing_periods", static_cast<double>(orbit.ratio.numerator));
  rows.row("period_samples", static_cast<double>(orbit.period_samples()));
  rows.row("period", orbit.period(), "s");
  rows.row("forcing_periods", static_cast<double>(orbit.forcing_periods()));
  rows.row("amplitude", amplitude, "m");
  rows.row("engaged_fraction", orbit.engaged_fraction());
  rows.row("closure_error", orbit.closure_error, "m");
}

/// Modulus, angle and exponent per sample of each multiplier of `samples` samples.
void write_multipliers(QuantityRows& rows, const std::vector<Multiplier>& multipliers,
                       std::int64_t samples);

}  // namespace holdfast::program
