#include <memory>
#include <string>

#include "case/model/loop_of_case.hpp"
#include "case/model/motion_of_case.hpp"
#include "holdfast/chaos/event_lyapunov.hpp"
#include "holdfast/chaos/lyapunov_run.hpp"
#include "holdfast/motion/implemented_loop.hpp"
#include "io/text/table.hpp"
#include "job.hpp"
#include "jobs/charts/conditioning.hpp"
#include "jobs/motion/motion_run.hpp"
#include "motion_options.hpp"
#include "process/errors.hpp"
#include "process/exit.hpp"
#include "process/interrupt.hpp"

namespace holdfast::program {
namespace {

struct LyapunovOptions {
  double duration = 100.0;             ///< s, the longest
  double discard = 0.0;                ///< s, left out at the start
  double standard_error = 0.0;         ///< per sample, at which to stop; 0: go on to the end
  std::string tangent = "consistent";  ///< or "printed"
  bool largest = false;                ///< the largest exponent alone
  bool history = false;                ///< the exponents after every sample instead
  Switching switching = Switching::sampled;
};

/// The loop whose S and S* are the tangents: that of the motion, or the printed one with δ = τ.
SampledLoop<double> tangent_loop_of(const Case& the_case, const LyapunovOptions& options) {
  Sampling<double> sampling = sampling_of(the_case);
  if (options.tangent == "printed") sampling.processing_delay = sampling.period;
  return sampled_loop(plant_of(the_case), sampling);
}

std::int64_t steps_of(const JobContext& context, const LyapunovOptions& options) {
  const std::int64_t steps = samples_of(context.case_data, options.duration) - 1;
  if (steps < 1) throw WrongInput("--duration is shorter than one sampling period");
  return steps;
}

/// Along the motion's itinerary, whose tangents are those of the options.
LyapunovResult exponents_of(const SampledMotion<double>& sampled, const JobContext& context,
                            const LyapunovOptions& options, const LyapunovRun& run) {
  InterruptibleMotion motion(sampled);
  const auto blocks = std::make_shared<const ItineraryBlocks>(
      tangent_loop_of(context.case_data, options), gains_of(context.case_data));
  const LyapunovResult result = run_lyapunov(motion, blocks, run);
  if (result.outcome == LyapunovOutcome::diverged) refuse_diverging(motion.time());
  return result;
}

/// Of any loop, with the saltation at its switches.
template <class Contact>
LyapunovResult exponents_of(EventMotion<Contact> motion, const JobContext& context,
                            const LyapunovOptions&, const LyapunovRun& run) {
  const LyapunovResult result = run_event_lyapunov(motion, run, throw_if_interrupted);
  if (result.outcome == LyapunovOutcome::diverged) refuse_diverging(motion.time());
  require_resolved(motion, context.quiet);
  return result;
}

void require_consistent(const Case& the_case, const LyapunovOptions& options) {
  if (options.tangent != "printed" || is_of_the_paper(the_case, options.switching)) return;
  throw WrongInput(
      "--tangent printed goes with --switching sampled, the paper's backlash, one harmonic and an "
      "ideal computer only");
}

/// A row of the exponents so far.
void write_history_row(Table& table, double time, const Vector<double, 5>& exponents) {
  table.writer().cell(time);
  for (const double exponent : exponents) table.writer().cell(exponent);
  table.writer().end_row();
}

void write_history(SampledMotion<double> motion, const JobContext& context,
                   const LyapunovOptions& options, std::int64_t steps, Table& table) {
  const double period = context.case_data.control.sampling_period;
  LyapunovObserver observer(tangent_loop_of(context.case_data, options),
                            gains_of(context.case_data));
  run_to_completion(motion, steps, {}, observer, [&](const MotionSample<double>& sample) {
    write_history_row(table, sample.time + period, observer.spectrum().exponents());
  });
}

template <class Contact>
void write_history(EventMotion<Contact> motion, const JobContext& context, const LyapunovOptions&,
                   std::int64_t steps, Table& table) {
  EventLyapunov lyapunov(motion);
  for (std::int64_t step = 0; step < steps; ++step) {
    look_for_interrupt(step);
    run_to_completion(lyapunov, 1, {});
    write_history_row(table, motion.time(), lyapunov.spectrum().exponents().template head<5>());
  }
  require_resolved(motion, context.quiet);
}

/// One row for each exponent: per sample, per second, standard error.
void write_exponents(const JobContext& context, const LyapunovOptions& options) {
  const double period = context.case_data.control.sampling_period;
  const std::int64_t steps = steps_of(context, options);
  const std::int64_t discard = samples_within(options.discard, period) - 1;
  if (discard >= steps) throw WrongInput("--discard leaves nothing of --duration");
  require_consistent(context.case_data, options);
  Table table(
      context,
      {{"exponent", "", "number of the exponent, in the order of the QR; descending once converged",
        "integer"},
       {"per_sample", "", "natural logarithm per sample; -inf where a direction is annihilated"},
       {"per_second", "1/s", "per sample over the sampling period"},
       {"standard_error", "", "of per_sample, by batch means"}});
  const auto scope = options.largest ? LyapunovScope::largest : LyapunovScope::all;
  const LyapunovRun run{steps - discard, discard, options.standard_error, scope,
                        LyapunovScope::largest};
  const LyapunovResult result = with_motion_of(
      context.case_data, {options.switching},
      [&](const auto& motion) { return exponents_of(motion, context, options, run); });
  if (options.standard_error > 0.0 && result.outcome == LyapunovOutcome::sample_limit)
    report_warning("--standard-error was not reached within --duration", context.quiet);
  report_warning(open_sign_warning(result), context.quiet);
  for (int i = 0; i < (options.largest ? 1 : 5); ++i)
    table.row(i + 1, result.exponents[i], result.exponents[i] / period, result.standard_errors[i]);
  table.commit();
}

/// The exponents after every sample.
void write_exponent_history(const JobContext& context, const LyapunovOptions& options) {
  std::vector<Column> columns = {{"time_s", "s", "end of the averaged motion"}};
  for (int i = 1; i <= 5; ++i)
    columns.push_back({"lambda" + std::to_string(i), "", "exponent per sample up to this time"});
  const std::int64_t steps = steps_of(context, options);
  require_consistent(context.case_data, options);
  Table table(context, columns);
  with_motion_of(context.case_data, {options.switching}, [&](const auto& motion) {
    write_history(motion, context, options, steps, table);
  });
  table.commit();
}

}  // namespace

void add_lyapunov(CLI::App& program) {
  const Job job(program, "lyapunov", question::attractor,
                "The five Lyapunov exponents of the motion");
  const auto options = std::make_shared<LyapunovOptions>();
  add_duration(job, options->duration);
  CLI::Option* discard =
      job.add_number("--discard", options->discard, "Left out at the start, s", 0.0, 1e12);
  CLI::Option* error = job.add_number(
      "--standard-error", options->standard_error,
      "Stop once the largest exponent per sample is known to this; 0: at --duration", 0.0, 1e12);
  job->add_option("--tangent", options->tangent,
                  "consistent: of the motion itself; printed: S and S* with delay tau, as the "
                  "paper's Table 2")
      ->check(CLI::IsMember({"consistent", "printed"}))
      ->capture_default_str();
  CLI::Option* largest =
      job->add_flag("--largest", options->largest, "The largest exponent alone, at less cost");
  job->add_flag("--history", options->history, "Write the exponents after every sample")
      ->excludes(discard)
      ->excludes(error)
      ->excludes(largest);
  add_switching(job, options->switching);
  job->final_callback([job, options] {
    options->history ? write_exponent_history(job.context(), *options)
                     : write_exponents(job.context(), *options);
  });
}

}  // namespace holdfast::program
