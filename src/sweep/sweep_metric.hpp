#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "holdfast/chaos/classification.hpp"
#include "holdfast/sweep/motion_metrics.hpp"
#include "output/grid/grid_output.hpp"

namespace holdfast::program {

/// Metrics that a sweep can tell of a cell; each bears the name of its column. Definitions and
/// units are in metric_column().
enum class SweepMetric {
  first_peak,
  steady_peak,
  steady_rms,
  ratio_to_uncontrolled,
  attenuates,
  engaged_fraction,
  force_peak,
  force_rms,
  reversals_per_s,
  absorber_stroke,
  largest_exponent,
  period_samples,
  verdict,
  differential_gain,
  outcome,
};

/// How the computation of a cell ended.
enum class CellOutcome {
  computed,
  diverges,     ///< the motion left the range of numbers within the duration
  invalid,      ///< the case is not admissible; nothing was computed
  no_gain,      ///< no best D: none lets the motion settle; nothing was computed
  aliased,      ///< no best D: the samples do not show the vibration; nothing was computed
  accumulates,  ///< the motion's changes of contact do: it cannot be followed
};

/// Whether there is a motion that the metrics tell of.
inline bool has_motion(CellOutcome outcome) {
  return outcome == CellOutcome::computed || outcome == CellOutcome::diverges;
}

/// Results of a cell; what was not asked for stays as it is here.
struct CellResult {
  CellOutcome outcome = CellOutcome::invalid;
  MotionMetrics motion = {};
  double uncontrolled_peak = std::numeric_limits<double>::quiet_NaN();  // m, steady
  double largest_exponent = std::numeric_limits<double>::quiet_NaN();   // per sample
  std::int64_t period = 0;  // samples of the certified orbit; 0: none
  AttractorType kind = AttractorType::undecided;
  double differential_gain = std::numeric_limits<double>::quiet_NaN();  // N s/m, in force
};

/// The metric of that name. Throws WrongInput, which names the nearest one.
SweepMetric metric_named(const std::string& name);

/// Metrics of a sweep that names none: how much of the vibration is left.
const std::vector<SweepMetric>& usual_metrics();

/// Name, unit and definition.
const CellColumn& metric_column(SweepMetric metric);

/// The value of a cell, as CellColumn wants it: where the motion diverges, peaks, forces and
/// stroke are inf; where there is no motion, reals are nan and whole numbers 0.
double metric_value(SweepMetric metric, const CellResult& result);

/// Every name, separated by commas, for a help text.
std::string metric_names();

}  // namespace holdfast::program
