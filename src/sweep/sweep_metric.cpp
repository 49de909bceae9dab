#include "sweep/sweep_metric.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "io/text/text.hpp"
#include "process/errors.hpp"

namespace holdfast::program {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

std::vector<std::string> outcome_words() {
  return {"computed", "diverges", "invalid", "no_gain", "aliased", "accumulates"};
}

/// The code of a verdict on what is not admissible: behind those of AttractorType.
constexpr double invalid_code = static_cast<double>(AttractorType::undecided) + 1.0;

/// In the order of these codes.
std::vector<std::string> kind_words() {
  return {"periodic", "quasi-periodic", "irregular", "chaotic", "diverges", "undecided", "invalid"};
}

struct NamedColumn {
  SweepMetric metric;
  CellColumn column;
};

using Metric = SweepMetric;

std::vector<NamedColumn> vibration_columns() {
  return {{Metric::first_peak,
           {{"first_peak", "m", "|z1| at the first local extremum of z1 after the start"}, {}}},
          {Metric::steady_peak,
           {{"steady_peak", "m", "largest |z1| in the second half of the duration"}, {}}},
          {Metric::steady_rms,
           {{"steady_rms", "m", "root mean square of z1 in the second half of the duration"}, {}}},
          {Metric::ratio_to_uncontrolled,
           {{"ratio_to_uncontrolled", "",
             "steady_peak over that of the same case with P = D = 0 and no backlash"},
            {}}},
          {Metric::attenuates,
           {{"attenuates", "", "1: ratio_to_uncontrolled is below 1, 0: it is not", "integer"},
            {"no", "yes"}}}};
}

std::vector<NamedColumn> drive_columns() {
  return {{Metric::engaged_fraction,
           {{"engaged_fraction", "",
             "share of the samples of the second half at which the drive transmits its force"},
            {}}},
          {Metric::force_peak,
           {{"force_peak", "N", "largest |u| of all samples, what the drive must deliver"}, {}}},
          {Metric::force_rms,
           {{"force_rms", "N", "root mean square of u in the second half of the duration"}, {}}},
          {Metric::reversals_per_s,
           {{"reversals_per_s", "1/s",
             "sign changes of v2 - v1 from sample to sample in the second half, per second"},
            {}}},
          {Metric::absorber_stroke,
           {{"absorber_stroke", "m", "largest less smallest z2 - z1 of all samples"}, {}}}};
}

std::vector<NamedColumn> attractor_columns() {
  return {
      {Metric::largest_exponent,
       {{"largest_exponent", "", "Lyapunov exponent per sample over the whole duration"}, {}}},
      {Metric::period_samples,
       {{"period_samples", "", "of the certified orbit; 0 where none was found", "integer"}, {}}},
      {Metric::verdict,
       {{"verdict", "", "what the motion is, as the job verdict finds", "string"}, kind_words()}},
      {Metric::differential_gain,
       {{"differential_gain", "N.s/m", "D in force: the best one where that was asked for"}, {}}},
      {Metric::outcome,
       {{"outcome", "",
         "computed; diverges: the motion leaves the range of numbers within the duration (one that "
         "grows more slowly is computed); invalid: the case is not admissible; no_gain, aliased: "
         "there is no best gain; accumulates: the contact changes too often to be followed",
         "string"},
        outcome_words()}}};
}

/// All of them, in the order of SweepMetric.
const std::vector<NamedColumn>& columns() {
  static const std::vector<NamedColumn> all = [] {
    std::vector<NamedColumn> joined = vibration_columns();
    for (const auto& part : {drive_columns(), attractor_columns()})
      joined.insert(joined.end(), part.begin(), part.end());
    return joined;
  }();
  return all;
}

double verdict_code(const CellResult& result) {
  if (result.outcome == CellOutcome::accumulates)
    return static_cast<double>(AttractorType::undecided);
  if (!has_motion(result.outcome)) return invalid_code;
  if (result.outcome == CellOutcome::diverges) return static_cast<double>(AttractorType::diverges);
  return static_cast<double>(result.kind);
}

double ratio_of(const CellResult& result) {
  return result.motion.steady_peak / result.uncontrolled_peak;
}

/// Of a cell that has a motion.
double known_value(SweepMetric metric, const CellResult& result) {
  const MotionMetrics& motion = result.motion;
  switch (metric) {
    case SweepMetric::first_peak:
      return motion.first_peak;
    case SweepMetric::steady_peak:
      return motion.steady_peak;
    case SweepMetric::steady_rms:
      return motion.steady_rms;
    case SweepMetric::ratio_to_uncontrolled:
      return ratio_of(result);
    case SweepMetric::attenuates:
      return ratio_of(result) < 1.0 ? 1.0 : 0.0;
    case SweepMetric::engaged_fraction:
      return motion.engaged_fraction;
    case SweepMetric::force_peak:
      return motion.force_peak;
    case SweepMetric::force_rms:
      return motion.force_rms;
    case SweepMetric::reversals_per_s:
      return motion.reversals_per_s;
    case SweepMetric::absorber_stroke:
      return motion.absorber_stroke;
    case SweepMetric::largest_exponent:
      return result.largest_exponent;
    case SweepMetric::period_samples:
      return static_cast<double>(result.period);
    case SweepMetric::verdict:
      return verdict_code(result);
    case SweepMetric::differential_gain:
      return result.differential_gain;
    case SweepMetric::outcome:
      break;
  }
  return static_cast<double>(result.outcome);
}

}  // namespace

SweepMetric metric_named(const std::string& name) {
  const NamedColumn* nearest = &columns().front();
  const auto distance = [&name](const NamedColumn& known) {
    return edit_distance(known.column.column.name, name);
  };
  for (const NamedColumn& known : columns()) {
    if (known.column.column.name == name) return known.metric;
    if (distance(known) < distance(*nearest)) nearest = &known;
  }
  throw WrongInput("--metric " + name + ": unknown; did you mean " + nearest->column.column.name +
                   "? There are " + metric_names());
}

const std::vector<SweepMetric>& usual_metrics() {
  static const std::vector<SweepMetric> usual = {SweepMetric::steady_peak,
                                                 SweepMetric::ratio_to_uncontrolled,
                                                 SweepMetric::attenuates, SweepMetric::outcome};
  return usual;
}

const CellColumn& metric_column(SweepMetric metric) {
  return std::find_if(columns().begin(), columns().end(),
                      [metric](const NamedColumn& known) { return known.metric == metric; })
      ->column;
}

double metric_value(SweepMetric metric, const CellResult& result) {
  if (has_motion(result.outcome)) return known_value(metric, result);
  const Column& column = metric_column(metric).column;
  if (column.datatype == "double") return not_a_number;
  if (column.datatype == "integer") return 0.0;
  return known_value(metric, result);
}

std::string metric_names() {
  std::string names;
  for (const NamedColumn& known : columns())
    names += (names.empty() ? "" : ", ") + known.column.column.name;
  return names;
}

}  // namespace holdfast::program
