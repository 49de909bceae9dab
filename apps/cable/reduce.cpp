#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "case/model/cable_of_case.hpp"
#include "case/model/reduction_of_case.hpp"
#include "io/text/table.hpp"
#include "job.hpp"
#include "jobs/cable/damping_fit.hpp"
#include "jobs/charts/conditioning.hpp"
#include "jobs/motion/motion_digits.hpp"
#include "process/errors.hpp"
#include "process/exit.hpp"

namespace holdfast::program {
namespace {

struct Quantity {
  std::string name;    ///< key of the case file, or what else it is
  std::string symbol;  ///< in the equations; "" without one
  double value;
  std::string unit;  ///< "" without dimension
};

using Rows = std::vector<Quantity>;

void append_plant(Rows& rows, const TwoMass<double>& plant, double absorber_damping) {
  rows.push_back({"conductor_mass", "m1", plant.conductor_mass, "kg"});
  rows.push_back({"conductor_stiffness", "k1", plant.conductor_stiffness, "N/m"});
  rows.push_back({"conductor_damping", "c1", plant.conductor_damping, "N s/m"});
  rows.push_back({"absorber_mass", "m2", plant.absorber_mass, "kg"});
  rows.push_back({"absorber_stiffness", "k2", plant.absorber_stiffness, "N/m"});
  rows.push_back({"absorber_damping", "c2", absorber_damping, "N s/m"});
}

void append_certainty(Rows& rows, const ReductionResult& result) {
  const ReducedMasses &taken = result.solutions[0], &other = result.solutions[1];
  rows.push_back({"discriminant", "", result.discriminant, ""});
  rows.push_back({"conductor_mass_condition", "", taken.mass_condition, ""});
  rows.push_back({"absorber_stiffness_condition", "", taken.stiffness_condition, ""});
  rows.push_back({"conductor_damping_condition", "", taken.damping_condition, ""});
  rows.push_back({"conductor_mass_other_root", "m1", other.conductor_mass, "kg"});
  rows.push_back({"absorber_stiffness_other_root", "k2", other.absorber_stiffness, "N/m"});
  rows.push_back({"largest_absorber_mass", "m2", result.largest_absorber_mass, "kg"});
  rows.push_back(
      {"smallest_conductor_stiffness", "k1", result.smallest_conductor_stiffness, "N/m"});
}

void append_damping(Rows& rows, const std::optional<AbsorberDampingFit>& damping) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const auto* best = damping ? &damping->fit.minima.front() : nullptr;
  const bool second = damping && damping->fit.minima.size() > 1;
  rows.push_back({"absorber_damping_standard_error", "c2",
                  best != nullptr ? best->standard_errors.front() : none, "N s/m"});
  rows.push_back({"absorber_damping_misfit_peak", "", damping ? damping->peak_misfit : none, ""});
  rows.push_back(
      {"absorber_damping_misfit_history", "", damping ? damping->history_misfit : none, ""});
  rows.push_back({"absorber_damping_lowest", "c2", damping ? damping->lowest : none, "N s/m"});
  rows.push_back({"absorber_damping_highest", "c2", damping ? damping->highest : none, "N s/m"});
  rows.push_back({"absorber_damping_second_minimum", "c2",
                  second ? damping->fit.minima[1].plant.absorber_damping : none, "N s/m"});
}

void append_readings(Rows& rows, const Case& the_case) {
  const auto irvine = irvine_statics_of(the_case);
  const auto exact = exact_statics_of(the_case);
  const ReadingRange range = reading_range_of(the_case);
  const bool readable = range.below + range.above > 0.0;
  if (readable) require_reading_range(the_case);
  const auto append = [&](const std::string& name, StiffnessReading reading) {
    if (reading != StiffnessReading::tangent && !readable) return;
    const std::string quantity = "conductor_stiffness_" + name;
    rows.push_back({quantity, "k1", conductor_stiffness(irvine, reading, range), "N/m"});
    rows.push_back({quantity + "_exact", "k1", conductor_stiffness(exact, reading, range), "N/m"});
  };
  append("tangent", StiffnessReading::tangent);
  append("secant", StiffnessReading::secant);
  append("least_squares", StiffnessReading::least_squares);
}

void append_cable(Rows& rows, const Case& the_case) {
  const Conductor<double> conductor = conductor_of(the_case);
  const auto exact = exact_statics_of(the_case);
  const auto& cable = exact.model().cable();
  rows.push_back({"horizontal_tension", "H", conductor.parabolic_tension(), "N"});
  rows.push_back({"horizontal_tension_exact", "H", cable.bare_tension(), "N"});
  rows.push_back({"horizontal_tension_with_absorber", "H", exact.tension(0.0), "N"});
  rows.push_back({"drop_under_absorber", "w", exact.resting_displacement(), "m"});
  rows.push_back({"irvine_parameter", "lambda^2", conductor.irvine_parameter(), ""});
  rows.push_back({"unstretched_length", "l0", cable.unstretched_length(), "m"});
  rows.push_back({"first_frequency", "f1", the_case.reduction.first_frequency, "Hz"});
  rows.push_back({"second_frequency", "f2", the_case.reduction.second_frequency, "Hz"});
}

/// Without a fit what belongs to c2 is NaN.
Rows reduction_table(const Case& the_case, const std::optional<AbsorberDampingFit>& damping) {
  Rows rows;
  append_plant(rows, plant_without_absorber_damping(the_case),
               damping ? damping->fit.minima.front().plant.absorber_damping
                       : std::numeric_limits<double>::quiet_NaN());
  append_certainty(rows, reduction_of(the_case));
  append_damping(rows, damping);
  append_readings(rows, the_case);
  append_cable(rows, the_case);
  return rows;
}

/// None, with a line on standard error, where the fit needs a package that is missing or the decay
/// does not determine c2.
std::optional<AbsorberDampingFit> fitted_damping(const JobContext& context) {
  const TwoMass<double> plant = plant_without_absorber_damping(context.case_data);
  try {
    AbsorberDampingFit found = fit_absorber_damping(context.case_data, plant);
    report_warning(misfit_warning(found), context.quiet);
    return found;
  } catch (const NoAnswer& reason) {
    report_error(std::string("absorber_damping is left open: ") + reason.what());
    return std::nullopt;
  }
}

void tell_reduction(const JobContext& context) {
  report_warning(borrowed_cable_warning(context.case_data), context.quiet);
  report_warning(deep_cable_warning(context.case_data), context.quiet);
  report_warning(sensitive_reduction_warning(context.case_data), context.quiet);
  Table table(context, {{"quantity", "", "key of the case file, or what else it is", "string"},
                        {"symbol", "", "in the equations", "string"},
                        {"value", "", "in the unit beside it"},
                        {"unit", "", "SI", "string"}});
  for (const Quantity& row : reduction_table(context.case_data, fitted_damping(context)))
    table.row(row.name, row.symbol, row.value, row.unit);
  tell_trust(context, table, trusted_digits_of_reduction(reduction_options_of(context.case_data)));
  table.commit();
}

}  // namespace

void add_reduce(CLI::App& program) {
  const Job job(
      program, "reduce", question::cable,
      "The six parameters of the plant from conductor and absorber, and how sure each is");
  job->final_callback([job] { tell_reduction(job.context(PlantNeed::none)); });
}

}  // namespace holdfast::program
