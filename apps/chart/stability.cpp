#include <array>

#include "case/axes/axis.hpp"
#include "case/axes/loop_axis.hpp"
#include "case/model/plant_of_case.hpp"
#include "case/model/sampled_loop_of_case.hpp"
#include "io/file/input.hpp"
#include "job.hpp"
#include "jobs/charts/chart_rows.hpp"

namespace holdfast::program {
namespace {

struct StabilityOptions {
  std::string p = "-1000:200:121";
  std::string d = "-40:20:121";
  std::vector<std::string> axes;
  bool continuous = false;
  bool radius = false;
};

std::vector<GridColumn> columns(const StabilityOptions& options) {
  std::vector<GridColumn> result = {
      {{"stable", "", "1: asymptotically stable, 0: not", "integer"}, "unstable stable"}};
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

void run_over_axes(const JobContext& context, const StabilityOptions& options) {
  const auto [chart, slow, fast] = loop_chart_of(context.case_data, options.axes);
  GridTable table(context, slow, fast, columns(options));
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
