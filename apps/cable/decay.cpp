#include "cable_options.hpp"
#include "case/model/cable_of_case.hpp"
#include "io/text/table.hpp"
#include "process/exit.hpp"

namespace holdfast::program {
namespace {

struct DecayOptions {
  double force = 0.2;
  CableOptions cable;
};

void run(const JobContext& context, const DecayOptions& options) {
  report_warning(borrowed_cable_warning(context.case_data), context.quiet);
  Table table(context,
              {{"time_s", "s", "since the force was removed"},
               {"elements_m", "m", "displacement of the absorber's place, continuous cable"},
               {"two_dof_m", "m", "displacement z1 of the two-mass plant"}});
  const CableDecay cable =
      cable_decay(context.case_data, options.cable.question(options.force, 10.0));
  const double start =
      plant_start(context, options.cable, options.force, cable.initial_displacement);
  const DecayRecord plant = plant_decay(context, start, cable.record);
  for (std::size_t k = 0; k < plant.times.size(); ++k)
    table.row(plant.times[k], cable.record.displacements[k], plant.displacements[k]);
  table.commit();
}

}  // namespace

void add_decay(CLI::App& program) {
  const Job job(program, "decay", question::cable,
                "Vibration after a force is removed: continuous cable beside the plant");
  const auto options = std::make_shared<DecayOptions>();
  job->add_option("--force", options->force,
                  "Force that is removed, N, downward, beyond the absorber's weight")
      ->check(number_from(-1e9, 1e9))
      ->type_name("")
      ->capture_default_str();
  add_cable_options(job, options->cable, "10");
  job->final_callback([job, options] {
    require_sundials();
    run(job.context(), *options);
  });
}

}  // namespace holdfast::program
