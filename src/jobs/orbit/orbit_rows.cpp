#include "jobs/orbit/orbit_rows.hpp"

#include <cmath>

namespace holdfast::program {

std::vector<Column> orbit_columns() {
  return {{"period_samples", "", "samples of one period", "integer"},
          {"period_s", "s", "period"},
          {"forcing_periods", "", "periods of the excitation in one of the orbit", "integer"},
          {"largest_multiplier", "", "largest modulus of a multiplier of one period"},
          {"closure_error", "m", "state after one period less the first one, norm in SI numbers"},
          {"border_distance_m", "m",
           "smallest distance of z2 - z1 from a change of contact at an end of the gap"},
          {"engaged_fraction", "", "share of the samples at which the drive transmits"}};
}

std::vector<Column> certificate_columns() {
  return {{"quantity", "", "what is certified", "string"},
          {"value", "", "in the unit of the row"},
          {"unit", "", "of the value", "string"}};
}

void write_multipliers(QuantityRows& rows, const std::vector<Multiplier>& multipliers,
                       std::int64_t samples) {
  int number = 1;
  for (const Multiplier& multiplier : multipliers) {
    const std::string name = "multiplier_" + std::to_string(number++);
    rows.row(name + "_modulus", std::abs(multiplier.value()));
    rows.row(name + "_angle", multiplier.angle, "rad");
    rows.row(name + "_exponent", multiplier.log_modulus / static_cast<double>(samples),
             "per sample");
  }
}

}  // namespace holdfast::program
