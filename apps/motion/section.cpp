#include <memory>

#include "case/model/loop_of_case.hpp"
#include "case/model/motion_of_case.hpp"
#include "holdfast/motion/instant.hpp"
#include "holdfast/phase_space/section.hpp"
#include "io/text/table.hpp"
#include "job.hpp"
#include "jobs/motion/motion_digits.hpp"
#include "jobs/motion/motion_run.hpp"
#include "motion_options.hpp"
#include "process/errors.hpp"
#include "process/interrupt.hpp"

namespace holdfast::program {
namespace {

struct SectionOptions {
  double duration = 60.0;
  double from = 30.0;
  Switching switching = Switching::sampled;
};

void run(const JobContext& context, const SectionOptions& options) {
  if (options.from > options.duration)
    throw WrongInput("--from lies after --duration: no point is left");
  Table table(context,
              {{"time_s", "s", "instant at which z2 - z1 turns, between the samples"},
               {"z1_m", "m", "displacement of the conductor, positive downward"},
               {"v1_m_per_s", "m/s", "velocity of the conductor, and of the absorber"},
               {"z2_m", "m", "displacement of the absorber, positive downward"},
               {"rising", "", "1: v2 - v1 goes from negative to positive, 0: back", "integer"},
               {"in_backlash", "", "1: the drive is in its backlash, 0: it transmits", "integer"}});
  const std::int64_t before = samples_of(context.case_data, options.from) - 1;
  const std::int64_t samples = samples_of(context.case_data, options.duration) - 1;
  const auto write = [&](const SectionPoint& point) {
    throw_if_interrupted();
    if (!not_before(point.time, options.from)) return;
    table.row(point.time, point.state[0], point.state[1], point.state[2], point.rising ? 1 : 0,
              point.engaged ? 0 : 1);
  };
  auto motion = event_motion(implemented_loop_of(context.case_data, options.switching),
                             initial_state_of(context.case_data));
  run_to_completion(motion, before, {});
  require_completed(run_section(motion, samples - before, write), motion.time());
  require_resolved(motion, context.quiet);
  tell_trust(context, table,
             trusted_digits_of_motion(context.case_data, options.switching, samples, options.from));
  table.commit();
}

}  // namespace

void add_section(CLI::App& program) {
  const Job job(program, "section", question::attractor,
                "Poincaré section of the motion: the instants at which z2 - z1 turns");
  const auto options = std::make_shared<SectionOptions>();
  add_duration(job, options->duration);
  add_from(job, options->from);
  add_switching(job, options->switching);
  job->final_callback([job, options] { run(job.context(), *options); });
}

}  // namespace holdfast::program
