#include "sweep/sweep_plan.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>

#include "case/axes/axis.hpp"
#include "case/model/cable_of_case.hpp"
#include "case/model/conditioning.hpp"
#include "case/model/loop_of_case.hpp"
#include "case/model/modal/modal_plant_of_case.hpp"
#include "case/model/modal/modes_warning.hpp"
#include "case/model/resolved_plant.hpp"
#include "case/needed.hpp"
#include "case/plausibility/doubts.hpp"
#include "holdfast/motion/trajectory.hpp"
#include "process/errors.hpp"
#include "process/exit.hpp"
#include "store/stored_grid.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

constexpr double most_cells = 9007199254740992.0;  // 2⁵³
constexpr const char* sampling_key = "control.sampling_period";

GridAxis sweep_axis(const std::string& text) {
  const std::string name(trimmed(std::string_view(text).substr(0, text.find('='))));
  const CaseKey* key = find_case_key(name);
  if (key != nullptr && !key->is_number())
    throw WrongInput("--axis " + text + ": " + name +
                     " has no numbers as values; run one sweep for each of its values with --set");
  const KeyValues axis = parse_key_values("--axis", text);
  if (key == nullptr) {
    throw WrongInput("--axis " + text + ": unknown key " + name + "; did you mean " +
                     nearest_case_key(name).name + "?");
  }
  return grid_axis(*key, axis);
}

std::vector<GridAxis> sweep_axes(const std::vector<std::string>& texts) {
  if (texts.empty())
    throw WrongInput("--axis is missing: a sweep needs at least one, for example --axis " +
                     std::string(sampling_key) + "=0.001:0.03:30");
  std::vector<GridAxis> axes;
  std::set<std::string> keys;
  double cells = 1.0;
  for (const std::string& text : texts) {
    axes.push_back(sweep_axis(text));
    const std::string& key = axes.back().column.name;
    if (!keys.insert(key).second) throw WrongInput("--axis: " + key + " is given twice");
    cells *= static_cast<double>(axes.back().count());
  }
  if (cells > most_cells)
    throw WrongInput("--axis: " + format_rounded(cells) +
                     " cells exceed the limit of 2^53: lower a COUNT");
  return axes;
}

/// The axes of a sweep; for a family one axis with the numbers of its members.
std::vector<GridAxis> axes_of(const SweepOptions& options) {
  if (options.members == 0) return sweep_axes(options.axes);
  if (!options.axes.empty() || !options.part.empty() || options.resume)
    throw WrongInput(
        "--family replaces the grid of --axis by the members of the family: leave --axis, --part "
        "and --resume out");
  return {{{"member", "", "number of the member of the family, from 0"},
           Axis{0.0, options.members - 1.0, options.members}}};
}

std::vector<SweepMetric> sweep_metrics(const std::vector<std::string>& names) {
  if (names.empty()) return usual_metrics();
  std::vector<SweepMetric> metrics;
  for (const std::string& name : names) {
    metrics.push_back(metric_named(name));
    if (std::count(metrics.begin(), metrics.end(), metrics.back()) > 1)
      throw WrongInput("--metric " + name + ": given twice; remove one");
  }
  return metrics;
}

std::string table_of(const GridAxis& axis) { return find_case_key(axis.column.name)->table(); }

/// Whether an axis is over a key from which the plant may be reduced.
bool is_of_conductor(const GridAxis& axis) {
  const std::string table = table_of(axis);
  return table == "conductor" || table == "absorber" || table == "reduction";
}

/// The axes on which the reduction of the plant depends. A key of [plant] overrides its result.
std::vector<std::size_t> axes_shaping_plant(const Case& the_case,
                                            const std::vector<GridAxis>& axes) {
  const bool reduced =
      plant_is_reduced(the_case) || std::any_of(axes.begin(), axes.end(), is_of_conductor);
  std::vector<std::size_t> shaping;
  for (std::size_t k = 0; k < axes.size(); ++k) {
    if (is_of_conductor(axes[k]) || (reduced && table_of(axes[k]) == "plant")) shaping.push_back(k);
  }
  return shaping;
}

