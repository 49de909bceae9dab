#include <string>
#include <vector>

#include "case/axes/axis.hpp"
#include "case/axes/grid.hpp"
#include "case/case_keys.hpp"
#include "case/model/plant_of_case.hpp"
#include "holdfast/stability/chart/loop_chart.hpp"
#include "io/text/names.hpp"
#include "job.hpp"
#include "jobs/charts/chart_rows.hpp"
#include "process/errors.hpp"

namespace holdfast::program {
namespace {

constexpr Named<LoopParameter> parameter_keys[] = {
    {LoopParameter::proportional_gain, "control.proportional_gain"},
    {LoopParameter::differential_gain, "control.differential_gain"},
    {LoopParameter::sampling_period, "control.sampling_period"},
    {LoopParameter::processing_delay, "control.processing_delay"},
    {LoopParameter::conductor_mass, "plant.conductor_mass"},
    {LoopParameter::conductor_stiffness, "plant.conductor_stiffness"},
    {LoopParameter::conductor_damping, "plant.conductor_damping"},
    {LoopParameter::absorber_mass, "plant.absorber_mass"},
    {LoopParameter::absorber_stiffness, "plant.absorber_stiffness"},
    {LoopParameter::absorber_damping, "plant.absorber_damping"}};

LoopParameter parameter_of(const std::string& key) {
  std::string known;
  for (const auto& [parameter, name] : parameter_keys) {
    if (key == name) return parameter;
    known += (known.empty() ? "" : ", ") + std::string(name);
  }
  throw WrongInput("--axis: stability does not depend on " + key + "; it does on " + known);
}

/// An axis whose two ends the key admits.
KeyAxis admissible_axis(const std::string& text) {
  KeyAxis axis = parse_key_axis("--axis", text);
  parameter_of(axis.key);
  const CaseKey& key = *find_case_key(axis.key);
  for (const double end : {axis.axis.min, axis.axis.max}) {
    if (!key.range.contains(end)) {
      throw WrongInput("--axis " + text + ": " + axis.key + " must be " + key.admissible());
    }
  }
  return axis;
}

struct StabilityOptions {
  std::string p = "-1000:200:121";
  std::string d = "-40:20:121";
  std::vector<std::string> axes;
  bool continuous = false;
  bool radius = false;
};

std::vector<CellColumn> columns(const StabilityOptions& options) {
  std::vector<CellColumn> result = {
      {{"stable", "", "1: asymptotically stable, 0: not", "integer"}, {"unstable", "stable"}}};
  if (!options.radius) return result;
  if (options.continuous) {
    result.push_back({{"spectral_abscissa", "1/s", "largest real part of a characteristic root"}});
  } else {
    result.push_back({{"spectral_radius", "", "largest modulus of a characteristic root"}});
  }
  return result;
}

void run_over_gains(const JobContext& context, const StabilityOptions& options) {
  const GainGrid grid{parse_axis("--p", options.p), parse_axis("--d", options.d)};
  GridTable table(context, {{"proportional_gain", "N/m", "P"}, grid.proportional},
                  {{"differential_gain", "N.s/m", "D"}, grid.differential}, columns(options));
  if (options.continuous) {
    append_continuous_chart(context, plant_of(context.case_data), grid, options.radius, table);
  } else {
    const LoopChart chart{operating_point_of(context.case_data),
                          {LoopParameter::proportional_gain, grid.proportional},
                          {LoopParameter::differential_gain, grid.differential}};
    append_sampled_chart(context, chart, options.radius, table);
  }
  table.commit();
}

/// A sampling period on an axis takes the processing delay with it in proportion; a tuned P stays
/// that of the case.
void run_over_axes(const JobContext& context, const StabilityOptions& options) {
  if (options.axes.size() != 2) {
    throw WrongInput("--axis: a chart needs two axes, not " + std::to_string(options.axes.size()));
  }
  const KeyAxis slow = admissible_axis(options.axes[0]), fast = admissible_axis(options.axes[1]);
  if (slow.key == fast.key) throw WrongInput("--axis: both axes are " + slow.key);
  const LoopChart chart{operating_point_of(context.case_data),
                        {parameter_of(slow.key), slow.axis},
                        {parameter_of(fast.key), fast.axis}};
  validate(chart);
  GridTable table(context, grid_axis(slow), grid_axis(fast), columns(options));
  append_sampled_chart(context, chart, options.radius, table);
  table.commit();
}

}  // namespace

void add_stability(CLI::App& program) {
  const Job job(program, "stability", question::gains, "Chart of stable gains (P, D)");
  const auto options = std::make_shared<StabilityOptions>();
  CLI::Option* p = job.add_text("--p", options->p, "Proportional gains P, MIN:MAX:COUNT, N/m");
  CLI::Option* d = job.add_text("--d", options->d, "Differential gains D, MIN:MAX:COUNT, N s/m");
  CLI::Option* continuous =
      job->add_flag("--continuous", options->continuous, "Without sampling: the continuous loop");
  job->add_option("--axis", options->axes,
                  "KEY=MIN:MAX:COUNT, twice: a chart over two keys of [control] or [plant] instead")
      ->expected(1)
      ->take_all()
      ->excludes(p)
      ->excludes(d)
      ->excludes(continuous);
  job->add_flag("--radius", options->radius,
                "Add the spectral radius (continuous: spectral abscissa)");
  job.computes_on_packs();
  job->final_callback([job, options] {
    options->axes.empty() ? run_over_gains(job.context(), *options)
                          : run_over_axes(job.context(), *options);
  });
}

}  // namespace holdfast::program
