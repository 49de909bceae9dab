#include <memory>
#include <optional>

#include "case/model/loop_of_case.hpp"
#include "job.hpp"
#include "jobs/orbit/event_orbit_tables.hpp"
#include "jobs/orbit/orbit_tables.hpp"
#include "motion_options.hpp"
#include "process/errors.hpp"

namespace holdfast::program {
namespace {

struct OrbitOptions {
  std::int64_t largest_period = OrbitLimits{}.largest_period;
  bool trace = false;
  bool certificate = false;
  std::optional<std::string> follow;
  Switching switching = Switching::sampled;
};

void write_built(const JobContext& context, const OrbitOptions& options) {
  const ImplementedLoop loop = implemented_loop_of(context.case_data, options.switching);
  if (options.follow) {
    throw WrongInput(
        "--follow goes with --switching sampled, the paper's backlash, one harmonic and an ideal "
        "computer only");
  }
  if (options.trace) {
    write_orbit_trace(context, loop, options.largest_period);
  } else if (options.certificate) {
    write_certificate(context, loop, options.largest_period);
  } else {
    write_orbit(context, loop, options.largest_period);
  }
}

void run(const JobContext& context, const OrbitOptions& options) {
  if (!is_of_the_paper(context.case_data, options.switching)) {
    write_built(context, options);
    return;
  }
  if (options.trace) {
    write_orbit_trace(context, options.largest_period);
  } else if (options.certificate) {
    write_certificate(context, options.largest_period);
  } else if (options.follow) {
    write_branch_ends(context, options.largest_period, *options.follow);
  } else {
    write_orbit(context, options.largest_period);
  }
}

}  // namespace

void add_orbit(CLI::App& program) {
  const Job job(program, "orbit", question::attractor,
                "The exact periodic orbit that the motion comes to, with its certificate");
  const auto options = std::make_shared<OrbitOptions>();
  add_largest_period(job, options->largest_period);
  CLI::Option* trace =
      job->add_flag("--trace", options->trace, "Its samples over one period, as simulate's");
  CLI::Option* certificate =
      job->add_flag("--certificate", options->certificate,
                    "All of its certificate: multipliers, distances to the switching surfaces, "
                    "radius of capture, the same orbit in extended precision")
          ->excludes(trace);
  job->add_option("--follow", options->follow,
                  "KEY=MIN:MAX: where the orbit ends along one key of the case, and why")
      ->excludes(trace)
      ->excludes(certificate);
  add_switching(job, options->switching);
  job->final_callback([job, options] { run(job.context(), *options); });
}

}  // namespace holdfast::program
