#pragma once

#include <vector>

#include "holdfast/plant/two_dof.hpp"

/// What is asked of a fit to a decay record and what it answers; this header needs no Ceres.
namespace holdfast::fit {

/// A parameter of the plant that a decay can determine; m₂ is the absorber's design.
enum class PlantParameter {
  conductor_mass,
  conductor_stiffness,
  conductor_damping,
  absorber_stiffness,
  absorber_damping,
};

/// What of the record is to be met.
enum class DecayTarget {
  first_peak_and_period,            ///< each relative to itself
  first_peak_period_and_decrement,  ///< and the logarithmic decrement
  time_history,                     ///< z₁ at every instant
};

/// Whether a target is a few measures of the record.
inline bool is_measured(DecayTarget target) { return target != DecayTarget::time_history; }

/// What is asked of a fit.
struct DecayQuestion {
  std::vector<PlantParameter> free = {PlantParameter::absorber_damping};  ///< none twice
  DecayTarget target = DecayTarget::time_history;
  /// Huber's loss at 1.345 standard deviations, those taken from the median of the plain fit's
  /// residuals: outliers of the record then count little, and Gaussian noise loses 5 % of its
  /// information. Only for the time history.
  bool robust = true;
  /// Whether z₀ is fitted too (a measured record) or is the record's first value (a computed one).
  /// Only for the time history.
  bool fit_initial_displacement = true;
};

/// One local minimum.
struct DecayMinimum {
  TwoDof<double> plant;
  double initial_displacement;  ///< z₀ (m)
  /// Standard errors of the free parameters in the order of the question, from the curvature at the
  /// minimum and the residuals' scatter. They speak of noise; of a model that cannot follow the
  /// record, the residual speaks.
  std::vector<double> standard_errors;
  double residual;  ///< root mean square: m for the time history, relative for the measures
  double cost;      ///< ½ Σ residual² (m², or relative): the minimum's depth
  int found_from;   ///< how many of the starts led here
};

/// How a fit ended.
enum class FitOutcome {
  converged,   ///< at least one start led to a minimum
  no_minimum,  ///< all ran to the edge of the admissible range, or could not be evaluated
};

struct DecayFit {
  FitOutcome outcome;
  std::vector<DecayMinimum> minima;  ///< the deepest first
  int starts;
};

}  // namespace holdfast::fit
