#include "sweep/sweep_metric.hpp"

#include <algorithm>
#include <cstddef>

#include "jobs/columns.hpp"
#include "process/errors.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// Code of the verdict on a cell without motion, after the codes of AttractorType.
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

using Cell = const CellResult&;

/// The values of a cell that has a motion, in the order of SweepMetric.
constexpr double (*values_of_cells[])(Cell) = {
    [](Cell cell) { return cell.motion.first_peak; },
    [](Cell cell) { return cell.motion.steady_peak; },
    [](Cell cell) { return cell.motion.steady_rms; },
    ratio_of,
    [](Cell cell) { return ratio_of(cell) < 1.0 ? 1.0 : 0.0; },
    [](Cell cell) { return cell.motion.engaged_fraction; },
    [](Cell cell) { return cell.motion.force_peak; },
    [](Cell cell) { return cell.motion.force_rms; },
    [](Cell cell) { return cell.motion.reversals_per_s; },
    [](Cell cell) { return cell.motion.absorber_stroke; },
    [](Cell cell) { return cell.largest_exponent; },
    [](Cell cell) { return static_cast<double>(cell.period); },
    verdict_code,
    [](Cell cell) { return cell.differential_gain; },
    [](Cell cell) { return static_cast<double>(cell.outcome); }};

/// Columns of the metrics, in the order of SweepMetric.
const std::vector<CellColumn>& columns_of_metrics() {
  static const std::vector<CellColumn> columns = cell_columns_of("sweep metrics");
  return columns;
}

std::vector<std::string> names_of_metrics() {
  std::vector<std::string> names;
  for (const CellColumn& metric : columns_of_metrics()) names.push_back(metric.column.name);
  return names;
}

}  // namespace

SweepMetric metric_named(const std::string& name) {
  const std::vector<std::string> names = names_of_metrics();
  const auto known = std::find(names.begin(), names.end(), name);
  if (known != names.end()) return static_cast<SweepMetric>(known - names.begin());
  throw WrongInput("--metric " + name + ": unknown metric; did you mean " +
                   nearest_name(names, name) + "? The metrics are " + metric_names());
}

const std::vector<SweepMetric>& usual_metrics() {
  static const std::vector<SweepMetric> usual = {SweepMetric::steady_peak,
                                                 SweepMetric::ratio_to_uncontrolled,
                                                 SweepMetric::attenuates, SweepMetric::outcome};
  return usual;
}

const CellColumn& metric_column(SweepMetric metric) {
  return columns_of_metrics()[static_cast<std::size_t>(metric)];
}

double metric_value(SweepMetric metric, const CellResult& result) {
  const std::string& datatype = metric_column(metric).column.datatype;
  if (has_motion(result.outcome) || datatype == "string")
    return values_of_cells[static_cast<std::size_t>(metric)](result);
  return datatype == "integer" ? 0.0 : not_a_number;
}

std::string metric_names() {
  std::string names;
  for (const std::string& name : names_of_metrics()) names += (names.empty() ? "" : ", ") + name;
  return names;
}

}  // namespace holdfast::program
