#include "case/axes/axis.hpp"
#include "case/model/plant_of_case.hpp"
#include "holdfast/control/loop_input.hpp"
#include "job.hpp"
#include "jobs/charts/chart_rows.hpp"

namespace holdfast::program {
namespace {

struct ResponseOptions {
  std::string p = "-1000:200:61";
  std::string d = "-40:20:61";
};

void run(const JobContext& context, const ResponseOptions& options) {
  const SampledLoop<double> loop = loop_of(context.case_data);
  const HarmonicExcitation<double> excitation = excitation_of(context.case_data);
  const double omega = excitation.angular_frequency();
  const auto input =
      harmonic_input(plant_of(context.case_data), loop, force_hold_of(context.case_data), omega);
  const SteadyResponse<double> response(loop, input, omega);
  const GainGrid grid{parse_axis("--p", options.p), parse_axis("--d", options.d)};
  GridTable table(
      context, {{"proportional_gain", "N/m", "P"}, grid.proportional},
      {{"differential_gain", "N.s/m", "D"}, grid.differential},
      {{{"stable", "", "1: asymptotically stable, 0: not", "integer"}, {"unstable", "stable"}},
       {{"amplitude_m", "m", "steady amplitude of z1 without backlash; nan where unstable"}},
       {{"ratio_to_uncontrolled", "", "amplitude over that without control; nan where unstable"}}});
  append_response_chart(context, loop, response, excitation.amplitude, grid, table);
  table.commit();
}

}  // namespace

void add_response(CLI::App& program) {
  const Job job(program, "response", question::gains,
                "Steady amplitude over the gains, without backlash, in closed form");
  const auto options = std::make_shared<ResponseOptions>();
  job.add_text("--p", options->p, "Proportional gains P, MIN:MAX:COUNT, N/m");
  job.add_text("--d", options->d, "Differential gains D, MIN:MAX:COUNT, N s/m");
  job->final_callback([job, options] { run(job.context(), *options); });
}

}  // namespace holdfast::program
