#include "sweep/sweep_metric.hpp"

#include <algorithm>
#include <cstddef>

#include "io/text/text.hpp"
#include "process/errors.hpp"

namespace holdfast::program {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// The code of a verdict on what is not admissible: behind those of AttractorType.
constexpr double invalid_code = static_cast<double>(AttractorType::undecided) + 1.0;

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

/// What a metric is called, and its value of a cell that has a motion.
struct MetricOfCell {
  CellColumn column;
  double (*value)(const CellResult& result);
};

using Cell = const CellResult&;

/// All of them, in the order of SweepMetric.
const std::vector<MetricOfCell> metrics = {
    {{{"first_peak", "m", "|z1| at the first local extremum of z1 after the start"}},
     [](Cell cell) { return cell.motion.first_peak; }},
    {{{"steady_peak", "m", "largest |z1| in the second half of the duration"}},
     [](Cell cell) { return cell.motion.steady_peak; }},
    {{{"steady_rms", "m", "root mean square of z1 in the second half of the duration"}},
     [](Cell cell) { return cell.motion.steady_rms; }},
    {{{"ratio_to_uncontrolled", "",
       "steady_peak over that of the same case with P = D = 0 and no backlash"}},
     ratio_of},
    {{{"attenuates", "", "1: ratio_to_uncontrolled is below 1, 0: it is not", "integer"},
      {"no", "yes"}},
     [](Cell cell) { return ratio_of(cell) < 1.0 ? 1.0 : 0.0; }},
    {{{"engaged_fraction", "",
       "share of the samples of the second half at which the drive transmits its force"}},
     [](Cell cell) { return cell.motion.engaged_fraction; }},
    {{{"force_peak", "N", "largest |u| of all samples, what the drive must deliver"}},
     [](Cell cell) { return cell.motion.force_peak; }},
    {{{"force_rms", "N", "root mean square of u in the second half of the duration"}},
     [](Cell cell) { return cell.motion.force_rms; }},
    {{{"reversals_per_s", "1/s",
       "sign changes of v2 - v1 from sample to sample in the second half, per second"}},
     [](Cell cell) { return cell.motion.reversals_per_s; }},
    {{{"absorber_stroke", "m", "largest less smallest z2 - z1 of all samples"}},
     [](Cell cell) { return cell.motion.absorber_stroke; }},
    {{{"largest_exponent", "", "Lyapunov exponent per sample over the whole duration"}},
     [](Cell cell) { return cell.largest_exponent; }},
    {{{"period_samples", "", "of the certified orbit; 0 where none was found", "integer"}},
     [](Cell cell) { return static_cast<double>(cell.period); }},
    {{{"verdict", "", "what the motion is, as the job verdict finds", "string"},
      {"periodic", "quasi-periodic", "irregular", "chaotic", "diverges", "undecided", "invalid"}},
     verdict_code},
    {{{"differential_gain", "N.s/m", "D in force: the best one where that was asked for"}},
     [](Cell cell) { return cell.differential_gain; }},
    {{{"outcome", "",
       "computed; diverges: the motion leaves the range of numbers within the duration (one that "
       "grows more slowly is computed); invalid: the case is not admissible; no_gain, aliased: "
       "there is no best gain; accumulates: the contact changes too often to be followed",
       "string"},
      {"computed", "diverges", "invalid", "no_gain", "aliased", "accumulates"}},
     [](Cell cell) { return static_cast<double>(cell.outcome); }}};

const MetricOfCell& of(SweepMetric metric) { return metrics[static_cast<std::size_t>(metric)]; }

const std::string& name_of(const MetricOfCell& metric) { return metric.column.column.name; }

}  // namespace

SweepMetric metric_named(const std::string& name) {
  const auto known = std::find_if(metrics.begin(), metrics.end(),
                                  [&](const auto& metric) { return name_of(metric) == name; });
  if (known != metrics.end()) return static_cast<SweepMetric>(known - metrics.begin());
  std::vector<std::string> names;
  names.reserve(metrics.size());
  for (const MetricOfCell& metric : metrics) names.push_back(name_of(metric));
  throw WrongInput("--metric " + name + ": unknown; did you mean " + nearest_name(names, name) +
                   "? There are " + metric_names());
}

const std::vector<SweepMetric>& usual_metrics() {
  static const std::vector<SweepMetric> usual = {SweepMetric::steady_peak,
                                                 SweepMetric::ratio_to_uncontrolled,
                                                 SweepMetric::attenuates, SweepMetric::outcome};
  return usual;
}

const CellColumn& metric_column(SweepMetric metric) { return of(metric).column; }

double metric_value(SweepMetric metric, const CellResult& result) {
  const std::string& datatype = of(metric).column.column.datatype;
  if (has_motion(result.outcome) || datatype == "string") return of(metric).value(result);
  return datatype == "integer" ? 0.0 : not_a_number;
}

std::string metric_names() {
  std::string names;
  for (const MetricOfCell& metric : metrics) names += (names.empty() ? "" : ", ") + name_of(metric);
  return names;
}

}  // namespace holdfast::program
