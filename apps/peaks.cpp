#include <cmath>

#include "axis.hpp"
#include "cable_options.hpp"
#include "progress.hpp"
#include "table.hpp"

namespace holdfast::program {
namespace {

struct Options {
  std::string force = "-1:1:21";
  CableOptions cable;
};

void run(const JobContext& context, const Options& options) {
  const Axis forces = parse_axis("--force", options.force);
  Table table(context,
              {{"force_N", "N", "removed, downward, beyond the absorber's weight"},
               {"elements_peak_m", "m", "first opposite peak of the continuous cable"},
               {"two_dof_peak_m", "m", "first opposite peak of the two-mass plant"},
               {"discrepancy", "", "|two_dof_peak_m - elements_peak_m| / |elements_peak_m|"}});
  Progress progress(static_cast<std::uint64_t>(forces.count), "peaks", progress_wanted(context));
  for (std::int64_t k = 0; k < forces.count; ++k) {
    const double force = forces.at(k);
    const CableDecay cable = cable_decay(context.case_data, options.cable.question(force));
    const double start = plant_start(context, options.cable, force, cable.initial_displacement);
    const double elements_peak = decay_measures(cable.record).first_peak;
    const double plant_peak = decay_measures(plant_decay(context, start, cable.record)).first_peak;
    table.row(force, elements_peak, plant_peak,
              std::abs(plant_peak - elements_peak) / std::abs(elements_peak));
    progress.advance();
  }
  table.commit();
}

}  // namespace

void add_peaks(CLI::App& program) {
  const Job job(program, "peaks", question::cable,
                "First peak after a force is removed, over the force");
  const auto options = std::make_shared<Options>();
  // Two cycles of a slow cable; the first opposite peak lies well within.
  options->cable.duration = 1.0;
  options->cable.elements = 40;
  job.add_text("--force", options->force, "Forces that are removed, MIN:MAX:COUNT, N, downward");
  add_cable_options(job, options->cable);
  job->final_callback([job, options] {
    require_sundials();
    run(job.context(), *options);
  });
}

}  // namespace holdfast::program
