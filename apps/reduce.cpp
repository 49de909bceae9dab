#include <cmath>
#include <limits>

#include "cable_of_case.hpp"
#include "damping_fit.hpp"
#include "errors.hpp"
#include "exit.hpp"
#include "holdfast/cable/modes.hpp"
#include "job.hpp"
#include "table.hpp"

namespace holdfast::program {
namespace {

/// c2 with how sure it is; NaN with a line on standard error where the fit needs a package that is
/// missing, or the decay does not determine it.
struct AbsorberDamping {
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();
  double value = none, standard_error = none, misfit = none;
  double lowest = none, highest = none, second_minimum = none;
};

AbsorberDamping fitted_damping(const JobContext& context, const TwoDof<double>& plant) {
  AbsorberDamping damping;
  try {
    const AbsorberDampingFit found = fit_absorber_damping(context.case_data, plant);
    const auto& minima = found.fit.minima;
    damping = {minima[0].plant.absorber_damping,
               minima[0].standard_errors[0],
               found.misfit,
               found.lowest,
               found.highest,
               AbsorberDamping::none};
    if (minima.size() > 1) damping.second_minimum = minima[1].plant.absorber_damping;
    report_warning(misfit_warning(found), context.quiet);
  } catch (const NoAnswer& reason) {
    report_error(std::string("absorber_damping is left open: ") + reason.what());
  }
  return damping;
}

void write_plant(Table& table, const TwoDof<double>& plant, const AbsorberDamping& damping) {
  table.row("conductor_mass", "m1", plant.conductor_mass, "kg");
  table.row("conductor_stiffness", "k1", plant.conductor_stiffness, "N/m");
  table.row("conductor_damping", "c1", plant.conductor_damping, "N s/m");
  table.row("absorber_mass", "m2", plant.absorber_mass, "kg");
  table.row("absorber_stiffness", "k2", plant.absorber_stiffness, "N/m");
  table.row("absorber_damping", "c2", damping.value, "N s/m");
}

void write_readings(Table& table, const Case& the_case) {
  const auto irvine = irvine_statics_of(the_case);
  const auto exact = exact_statics_of(the_case);
  const ReadingRange range = reading_range_of(the_case);
  const bool readable = range.below + range.above > 0.0;
  if (readable) require_reading_range(the_case);
  const auto row = [&](const std::string& name, StiffnessReading reading) {
    if (reading != StiffnessReading::tangent && !readable) return;
    table.row("conductor_stiffness_" + name, "k1", conductor_stiffness(irvine, reading, range),
              "N/m");
    table.row("conductor_stiffness_" + name + "_exact", "k1",
              conductor_stiffness(exact, reading, range), "N/m");
  };
  row("tangent", StiffnessReading::tangent);
  row("secant", StiffnessReading::secant);
  row("least_squares", StiffnessReading::least_squares);
}

void write_certainty(Table& table, const ReductionResult& result, const AbsorberDamping& damping) {
  table.row("discriminant", "", result.discriminant, "");
  table.row("conductor_mass_condition", "", result.solutions[0].mass_condition, "");
  table.row("absorber_stiffness_condition", "", result.solutions[0].stiffness_condition, "");
  table.row("conductor_damping_condition", "", result.solutions[0].damping_condition, "");
  table.row("conductor_mass_other_root", "m1", result.solutions[1].conductor_mass, "kg");
  table.row("absorber_stiffness_other_root", "k2", result.solutions[1].absorber_stiffness, "N/m");
  table.row("largest_absorber_mass", "m2", result.largest_absorber_mass, "kg");
  table.row("smallest_conductor_stiffness", "k1", result.smallest_conductor_stiffness, "N/m");
  table.row("absorber_damping_standard_error", "c2", damping.standard_error, "N s/m");
  table.row("absorber_damping_misfit", "", damping.misfit, "");
  table.row("absorber_damping_lowest", "c2", damping.lowest, "N s/m");
  table.row("absorber_damping_highest", "c2", damping.highest, "N s/m");
  table.row("absorber_damping_second_minimum", "c2", damping.second_minimum, "N s/m");
}

void write_cable(Table& table, const Case& the_case) {
  const Conductor<double> conductor = conductor_of(the_case);
  const auto exact = exact_statics_of(the_case);
  table.row("horizontal_tension", "H", conductor.parabolic_tension(), "N");
  table.row("horizontal_tension_exact", "H", exact.model().cable().bare_tension(), "N");
  table.row("horizontal_tension_with_absorber", "H", exact.tension(0.0), "N");
  table.row("drop_under_absorber", "w", exact.resting_displacement(), "m");
  table.row("irvine_parameter", "lambda^2", conductor.irvine_parameter(), "");
  table.row("unstretched_length", "l0", exact.model().cable().unstretched_length(), "m");
  table.row("first_frequency", "f1", the_case.reduction.first_frequency, "Hz");
  table.row("second_frequency", "f2", the_case.reduction.second_frequency, "Hz");
}

void run(const JobContext& context) {
  const Case& the_case = context.case_data;
  const TwoDof<double> plant = plant_without_absorber_damping(the_case);
  Table table(context, {{"quantity", "", "key of the case file, or what else it is", "string"},
                        {"symbol", "", "in the equations", "string"},
                        {"value", "", "in the unit beside it"},
                        {"unit", "", "SI", "string"}});
  const AbsorberDamping damping = fitted_damping(context, plant);
  write_plant(table, plant, damping);
  write_certainty(table, reduction_of(the_case), damping);
  write_readings(table, the_case);
  write_cable(table, the_case);
  table.commit();
}

}  // namespace

void add_reduce(CLI::App& program) {
  const Job job(
      program, "reduce", question::cable,
      "The six parameters of the plant from conductor and absorber, and how sure each is");
  job->final_callback([job] { run(job.context(PlantNeed::none)); });
}

}  // namespace holdfast::program