/// Throws WrongInput for --best-gain with an axis over D or without time for a motion to settle.
void require_room_for_best_gain(const SweepOptions& options, const std::vector<GridAxis>& axes) {
  if (!options.best_gain) return;
  if (!(options.duration > 0.0)) throw WrongInput("--best-gain needs a --duration above 0");
  for (const GridAxis& axis : axes) {
    if (axis.column.name == "control.differential_gain")
      throw WrongInput("--best-gain finds control.differential_gain: remove that --axis");
  }
}

/// Number of samples of one motion; 0 if τ is not admissible.
double samples_of(double duration, double sampling_period) {
  const bool countable = sampling_period > 0.0 && duration / sampling_period < 9e15;
  return countable ? static_cast<double>(samples_within(duration, sampling_period)) : 0.0;
}

}  // namespace

SweepPlan::SweepPlan(const JobContext& context, const SweepOptions& options)
    : context_(context),
      options_(options),
      metrics_(sweep_metrics(options.metrics)),
      layout_{axes_of(options), {}} {
  if (options.members > 0) members_ = family_members(context.case_data, options.members);
  for (const SweepMetric metric : metrics_) layout_.columns.push_back(metric_column(metric));
  require_room_for_best_gain(options_, layout_.axes);
  if (members_.empty()) {
    for (const GridAxis& axis : layout_.axes)
      require_in_force(context_.case_data, *find_case_key(axis.column.name));
    shaping_axes_ = axes_shaping_plant(context_.case_data, layout_.axes);
  } else {
    shaping_axes_ = {0};
  }
  settle_case();
  const bool over_absorbers =
      std::any_of(layout_.axes.begin(), layout_.axes.end(),
                  [](const GridAxis& axis) { return axis.column.name == "plant.absorber_mass"; });
  if (!over_absorbers) require_absorber(context_.case_data);
  require_loops();
  samples_ = counted_samples();
  for (const GridAxis& axis : layout_.axes) grid_.shape.push_back(axis.count());
  const auto most =
      options_.chunk_cells > 0 ? static_cast<double>(options_.chunk_cells) : chosen_chunk_cells();
  grid_.chunk = chunk_shape(grid_.shape, static_cast<std::size_t>(most));
}

void SweepPlan::settle_case() {
  if (shaping_axes_.empty()) {
    report_warning(settle_plant(context_.case_data), context_.quiet);
    report_warning(borrowed_gains_text(context_.case_data), context_.quiet);
    report_warning(modes_warning(context_.case_data), context_.quiet);
    report_warning(drift_warning(context_.case_data), context_.quiet);
    report_warning(transient_warning(context_.case_data, options_.duration), context_.quiet);
    report_warning(dense_work_warning(context_.case_data, options_.switching), context_.quiet);
  } else {
    constexpr std::size_t most_known = 1000;  // a few megabytes
    reduced_cases_ = std::make_shared<decltype(reduced_cases_)::element_type>(most_known);
  }
}

/// The reduced case of the overrides. Throws what the reduction threw, on every call.
Case SweepPlan::reduced_case(const std::vector<std::string>& overrides) const {
  const auto reduced = [source = context_.case_source, overrides] {
    Case the_case = source.load(overrides);
    settle_plant(the_case);
    return the_case;
  };
  const auto later = [&] { return std::async(std::launch::deferred, reduced).share(); };
  return reduced_cases_->of(overrides, later).get();
}

bool SweepPlan::wants(SweepMetric metric) const {
  return std::count(metrics_.begin(), metrics_.end(), metric) > 0;
}

double SweepPlan::axis_value(std::size_t axis, std::int64_t cell) const {
  return layout_.axes[axis].at(index_along(layout_.axes, axis, static_cast<std::size_t>(cell)));
}

Case SweepPlan::case_of(std::int64_t cell) const {
  if (!members_.empty()) return reduced_case(members_[static_cast<std::size_t>(cell)].overrides());
  std::vector<std::string> shaping;
  for (const std::size_t k : shaping_axes_)
    shaping.push_back(layout_.axes[k].column.name + "=" + format_number(axis_value(k, cell)));
  Case the_case = reduced_cases_ ? reduced_case(shaping) : context_.case_data;
  for (std::size_t k = 0; k < layout_.axes.size(); ++k) {
    if (std::count(shaping_axes_.begin(), shaping_axes_.end(), k) == 0)
      set_case_value(the_case, layout_.axes[k].column.name, axis_value(k, cell));
  }
  check_case(the_case);
  return the_case;
}

