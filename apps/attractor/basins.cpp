#include <memory>

#include "job.hpp"
#include "jobs/attractor/basin_tables.hpp"
#include "motion_options.hpp"

namespace holdfast::program {

void add_basins(CLI::App& program) {
  const Job job(program, "basins", question::attractor,
                "Which attractor each initial state of a grid comes to");
  const auto options = std::make_shared<BasinOptions>();
  job->add_option("--axis", options->axes,
                  "KEY=MIN:MAX:COUNT, twice, of initial.z1, initial.v1, initial.z2, initial.v2")
      ->expected(1)
      ->take_all();
  add_largest_period(job, options->largest_period);
  job->add_flag("--fractions", options->fractions,
                "A row for each attractor instead: its share of the states, with its error");
  add_switching(job, options->switching);
  job.computes_on_packs();
  job->final_callback([job, options] { write_basins(job.context(), *options); });
}

}  // namespace holdfast::program
