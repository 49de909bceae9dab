#include "case/axes/axis.hpp"
#include "case/model/conditioning.hpp"
#include "case/model/linear_loop.hpp"
#include "case/model/plant_of_case.hpp"
#include "job.hpp"
#include "jobs/charts/chart_rows.hpp"
#include "report/figures/figure.hpp"

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
    const HarmonicExcitation<double> excitation = excitation_of(context.case_data);
    const auto response = LinearLoop(context.case_data).response(excitation.frequency);
    report_warning(
        held_force_warning(
            context.case_data,
            "amplitude_m is computed with the held force; the ratios are relative to the "
            "amplitude without control under the continuous force"),
        context.quiet);
    const GainGrid grid{parse_axis("--p", shown_gains(context, "--p", p)),
                        parse_axis("--d", shown_gains(context, "--d", d))};
    write_chart(context, {gain_axes(grid), cell_columns_of("response")},
                response_chart(context, response, excitation.amplitude, grid));
  }
};

}  // namespace

void add_response(CLI::App& program) { add_job<ResponseQuestion>(program, "response"); }

}  // namespace holdfast::program
