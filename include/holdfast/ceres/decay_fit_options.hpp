#pragma once

#include <vector>

#include "holdfast/plant/two_mass.hpp"

/// Options and results of a fit to a decay record; this header needs no Ceres.
namespace holdfast::fit {

/// A parameter of the plant that a decay can determine; m₂ is the absorber's design.
enum class PlantParameter {
  conductor_mass,       ///< m₁ (kg)
  conductor_stiffness,  ///< k₁ (N/m)
  conductor_damping,    ///< c₁ (N s/m)
  absorber_stiffness,   ///< k₂ (N/m)
  absorber_damping,     ///< c₂ (N s/m)
};

/// The value of that parameter, in its unit of TwoMass.
inline double parameter_of(const TwoMass<double>& plant, PlantParameter parameter) {
  using Plant = TwoMass<double>;
  constexpr double Plant::*members[] = {&Plant::conductor_mass, &Plant::conductor_stiffness,
                                        &Plant::conductor_damping, &Plant::absorber_stiffness,
                                        &Plant::absorber_damping};
  return plant.*members[static_cast<int>(parameter)];
}

/// Measures of the record that a fit is to meet.
enum class DecayTarget {
  first_peak_and_period,            ///< each relative to itself
  first_peak_period_and_decrement,  ///< and the logarithmic decrement
  time_history,                     ///< z₁ at every instant
};

/// Whether a target is a few measures of the record.
inline bool is_measured(DecayTarget target) { return target != DecayTarget::time_history; }

/// Options of a fit.
struct DecayFitOptions {
  std::vector<PlantParameter> free = {PlantParameter::absorber_damping};  ///< none twice
  DecayTarget target = DecayTarget::time_history;  ///< what the misfit is measured in
  /// Huber's loss at 1.345 standard deviations, taken from the median residual of the deepest
  /// minimum: outliers count little, Gaussian noise loses 5 % of its information. Only for the time
  /// history.
  bool robust = true;
  /// Whether z₀ is fitted too (a measured record) or is the record's first value (a computed one).
  /// Only for the time history.
  bool fit_initial_displacement = true;
};

/// One local minimum.
struct DecayMinimum {
  TwoMass<double> plant;        ///< the given plant with the free parameters as fitted
  double initial_displacement;  ///< z₀ (m)
  /// Standard errors of the free parameters in the order of the question; NaN where the record does
  /// not determine them. Time history: from the residuals' scatter, with a robust loss by Huber's
  /// sandwich formula. Measures: from their misfit, not less than 1 % of each.
  std::vector<double> standard_errors;
  double residual;  ///< root mean square: m for the time history, relative for the measures
  /// ½ Σ loss, the minimum's depth, dimensionless: the time history is counted in |z(0)|.
  double cost;
  int found_from;  ///< how many of the starts led here
};

/// How a fit ended.
enum class FitOutcome {
  converged,  ///< at least one start led to a minimum
  /// All ran to the edge of the admissible range, could not be evaluated, or ended where the record
  /// says nothing: standard errors beyond the values.
  no_minimum,
};

/// All minima that the starts of a fit led to.
struct DecayFit {
  FitOutcome outcome;                ///< whether there is one
  std::vector<DecayMinimum> minima;  ///< the deepest first
  int starts;  ///< how many were run: 8 where c₂ is free, else 1; 0 for a record without four peaks
               ///< whose measures are asked for
};

}  // namespace holdfast::fit
