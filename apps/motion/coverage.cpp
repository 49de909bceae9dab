#include <algorithm>

#include "case/axes/axis.hpp"
#include "holdfast/motion/observers.hpp"
#include "holdfast/phase_space/coverage.hpp"
#include "job.hpp"
#include "jobs/motion/case_motion.hpp"
#include "jobs/motion/motion_digits.hpp"
#include "jobs/motion/motion_run.hpp"

namespace holdfast::program {
namespace {

struct CoverageQuestion {
  std::optional<std::string> window;
  std::string durations = "10,100,1000";
  int cells = 50;
  Switching switching = Switching::sampled;

  void add_to(const Job& job) {
    job.add("--window", window);
    job.add("--durations", durations);
    job.add("--cells", cells);
    job.add("--switching", switching);
  }
  void run(const JobContext& context) const;
};

/// Window as given, or the extent of the motion in the second half of the shortest duration.
PhaseWindow window_of(const JobContext& context, const CoverageQuestion& options, double duration) {
  if (options.window) {
    const WindowOption given = parse_window("--window", *options.window);
    return {given.displacement.min, given.displacement.max, given.velocity.min, given.velocity.max};
  }
  PhaseExtent extent(duration / 2.0);
  const std::int64_t samples = samples_of(context.case_data, duration);
  CaseMotion motion(context.case_data, {options.switching});
  run_to_completion(motion, samples, {}, extent);
  if (!(extent.displacement() > 0) || !(extent.velocity() > 0)) {
    throw NoAnswer("the motion stays at rest, so there is no default window: give --window");
  }
  return {-extent.displacement(), extent.displacement(), -extent.velocity(), extent.velocity()};
}

std::vector<double> durations_of(const CoverageQuestion& options) {
  std::vector<double> durations = parse_list("--durations", options.durations);
  std::sort(durations.begin(), durations.end());
  if (durations.front() <= 0)
    throw WrongInput("--durations " + options.durations + ": every duration must be above 0 s");
  return durations;
}

void CoverageQuestion::run(const JobContext& context) const {
  const std::vector<double> ascending = durations_of(*this);
  Coverage coverage(window_of(context, *this, ascending.front()), static_cast<std::size_t>(cells));
  Table table(context, columns_of("coverage"));
  const MovingLoop moving = moving_loop_of(context.case_data, {switching});
  auto digits = digits_beside(moving, {}, 0.0);
  CaseMotion motion(moving);
  for (const double duration : ascending) {
    const std::int64_t samples = samples_of(context.case_data, duration);
    run_to_completion(motion, samples - motion.index(), {}, coverage,
                      [&digits](const EventSample& sample) {
                        if (digits) (*digits)(sample);
                      });
    table.row(duration, coverage.cells(), coverage.visited(), coverage.visited_fraction());
  }
  tell_of_end(context, end_of(motion));
  if (digits) tell_trust(context, table, digits->result());
  table.commit();
}

}  // namespace

void add_coverage(CLI::App& program) { add_job<CoverageQuestion>(program, "coverage"); }

}  // namespace holdfast::program
