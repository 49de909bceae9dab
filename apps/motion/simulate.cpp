#include "case/axes/axis.hpp"
#include "case/model/motion_of_case.hpp"
#include "holdfast/motion/instant.hpp"
#include "holdfast/motion/trajectory.hpp"
#include "io/text/table.hpp"
#include "job.hpp"
#include "jobs/motion/motion_columns.hpp"
#include "jobs/motion/motion_digits.hpp"
#include "jobs/motion/motion_run.hpp"
#include "motion_options.hpp"
#include "process/errors.hpp"

namespace holdfast::program {
namespace {

struct SimulateOptions {
  double duration = 10.0;
  double from = 0.0;
  std::optional<std::string> kick;
  bool no_control = false;
  Switching switching = Switching::sampled;
};

std::optional<Kick> kick_of(const SimulateOptions& options) {
  if (!options.kick) return std::nullopt;
  const KickOption kick = parse_kick("--kick", *options.kick);
  return Kick{kick.time, kick.displacement};
}

ContactMode mode_of(const EventSample& sample) { return sample.mode; }
ContactMode mode_of(const MotionSample<double>& sample) {
  return sample.engaged ? ContactMode::engaged : ContactMode::gap;
}

void run(const JobContext& context, const SimulateOptions& options) {
  const std::optional<Kick> kick = kick_of(options);
  if (options.from > options.duration)
    throw WrongInput("--from lies after --duration: no row is left");
  if (kick && kick->time > options.duration) throw WrongInput("--kick acts after --duration");
  const std::int64_t samples = samples_of(context.case_data, options.duration);
  Table table(context, motion_columns(options.switching));
  const MotionChoice choice{options.switching, !options.no_control};
  auto digits = digits_beside(context.case_data, choice, kick, options.from);
  with_motion_of(context.case_data, choice, [&](auto motion) {
    run_to_completion(motion, samples, kick, [&](const auto& sample) {
      if (digits) (*digits)(sample);
      if (!not_before(sample.time, options.from)) return;
      write_motion_row(table, options.switching,
                       {sample.time, sample.state, sample.control_force, mode_of(sample)});
    });
    require_resolved(motion, context.quiet);
  });
  if (digits) tell_trust(context, table, digits->result());
  table.commit();
}

}  // namespace

void add_simulate(CLI::App& program) {
  const Job job(program, "simulate", question::motion,
                "Time history of the loop from its initial state");
  const auto options = std::make_shared<SimulateOptions>();
  add_duration(job, options->duration);
  add_from(job, options->from);
  job->add_option("--kick", options->kick,
                  "Displace the conductor once: TIME:DISPLACEMENT, s and m");
  job->add_flag("--no-control", options->no_control, "Without control force");
  add_switching(job, options->switching);
  job->final_callback([job, options] { run(job.context(), *options); });
}

}  // namespace holdfast::program
