#include "jobs/attractor/verdict_table.hpp"

#include <memory>

#include "holdfast/orbit/orbit_search.hpp"
#include "job.hpp"
#include "motion_options.hpp"

namespace holdfast::program {
namespace {

struct VerdictOptions {
  std::int64_t largest_period = OrbitLimits{}.largest_period;
  Switching switching = Switching::sampled;
};

}  // namespace

void add_verdict(CLI::App& program) {
  const Job job(program, "verdict", question::attractor,
                "What the motion is: periodic, quasi-periodic, chaotic, …, and what that rests on");
  const auto options = std::make_shared<VerdictOptions>();
  add_largest_period(job, options->largest_period);
  add_switching(job, options->switching);
  job->final_callback([job, options] {
    write_verdict(job.context(), options->largest_period, options->switching);
  });
}

}  // namespace holdfast::program
