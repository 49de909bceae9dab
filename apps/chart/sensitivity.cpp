#include "job.hpp"
#include "jobs/design/sensitivity_table.hpp"

namespace holdfast::program {

void add_sensitivity(CLI::App& program) {
  const Job job(program, "sensitivity", question::gains,
                "How the answers move with each parameter: stable gains, best gains, largest "
                "sampling period");
  const auto tuned = std::make_shared<bool>(false);
  job->add_flag(
      "--tuned", *tuned,
      "P follows the absorber's stiffness and mass by Eq. 6 instead of being held, as it does "
      "in a case whose gain is \"tuned\"");
  job->final_callback([job, tuned] { write_sensitivities(job.context(), *tuned); });
}

}  // namespace holdfast::program
