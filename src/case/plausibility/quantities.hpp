#pragma once

#include <vector>

#include "case/case_keys.hpp"

namespace holdfast::program {

/// A quantity computed from a case, with its usual and possible ranges for all cables, winds,
/// dampers and computers: from models one metre long to full-scale lines, stays and crossings.
struct PlausibleQuantity {
  const char* name;               // "conductor.mass_per_length / conductor.area"
  const char* unit;               // "" without dimension
  std::vector<std::string> keys;  // keys of its values, the most often mistaken first
  double (*of)(const Case&);      // its value; NaN: unknown
  AdmissibleRange usual;          // outside: a warning
  AdmissibleRange possible;       // outside: refused
  const char* reason;             // why these bounds
  bool asks_unit = true;          // whether a mistaken unit may be the cause
};

/// Quantities of conductor, absorber, wind, computer and initial state, known from the case alone.
const std::vector<PlausibleQuantity>& quantities_of_case();

/// Quantities of the plant, known once it is computed. Odd values are doubted but not refused.
const std::vector<PlausibleQuantity>& quantities_of_plant();

/// Largest displacement (m) of the absorber's place for which a model of small motions is valid:
/// half of its distance from the nearer support; 3 m if the case gives no cable of its own.
double reach_of_absorber(const Case& the_case);

/// The two natural frequencies (Hz, ascending) of the plant without damping.
std::array<double, 2> undamped_frequencies(const case_tables::Plant& plant);

}  // namespace holdfast::program
