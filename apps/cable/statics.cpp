#include "case/axes/axis.hpp"
#include "case/model/cable_of_case.hpp"
#include "case/model/elements_of_case.hpp"
#include "io/text/table.hpp"
#include "io/text/text.hpp"
#include "job.hpp"
#include "process/errors.hpp"
#include "process/exit.hpp"
#include "process/interrupt.hpp"

namespace holdfast::program {
namespace {

struct StaticsOptions {
  std::string force = "-1:1:41";
  int elements = 100;
};

/// Displacement of the absorber's node by the finite elements.
double elements_displacement(const CableElements& cable, double force) {
  const auto held = cable.held_by(force);
  if (held.outcome != EquilibriumOutcome::converged)
    throw NoAnswer("under " + format_number(force) + " N no equilibrium of the elements was found");
  return cable.displacement(held.state);
}

void run(const JobContext& context, const StaticsOptions& options) {
  const Case& the_case = context.case_data;
  report_warning(borrowed_cable_warning(the_case), context.quiet);
  report_warning(deep_cable_warning(the_case), context.quiet);
  const Axis forces = parse_axis("--force", options.force);
  for (const double end : {forces.at(0), forces.at(forces.count - 1)})
    require_force_within_statics(the_case, end);
  const auto irvine = irvine_statics_of(the_case);
  const auto exact = exact_statics_of(the_case);
  const CableElements cable = elements_of(the_case, options.elements, AbsorberReading::weight);
  const double stiffness = plant_is_reduced(the_case) ? conductor_stiffness_of(the_case)
                                                      : the_case.plant.conductor_stiffness;
  Table table(context,
              {{"force_N", "N", "beyond the absorber's weight, downward"},
               {"exact_m", "m", "displacement of the absorber's place, two elastic catenaries"},
               {"irvine_m", "m", "the same by Eq. 1"},
               {"linear_m", "m", "the same by the plant's spring, force/k1"},
               {"elements_m", "m", "the same by finite elements"}});
  for (std::int64_t k = 0; k < forces.count; ++k) {
    throw_if_interrupted();
    const double force = forces.at(k);
    table.row(force, exact.displacement(force), irvine.displacement(force), force / stiffness,
              elements_displacement(cable, force));
  }
  table.commit();
}

}  // namespace

void add_statics(CLI::App& program) {
  const Job job(program, "statics", question::cable,
                "Force and displacement at the absorber, by four models");
  const auto options = std::make_shared<StaticsOptions>();
  job.add_text("--force", options->force,
               "Forces beyond the absorber's weight, MIN:MAX:COUNT, N, downward");
  job->add_option("--elements", options->elements, "Bars of the continuous cable")
      ->check(CLI::Range(4, 20000))
      ->type_name("N")
      ->capture_default_str();
  job->final_callback([job, options] { run(job.context(PlantNeed::none), *options); });
}

}  // namespace holdfast::program
