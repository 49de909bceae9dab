#include "case/axes/axis.hpp"
#include "case/model/held_force.hpp"
#include "case/model/plant_of_case.hpp"
#include "holdfast/control/loop_input.hpp"
#include "job.hpp"
#include "jobs/charts/chart_rows.hpp"

namespace holdfast::program {
namespace {

struct ResponseQuestion {
  std::string p = "-1000:200:61";
  std::string d = "-40:20:61";

  void add_to(const Job& job) {
    job.add("--p", p);
    job.add("--d", d);
  }

  void run(const JobContext& context) const {
    const SampledLoop<double> loop = loop_of(context.case_data);
    const HarmonicExcitation<double> excitation = excitation_of(context.case_data);
    const double omega = excitation.angular_frequency();
    const TwoMass<double> plant = plant_of(context.case_data);
    const auto input = harmonic_input(plant, loop, force_hold_of(context.case_data), omega);
    const auto response = SteadyResponse<double>(loop, input, omega)
                              .relative_to(true_amplitude_per_force(plant, omega));
    report_warning(held_force_warning(context.case_data,
                                      "amplitudes are those of the force as it "
                                      "is held, ratios to the true force's"),
                   context.quiet);
    const GainGrid grid{parse_axis("--p", p), parse_axis("--d", d)};
    GridOutput output(context, {gain_axes(grid), cell_columns_of("response")});
    append_response_chart(context, loop, response, excitation.amplitude, grid, output);
    output.commit();
  }
};

}  // namespace

void add_response(CLI::App& program) { add_job<ResponseQuestion>(program, "response"); }

}  // namespace holdfast::program
