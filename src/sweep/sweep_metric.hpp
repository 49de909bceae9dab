#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "holdfast/chaos/classification.hpp"
#include "holdfast/sweep/motion_metrics.hpp"
#include "output/grid/grid_output.hpp"

namespace holdfast::program {

/// Metrics of a cell of a sweep, named as their columns. metric_column() has definitions and units.
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

enum class CellOutcome {
  computed,
  diverges,     ///< the motion left the range of numbers within the duration
  invalid,      ///< the case is not admissible; nothing was computed
  no_gain,      ///< no best D, since no D lets the motion settle; nothing was computed
  aliased,      ///< no best D, since the excitation is aliased; nothing was computed
  accumulates,  ///< too many changes of contact within one sampling period to follow the motion
};

/// Whether a cell has a motion and therefore metrics.
inline bool has_motion(CellOutcome outcome) {
  return outcome == CellOutcome::computed || outcome == CellOutcome::diverges;
}

/// Results of a cell. A result that was not requested keeps its initial value.
struct CellResult {
  CellOutcome outcome = CellOutcome::invalid;
  MotionMetrics motion = {};
  double uncontrolled_peak = std::numeric_limits<double>::quiet_NaN();  // m, steady
  double largest_exponent = std::numeric_limits<double>::quiet_NaN();   // per sample
  std::int64_t period = 0;  // samples of the certified orbit; 0: none
  AttractorType kind = AttractorType::undecided;
  double differential_gain = std::numeric_limits<double>::quiet_NaN();  // D (N s/m) of the motion
};

/// The metric with the given name. Throws WrongInput, which names the most similar metric.
SweepMetric metric_named(const std::string& name);

/// Default metrics of a sweep: steady peak, its ratio to no control, attenuation and outcome.
const std::vector<SweepMetric>& usual_metrics();

/// Name, unit and definition of a metric.
const CellColumn& metric_column(SweepMetric metric);

/// The value of a metric in a cell, as CellColumn stores it. If the motion diverges, peaks, forces
/// and stroke are inf; without a motion, reals are nan and whole numbers 0.
double metric_value(SweepMetric metric, const CellResult& result);

/// All names of metrics, separated by commas, for a help text.
std::string metric_names();

}  // namespace holdfast::program
