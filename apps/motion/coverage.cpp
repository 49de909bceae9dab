#include <algorithm>

#include "case/axes/axis.hpp"
#include "case/model/motion_of_case.hpp"
#include "holdfast/motion/observers.hpp"
#include "holdfast/motion/trajectory.hpp"
#include "holdfast/phase_space/coverage.hpp"
#include "io/text/table.hpp"
#include "job.hpp"
#include "jobs/motion/motion_run.hpp"
#include "motion_options.hpp"
#include "process/errors.hpp"

namespace holdfast::program {
namespace {

struct CoverageOptions {
  std::optional<std::string> window;
  std::string durations = "10,100,1000";
  int cells = 50;
  Switching switching = Switching::sampled;
};

/// Given, or all that the motion sweeps in the second half of the shortest duration.
PhaseWindow window_of(const JobContext& context, const CoverageOptions& options, double duration) {
  if (options.window) {
    const WindowOption given = parse_window("--window", *options.window);
    return {given.displacement.min, given.displacement.max, given.velocity.min, given.velocity.max};
  }
  PhaseExtent extent(duration / 2.0);
  const std::int64_t samples = samples_of(context.case_data, duration);
  with_motion_of(context.case_data, {options.switching},
                 [&](auto motion) { run_to_completion(motion, samples, {}, extent); });
  if (!(extent.displacement() > 0) || !(extent.velocity() > 0)) {
    throw NoAnswer("the motion stands still, so it has no window of its own; give --window");
  }
  return {-extent.displacement(), extent.displacement(), -extent.velocity(), extent.velocity()};
}

std::vector<double> durations_of(const CoverageOptions& options) {
  std::vector<double> durations = parse_list("--durations", options.durations);
  std::sort(durations.begin(), durations.end());
  if (durations.front() <= 0)
    throw WrongInput("--durations " + options.durations + ": every one must be > 0 s");
  return durations;
}

void run(const JobContext& context, const CoverageOptions& options) {
  const std::vector<double> durations = durations_of(options);
  Coverage coverage(window_of(context, options, durations.front()),
                    static_cast<std::size_t>(options.cells));
  Table table(context, {{"duration_s", "s", "length of the motion"},
                        {"cells", "", "cells of the window", "integer"},
                        {"visited", "", "cells that hold a sample of the motion", "integer"},
                        {"fraction", "", "visited over cells"}});
  with_motion_of(context.case_data, {options.switching}, [&](auto motion) {
    for (const double duration : durations) {
      const std::int64_t samples = samples_of(context.case_data, duration);
      run_to_completion(motion, samples - motion.index(), {}, coverage);
      table.row(duration, coverage.cells(), coverage.visited(), coverage.visited_fraction());
    }
    require_resolved(motion, context.quiet);
  });
  table.commit();
}

}  // namespace

void add_coverage(CLI::App& program) {
  const Job job(program, "coverage", question::attractor,
                "How much of a phase-plane window the samples fill as time grows");
  const auto options = std::make_shared<CoverageOptions>();
  job->add_option(
      "--window", options->window,
      "Z1MIN:Z1MAX:V1MIN:V1MAX, m and m/s (default: all that the steady motion sweeps)");
  job.add_text("--durations", options->durations, "Lengths of the motion, s");
  job->add_option("--cells", options->cells, "Cells along each side of the window")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  add_switching(job, options->switching);
  job->final_callback([job, options] { run(job.context(), *options); });
}

}  // namespace holdfast::program
