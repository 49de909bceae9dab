#pragma once

#include <vector>

#include "holdfast/plant/two_mass.hpp"

/// Options and results of a fit to a decay record; this header needs no Ceres.
namespace holdfast::fit {

/// A parameter of the plant that a fit may determine; m₂ is known from the absorber's design.
enum class PlantParameter {
  conductor_mass,       ///< m₁ (kg)
  conductor_stiffness,  ///< k₁ (N/m)
  conductor_damping,    ///< c₁ (N s/m)
  absorber_stiffness,   ///< k₂ (N/m)
  absorber_damping,     ///< c₂ (N s/m)
};

/// The value of a parameter, in the unit of its member of TwoMass.
inline double parameter_of(const TwoMass<double>& plant, PlantParameter parameter) {
  using Plant = TwoMass<double>;
  constexpr double Plant::*members[] = {&Plant::conductor_mass, &Plant::conductor_stiffness,
                                        &Plant::conductor_damping, &Plant::absorber_stiffness,
                                        &Plant::absorber_damping};
  return plant.*members[static_cast<int>(parameter)];
}

/// Quantities of a record to which the plant is fitted.
enum class DecayTarget {
  first_peak_and_period,            ///< relative errors of these two measures
  first_peak_period_and_decrement,  ///< relative errors of these three measures
  time_history,                     ///< errors of z₁ at every instant
};

/// Whether a target consists of measures of the record, not of its time history.
inline bool is_measured(DecayTarget target) { return target != DecayTarget::time_history; }

/// Options of a fit.
struct DecayFitOptions {
  std::vector<PlantParameter> free = {PlantParameter::absorber_damping};  ///< each only once
  DecayTarget target = DecayTarget::time_history;  ///< quantities that are fitted
  /// Whether Huber's loss is used, beyond 1.345 standard deviations as estimated from the median
  /// residual at the deepest minimum. Outliers then count little; for Gaussian noise the efficiency
  /// is 95 %. Only for the time history.
  bool robust = true;
  /// Whether z₀ is fitted too, as for a measured record, or is the record's first value, as for a
  /// computed one. Only for the time history.
  bool fit_initial_displacement = true;
};

/// One local minimum of the misfit.
struct DecayMinimum {
  TwoMass<double> plant;        ///< the given plant with the free parameters as fitted
  double initial_displacement;  ///< z₀ (m)
  /// Standard errors of the free parameters in the order of DecayFitOptions::free; NaN where the
  /// record does not determine them. Time history: from the residuals' scatter, with a robust loss
  /// by Huber's sandwich formula. Measures: from their relative misfit, taken as 1 % or more.
  std::vector<double> standard_errors;
  double residual;  ///< root mean square: m for the time history, relative for the measures
  /// ½ Σ loss at the minimum, dimensionless: residuals of the time history are relative to |z(0)|.
  double cost;
  int found_from;  ///< number of starts that led to this minimum
};

/// Outcome of a fit.
enum class FitOutcome {
  converged,  ///< at least one start led to a minimum
  /// Every start ran to the edge of the admissible range, could not be evaluated, or ended where
  /// the standard errors of all free parameters exceed their values.
  no_minimum,
};

/// All minima that the starts of a fit led to.
struct DecayFit {
  FitOutcome outcome;                ///< whether `minima` has any
  std::vector<DecayMinimum> minima;  ///< the deepest first
  int starts;  ///< number of starts: 8 where c₂ is free, else 1; 0 where measures are to be fitted
               ///< to a record with fewer than four peaks
};

}  // namespace holdfast::fit
