#include <cmath>

#include "case/case_keys.hpp"
#include "case/model/plant_of_case.hpp"
#include "job.hpp"
#include "jobs/design/case_sensitivity.hpp"

namespace holdfast::program {
namespace {

/// One row for every answer and parameter, ∂answer/∂parameter and ∂ ln|answer|/∂ ln|parameter|.
/// Answers that the case does not have (no stable gain, no largest period) have no rows.
struct SensitivityQuestion {
  bool tuned = false;

  void add_to(const Job& job) { job.add("--tuned", tuned); }

  void run(const JobContext& context) const {
    const Case& the_case = context.case_data;
    const bool follows = tuned || the_case.control.proportional_gain_tuned;
    Table table(context, columns_of("sensitivity"));
    for (const CaseSensitivity& answer : case_sensitivities(the_case, follows)) {
      if (!std::isfinite(answer.value)) continue;
      for (const auto& [key, derivative] : answer.keys)
        table.row(answer.name, answer.value, answer.unit, key, find_case_key(key)->unit, derivative,
                  derivative * case_value(the_case, key) / answer.value);
    }
    table.require_numbers();
    table.commit();
  }
};

}  // namespace

void add_sensitivity(CLI::App& program) { add_job<SensitivityQuestion>(program, "sensitivity"); }

}  // namespace holdfast::program
