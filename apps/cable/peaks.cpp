#include <cmath>

#include "cable_options.hpp"
#include "case/axes/axis.hpp"
#include "case/model/cable_of_case.hpp"
#include "io/text/table.hpp"
#include "process/exit.hpp"
#include "process/progress.hpp"

namespace holdfast::program {
namespace {

struct PeaksOptions {
  std::string force = "-1:1:21";
  CableOptions cable;
};

void run(const JobContext& context, const PeaksOptions& options) {
  report_warning(borrowed_cable_warning(context.case_data), context.quiet);
  const Axis forces = parse_axis("--force", options.force);
  const double duration = 2.0 / context.case_data.reduction.first_frequency;
  Table table(
      context,
      {{"force_N", "N", "removed, downward, beyond the absorber's weight"},
       {"elements_peak_m", "m", "first opposite peak of the continuous cable; nan: none so far"},
       {"two_dof_peak_m", "m", "first opposite peak of the two-mass plant; nan: none so far"},
       {"discrepancy", "",
        "|two_dof_peak_m - elements_peak_m| / |elements_peak_m|; nan under no "
        "force or without a peak"}});
  Progress progress(static_cast<std::uint64_t>(forces.count), "peaks", progress_wanted(context));
  for (std::int64_t k = 0; k < forces.count; ++k) {
    progress.advance();
    const double force = forces.at(k);
    if (force == 0.0) {
      table.row(0.0, 0.0, 0.0, std::nan(""));
      continue;
    }
    const CableDecay cable =
        cable_decay(context.case_data, options.cable.question(force, duration));
    const double start = plant_start(context, options.cable, force, cable.initial_displacement);
    const double elements_peak = decay_measures(cable.record).first_peak;
    const double plant_peak = decay_measures(plant_decay(context, start, cable.record)).first_peak;
    table.row(force, elements_peak, plant_peak,
              std::abs(plant_peak - elements_peak) / std::abs(elements_peak));
  }
  table.commit();
}

}  // namespace

void add_peaks(CLI::App& program) {
  const Job job(program, "peaks", question::cable,
                "First peak after a force is removed, over the force");
  const auto options = std::make_shared<PeaksOptions>();
  options->cable.elements = 40;
  job.add_text("--force", options->force, "Forces that are removed, MIN:MAX:COUNT, N, downward");
  add_cable_options(job, options->cable, "two periods of reduction.first_frequency");
  job->final_callback([job, options] {
    require_sundials();
    run(job.context(), *options);
  });
}

}  // namespace holdfast::program
