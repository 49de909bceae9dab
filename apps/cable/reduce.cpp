#include <optional>

#include "case/model/cable_of_case.hpp"
#include "case/model/reduction_of_case.hpp"
#include "io/text/table.hpp"
#include "job.hpp"
#include "jobs/cable/damping_fit.hpp"
#include "jobs/cable/reduction_table.hpp"
#include "jobs/charts/conditioning.hpp"
#include "jobs/motion/motion_digits.hpp"
#include "process/errors.hpp"
#include "process/exit.hpp"

namespace holdfast::program {
namespace {

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
