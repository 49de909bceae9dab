#include <limits>

#include "case/model/cable_of_case.hpp"
#include "case/model/conditioning.hpp"
#include "case/model/decay/damping_fit.hpp"
#include "case/model/resolved_plant.hpp"
#include "job.hpp"
#include "jobs/motion/motion_digits.hpp"

namespace holdfast::program {
namespace {

/// Value of the quantities that depend on c2 where no fit was made.
constexpr double none = std::numeric_limits<double>::quiet_NaN();

void append_plant(Table& table, const TwoMass<double>& plant, double absorber_damping) {
  table.row("conductor_mass", "m1", plant.conductor_mass, "kg");
  table.row("conductor_stiffness", "k1", plant.conductor_stiffness, "N/m");
  table.row("conductor_damping", "c1", plant.conductor_damping, "N s/m");
  table.row("absorber_mass", "m2", plant.absorber_mass, "kg");
  table.row("absorber_stiffness", "k2", plant.absorber_stiffness, "N/m");
  table.row("absorber_damping", "c2", absorber_damping, "N s/m");
}

void append_certainty(Table& table, const ReductionResult& result) {
  const ReducedMasses &taken = result.solutions[0], &other = result.solutions[1];
  table.row("discriminant", "", result.discriminant, "");
  table.row("conductor_mass_condition", "", taken.mass_condition, "");
  table.row("absorber_stiffness_condition", "", taken.stiffness_condition, "");
  table.row("conductor_damping_condition", "", taken.damping_condition, "");
  table.row("conductor_mass_other_root", "m1", other.conductor_mass, "kg");
  table.row("absorber_stiffness_other_root", "k2", other.absorber_stiffness, "N/m");
  table.row("largest_absorber_mass", "m2", result.largest_absorber_mass, "kg");
  table.row("smallest_conductor_stiffness", "k1", result.smallest_conductor_stiffness, "N/m");
}

void append_damping(Table& table, const std::optional<AbsorberDampingFit>& damping) {
  const auto* best = damping ? &damping->fit.minima.front() : nullptr;
  const bool second = damping && damping->fit.minima.size() > 1;
  table.row("absorber_damping_standard_error", "c2",
            best != nullptr ? best->standard_errors.front() : none, "N s/m");
  table.row("absorber_damping_misfit_peak", "", damping ? damping->peak_misfit : none, "");
  table.row("absorber_damping_misfit_history", "", damping ? damping->history_misfit : none, "");
  table.row("absorber_damping_lowest", "c2", damping ? damping->lowest : none, "N s/m");
  table.row("absorber_damping_highest", "c2", damping ? damping->highest : none, "N s/m");
  table.row("absorber_damping_second_minimum", "c2",
            second ? damping->fit.minima[1].plant.absorber_damping : none, "N s/m");
}

void append_readings(Table& table, const Case& the_case) {
  const auto irvine = irvine_statics_of(the_case);
  const auto exact = exact_statics_of(the_case);
  const ReadingRange range = reading_range_of(the_case);
  const bool readable = range.below + range.above > 0.0;
  if (readable) require_reading_range(the_case);
  const auto append = [&](const std::string& name, StiffnessReading reading) {
    if (reading != StiffnessReading::tangent && !readable) return;
    const std::string quantity = "conductor_stiffness_" + name;
    table.row(quantity, "k1", conductor_stiffness(irvine, reading, range), "N/m");
    table.row(quantity + "_exact", "k1", conductor_stiffness(exact, reading, range), "N/m");
  };
  append("tangent", StiffnessReading::tangent);
  append("secant", StiffnessReading::secant);
  append("least_squares", StiffnessReading::least_squares);
}

void append_cable(Table& table, const Case& the_case) {
  const Conductor<double> conductor = conductor_of(the_case);
  const auto exact = exact_statics_of(the_case);
  const auto& cable = exact.model().cable();
  table.row("horizontal_tension", "H", conductor.parabolic_tension(), "N");
  table.row("horizontal_tension_exact", "H", cable.bare_tension(), "N");
  table.row("horizontal_tension_with_absorber", "H", exact.tension(0.0), "N");
  table.row("drop_under_absorber", "w", exact.resting_displacement(), "m");
  table.row("irvine_parameter", "lambda^2", conductor.irvine_parameter(), "");
  table.row("unstretched_length", "l0", cable.unstretched_length(), "m");
  table.row("first_frequency", "f1", the_case.reduction.first_frequency, "Hz");
  table.row("second_frequency", "f2", the_case.reduction.second_frequency, "Hz");
}

/// Fitted c2; nullopt, with a message on standard error, where a package is missing or the decay
/// does not determine c2.
std::optional<AbsorberDampingFit> fitted_damping(const JobContext& context) {
  const TwoMass<double> plant = plant_without_absorber_damping(context.case_data);
  try {
    AbsorberDampingFit found = fit_absorber_damping(context.case_data, plant);
    report_warning(misfit_warning(found), context.quiet);
    return found;
  } catch (const NoAnswer& reason) {
    report_error(std::string("absorber_damping is not computed: ") + reason.what());
    return std::nullopt;
  }
}

void tell_reduction(const JobContext& context) {
  report_warning(borrowed_cable_warning(context.case_data), context.quiet);
  report_warning(sensitive_reduction_warning(context.case_data), context.quiet);
  Table table(context, columns_of("reduce"));
  const Case& the_case = context.case_data;
  const auto damping = fitted_damping(context);
  append_plant(table, plant_without_absorber_damping(the_case),
               damping ? damping->fit.minima.front().plant.absorber_damping : none);
  append_certainty(table, reduction_of(the_case));
  append_damping(table, damping);
  append_readings(table, the_case);
  append_cable(table, the_case);
  tell_trust(context, table, trusted_digits_of_reduction(reduction_options_of(context.case_data)));
  table.commit();
}

}  // namespace

void add_reduce(CLI::App& program) { add_job(program, "reduce", tell_reduction); }

}  // namespace holdfast::program
