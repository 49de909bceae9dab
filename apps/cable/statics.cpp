#include "case/axes/axis.hpp"
#include "case/model/cable_of_case.hpp"
#include "case/model/decay/cable_decay.hpp"
#include "job.hpp"

namespace holdfast::program {
namespace {

/// Displacement of the absorber's node by the finite elements.
double elements_displacement(const CableElements& cable, double force) {
  const auto held = cable.held_by(force);
  if (held.outcome != EquilibriumOutcome::converged)
    throw NoAnswer("no static equilibrium of the cable was found under " + format_number(force) +
                   " N: give a smaller force");
  return cable.displacement(held.state);
}

struct StaticsQuestion {
  std::string force = "-1:1:41";
  int elements = 100;

  void add_to(const Job& job) {
    job.add("--force", force);
    job.add("--elements", elements);
  }

  void run(const JobContext& context) const {
    const Case& the_case = context.case_data;
    report_warning(borrowed_cable_warning(the_case), context.quiet);
    const Axis forces = parse_axis("--force", force);
    for (const double end : {forces.at(0), forces.at(forces.count - 1)})
      require_force_within_statics(the_case, end);
    const auto irvine = irvine_statics_of(the_case);
    const auto exact = exact_statics_of(the_case);
    const CableElements cable = elements_of(the_case, elements, AbsorberReading::weight);
    const double stiffness = plant_is_reduced(the_case) ? conductor_stiffness_of(the_case)
                                                        : the_case.plant.conductor_stiffness;
    Table table(context, columns_of("statics"));
    for (std::int64_t k = 0; k < forces.count; ++k) {
      throw_if_interrupted();
      const double f = forces.at(k);
      table.row(f, exact.displacement(f), irvine.displacement(f), f / stiffness,
                elements_displacement(cable, f));
    }
    table.commit();
  }
};

}  // namespace

void add_statics(CLI::App& program) { add_job<StaticsQuestion>(program, "statics"); }

}  // namespace holdfast::program
