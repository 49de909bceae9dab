#pragma once

#include <vector>

#include "case/case_keys.hpp"

namespace holdfast::program {

/// A quantity that follows from a case, and within what it lies for all cables, their winds,
/// dampers and computers: full-scale lines, stays and crossings as well as models of a metre.
struct PlausibleQuantity {
  const char* name;               // "conductor.mass_per_length / conductor.area"
  const char* unit;               // "" without dimension
  std::vector<std::string> keys;  // that it is made of, the one most often mistaken first
  double (*of)(const Case&);      // NaN where the case does not tell it
  AdmissibleRange usual;          // beyond: a warning
  AdmissibleRange possible;       // beyond: refused
  const char* reason;             // why these bounds
  bool asks_unit = true;          // what lies beyond may be in another unit
};

/// Quantities of conductor, absorber, wind, computer and initial state: known as soon as the case
/// is read.
const std::vector<PlausibleQuantity>& quantities_of_case();

/// Quantities of the plant, once it is settled. All of it is possible.
const std::vector<PlausibleQuantity>& quantities_of_plant();

/// How far the absorber's place may move without leaving what a model of small motions says, m:
/// half of its distance from the nearer support; 3 m where the cable is not the case's own.
double reach_of_absorber(const Case& the_case);

/// The two natural frequencies of the plant without its dampers, Hz, ascending.
std::array<double, 2> undamped_frequencies(const case_tables::Plant& plant);

}  // namespace holdfast::program
