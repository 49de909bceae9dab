#pragma once

#include <vector>

#include "holdfast/plant/two_mass.hpp"

/// Options and results of a fit to a decay record; this header needs no Ceres.
namespace holdfast::fit {

/// A parameter of the plant that a fit may determine; m₂ is known from the absorber's design.
enum class PlantParameter {
  conductor_mass,       ///< mass m₁ (kg) of the conductor
  conductor_stiffness,  ///< stiffness k₁ (N/m) of the conductor
  conductor_damping,    ///< damping c₁ (N s/m) of the conductor
  absorber_stiffness,   ///< stiffness k₂ (N/m) of the absorber
  absorber_damping,     ///< damping c₂ (N s/m) of the absorber
};

/// The value of one parameter of the plant, in the unit stated at PlantParameter.
inline double parameter_of(const TwoMass<double>& plant, PlantParameter parameter) {
  using Plant = TwoMass<double>;
  constexpr double Plant::*members[] = {&Plant::conductor_mass, &Plant::conductor_stiffness,
                                        &Plant::conductor_damping, &Plant::absorber_stiffness,
                                        &Plant::absorber_damping};
  return plant.*members[static_cast<int>(parameter)];
}

/// Quantities of a record to which the plant is fitted.
enum class DecayTarget {
  first_peak_and_period,            ///< relative errors of first peak and period
  first_peak_period_and_decrement,  ///< relative errors of peak, period and log. decrement
  time_history,                     ///< errors of z₁ at every instant
};

/// Whether a target consists of measures (peak, period, decrement), not of the time history.
inline bool is_measured(DecayTarget target) { return target != DecayTarget::time_history; }

/// Options of a fit.
struct DecayFitOptions {
  /// Parameters that are fitted, each listed once.
  std::vector<PlantParameter> free = {PlantParameter::absorber_damping};
  DecayTarget target = DecayTarget::time_history;  ///< quantities of the record to be matched
  /// Whether Huber's loss limits outliers (time history only). Its scale is 1.345 standard
  /// deviations, estimated from the median |residual| (95 % efficient for Gaussian noise).
  bool robust = true;
  /// Whether the initial displacement z₀ is fitted too (time history only), as a measured record
  /// requires. Otherwise z₀ is the record's first value, which is exact in a computed record.
  bool fit_initial_displacement = true;
};

/// One local minimum of the misfit.
struct DecayMinimum {
  TwoMass<double> plant;        ///< the given plant with the values found for fitted parameters
  double initial_displacement;  ///< initial displacement z₀ (m)
  /// Standard errors of the fitted parameters, ordered as DecayFitOptions::free. They follow from
  /// the scatter of the residuals, which for measures is taken as at least 1 %. With a robust loss
  /// they follow from Huber's covariance formula (Robust Statistics, 1981, Sect. 7.6).
  std::vector<double> standard_errors;
  double residual;  ///< root mean square residual: in m for the time history, else relative
  /// Cost ½ Σ loss(residual), dimensionless; the loss is the square or Huber's. Residuals of a time
  /// history are relative to the record's first |z₁|.
  double cost;
  int found_from;  ///< number of start values from which the fit reached this minimum
};

/// Outcome of a fit.
enum class FitOutcome {
  converged,  ///< at least one start led to a minimum
  /// Every start ran to the edge of the admissible range, could not be evaluated, or ended where
  /// the standard errors of all fitted parameters exceed their values.
  no_minimum,
};

/// Result of a fit: the minima found from several start values (`starts`).
struct DecayFit {
  FitOutcome outcome;                ///< whether a minimum was found
  std::vector<DecayMinimum> minima;  ///< minima found, the deepest first
  int starts;  ///< number of starts: 8 where c₂ is fitted, else 1; 0 for a target of measures where
               ///< the record has fewer than four peaks
};

}  // namespace holdfast::fit
