#include <memory>

#include "job.hpp"
#include "jobs/attractor/basin_tables.hpp"
#include "motion_options.hpp"

namespace holdfast::program {
namespace {

struct BasinsOptions {
  BasinOptions question{{}, 100'000};
};

}  // namespace

void add_basins(CLI::App& program) {
  const Job job(program, "basins", question::attractor,
                "Which attractor each initial state of a grid comes to");
  const auto options = std::make_shared<BasinsOptions>();
  job->add_option("--axis", options->question.axes,
                  "KEY=MIN:MAX:COUNT, twice, of initial.z1, initial.v1, initial.z2, initial.v2")
      ->expected(1)
      ->take_all();
  add_largest_period(job, options->question.largest_period);
  job->add_flag("--fractions", options->question.fractions,
                "A row for each attractor instead: its share of the states, with its error");
  add_switching(job, options->question.switching);
  job.computes_on_packs();
  job->final_callback([job, options] { write_basins(job.context(), options->question); });
}

}  // namespace holdfast::program