/// Throws MissingKeys for keys that every loop needs. Other faults are outcomes of single cells.
void SweepPlan::require_loops() const {
  try {
    require_loop_keys(case_of(0));
  } catch (const MissingKeys&) {
    throw;
  } catch (const Refusal&) {
  } catch (const InvalidParameter&) {
  }
}

double SweepPlan::counted_samples() const {
  constexpr std::size_t most_counted = 1'000'000;
  for (const GridAxis& axis : layout_.axes) {
    if (axis.column.name != sampling_key) continue;
    const std::size_t stride = axis.count() / most_counted + 1;
    double sum = 0.0, counted = 0.0;
    for (std::size_t i = 0; i < axis.count(); i += stride, ++counted)
      sum += samples_of(options_.duration, axis.at(i));
    return sum / counted * static_cast<double>(cells());
  }
  return static_cast<double>(cells()) *
         samples_of(options_.duration, context_.case_data.control.sampling_period);
}

/// The number of cells of a chunk. A chunk takes some tenths of a second, so that an interruption
/// loses little; there are enough chunks for many cores, each with enough cells for all SIMD lanes.
/// The number depends on the plan alone, so that a resumed sweep finds the same chunks.
double SweepPlan::chosen_chunk_cells() const {
  constexpr double samples_of_chunk = 1e8, most_chunks_wanted = 64.0;
  const bool orbits = wants(SweepMetric::period_samples) || wants(SweepMetric::verdict);
  const bool exponents = wants(SweepMetric::largest_exponent);
  const auto all = static_cast<double>(cells());
  double cost = std::max(samples() / all, 1.0);
  if (exponents) cost *= 5.0;
  if (orbits) cost += 20.0 * static_cast<double>(options_.largest_period);
  // A reduction takes some tenths of a second, and every cell may need one.
  const bool reductions = !shaping_axes_.empty();
  if (reductions) cost += 0.1 * samples_of_chunk;
  const double fewest = orbits || exponents || reductions ? 8.0 : 64.0;
  const double share = std::max(all / most_chunks_wanted, fewest);
  const double fitting =
      std::clamp(samples_of_chunk / cost, 1.0, static_cast<double>(values_in_chunk));
  return std::floor(std::min({fitting, share, all}));
}

StoreDescription SweepPlan::store() const {
  StoreDescription store = store_description(context_, layout_);
  store.grid = grid_;
  if (!wants(SweepMetric::outcome)) store.columns.push_back(metric_column(SweepMetric::outcome));
  store.plan = store_plan();
  return store;
}

StorePlan SweepPlan::store_plan() const {
  StorePlan entries = {{"version", HOLDFAST_VERSION}, {"job", context_.job}};
  entries.emplace("--instructions", name_of(context_.instructions));
  entries.emplace("--chunk", std::to_string(grid_.cells_of_file()));
  for (std::size_t k = 0; k < options_.axes.size(); ++k)
    entries.emplace("--axis " + std::to_string(k + 1), options_.axes[k]);
  for (std::size_t k = 0; k < metrics_.size(); ++k)
    entries.emplace("--metric " + std::to_string(k + 1), metric_column(metrics_[k]).column.name);
  if (options_.members > 0) entries.emplace("--draws", std::to_string(options_.members));
  entries.emplace("--duration", format_number(options_.duration));
  entries.emplace("--max-period", std::to_string(options_.largest_period));
  entries.emplace("--switching", options_.switching == Switching::exact ? "exact" : "sampled");
  append_case(entries, context_.case_data);
  entries.emplace("--best-gain", options_.best_gain ? "yes" : "no");
  if (reduced_cases_) {
    const CaseSource& source = context_.case_source;
    entries.emplace("case file", source.text.value_or("built-in"));
    for (std::size_t k = 0; k < source.overrides.size(); ++k)
      entries.emplace("--set " + std::to_string(k + 1), source.overrides[k]);
  }
  return entries;
}

}  // namespace holdfast::program
