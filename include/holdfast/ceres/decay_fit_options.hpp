#pragma once

#include <vector>

#include "holdfast/plant/two_mass.hpp"

/// Options and results of a fit to a free-decay record; this header does not need Ceres Solver.
namespace holdfast::fit {

/// A parameter of the plant that can be fitted. The absorber's mass m₂ is taken as known.
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

/// Errors that a fit minimises. The first two targets are targets of measures, see DecayMeasures.
enum class DecayTarget {
  first_peak_and_period,            ///< relative errors of first peak and period
  first_peak_period_and_decrement,  ///< relative errors of peak, period and log. decrement
  time_history,                     ///< errors of the conductor's displacement z₁ at each instant
};

/// Whether a target consists of measures (peak, period, decrement), not of the time history.
inline bool is_measured(DecayTarget target) { return target != DecayTarget::time_history; }

/// Options of a fit.
struct DecayFitOptions {
  /// Parameters that are fitted, each listed once.
  std::vector<PlantParameter> free = {PlantParameter::absorber_damping};
  DecayTarget target = DecayTarget::time_history;  ///< errors that the fit minimises
  /// Whether Huber's loss limits the effect of outliers (time history only). Its scale is 1.345
  /// standard deviations, estimated from the median |residual| (95 % efficient for Gaussian noise).
  bool robust = true;
  /// Whether the initial displacement z₀ is fitted too (time history only); advisable for measured
  /// records. Otherwise z₀ is the record's first value, which is exact in a computed record.
  bool fit_initial_displacement = true;
};

/// One local minimum of the cost of a fit.
struct DecayMinimum {
  TwoMass<double> plant;        ///< the given plant with the fitted values of its free parameters
  double initial_displacement;  ///< initial displacement z₀ (m)
  /// Standard errors of the fitted parameters, in their units, ordered as DecayFitOptions::free.
  /// They follow from the scatter of the residuals: for measures at least 1 %, for a time history
  /// by Huber's covariance formula (Robust Statistics, 1981, Sect. 7.6).
  std::vector<double> standard_errors;
  double residual;  ///< root mean square error: in m for a time history, else relative
  /// Cost ½ Σ loss(residual), dimensionless; the loss is the square or Huber's. Residuals of a time
  /// history are relative to the record's first |z₁|.
  double cost;
  int found_from;  ///< number of start values from which the fit reached this minimum
};

/// Outcome of a fit.
enum class FitOutcome {
  converged,  ///< the fit found a minimum from at least one start value
  /// From every start the fit failed, ran to the edge of the admissible range, or ended where all
  /// fitted parameters are smaller than their standard errors; or DecayFit::starts is 0.
  no_minimum,
};

/// Result of fit_decay(): the minima found from one or several start values.
struct DecayFit {
  FitOutcome outcome;                ///< whether a minimum was found
  std::vector<DecayMinimum> minima;  ///< minima found, the deepest first
  /// Number of start values: 8 if c₂ is fitted, else 1; 0 if the target consists of measures and
  /// the record has fewer than four peaks.
  int starts;
};

}  // namespace holdfast::fit
