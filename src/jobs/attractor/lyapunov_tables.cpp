#include "jobs/attractor/lyapunov_tables.hpp"

#include <memory>

#include "case/model/loop_of_case.hpp"
#include "case/model/motion_of_case.hpp"
#include "holdfast/chaos/event_lyapunov.hpp"
#include "holdfast/chaos/lyapunov_run.hpp"
#include "holdfast/motion/implemented_loop.hpp"
#include "io/text/table.hpp"
#include "jobs/charts/conditioning.hpp"
#include "jobs/motion/motion_run.hpp"
#include "process/errors.hpp"
#include "process/exit.hpp"
#include "process/interrupt.hpp"

namespace holdfast::program {
namespace {

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

/// Of the paper's model.
LyapunovResult sampled_exponents(const JobContext& context, const LyapunovOptions& options,
                                 const LyapunovRun& run) {
  InterruptibleMotion motion(motion_of(context.case_data));
  const auto blocks = std::make_shared<const ItineraryBlocks>(
      tangent_loop_of(context.case_data, options), gains_of(context.case_data));
  const LyapunovResult result = run_lyapunov(motion, blocks, run);
  if (result.outcome == LyapunovOutcome::diverged) refuse_diverging(motion.time());
  return result;
}

/// Of any loop, with the saltation at its switches.
LyapunovResult built_exponents(const JobContext& context, const LyapunovOptions& options,
                               const LyapunovRun& run) {
  const ImplementedLoop loop = implemented_loop_of(context.case_data, options.switching);
  return with_motion(loop, initial_state_of(context.case_data), [&](auto motion) {
    const LyapunovResult result = run_event_lyapunov(motion, run, throw_if_interrupted);
    if (result.outcome == LyapunovOutcome::diverged) refuse_diverging(motion.time());
    require_resolved(motion, context.quiet);
    return result;
  });
}

void require_consistent(const LyapunovOptions& options) {
  if (options.tangent != "printed") return;
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

void write_sampled_history(const JobContext& context, const LyapunovOptions& options,
                           std::int64_t steps, Table& table) {
  const double period = context.case_data.control.sampling_period;
  LyapunovObserver observer(tangent_loop_of(context.case_data, options),
                            gains_of(context.case_data));
  auto motion = motion_of(context.case_data);
  run_to_completion(motion, steps, {}, observer, [&](const MotionSample<double>& sample) {
    write_history_row(table, sample.time + period, observer.spectrum().exponents());
  });
}

void write_built_history(const JobContext& context, const LyapunovOptions& options,
                         std::int64_t steps, Table& table) {
  const ImplementedLoop loop = implemented_loop_of(context.case_data, options.switching);
  with_motion(loop, initial_state_of(context.case_data), [&](auto motion) {
    EventLyapunov lyapunov(motion);
    for (std::int64_t step = 0; step < steps; ++step) {
      look_for_interrupt(step);
      run_to_completion(lyapunov, 1, {});
      write_history_row(table, motion.time(), lyapunov.spectrum().exponents().template head<5>());
    }
    require_resolved(motion, context.quiet);
  });
}

}  // namespace

void write_exponents(const JobContext& context, const LyapunovOptions& options) {
  const double period = context.case_data.control.sampling_period;
  const std::int64_t steps = steps_of(context, options);
  const std::int64_t discard = samples_within(options.discard, period) - 1;
  if (discard >= steps) throw WrongInput("--discard leaves nothing of --duration");
  const bool of_the_paper = is_of_the_paper(context.case_data, options.switching);
  if (!of_the_paper) require_consistent(options);
  Table table(
      context,
      {{"exponent", "", "number of the exponent, in the order of the QR; descending once converged",
        "integer"},
       {"per_sample", "", "natural logarithm per sample; -inf where a direction is annihilated"},
       {"per_second", "1/s", "per sample over the sampling period"},
       {"standard_error", "", "of per_sample, by batch means"}});
  LyapunovRun run{steps - discard, discard, options.standard_error, LyapunovScope::all,
                  LyapunovScope::largest};
  if (options.largest) run.scope = LyapunovScope::largest;
  const LyapunovResult result = of_the_paper ? sampled_exponents(context, options, run)
                                             : built_exponents(context, options, run);
  if (options.standard_error > 0.0 && result.outcome == LyapunovOutcome::sample_limit)
    report_warning("--standard-error was not reached within --duration", context.quiet);
  report_warning(open_sign_warning(result), context.quiet);
  for (int i = 0; i < (options.largest ? 1 : 5); ++i)
    table.row(i + 1, result.exponents[i], result.exponents[i] / period, result.standard_errors[i]);
  table.commit();
}

void write_exponent_history(const JobContext& context, const LyapunovOptions& options) {
  std::vector<Column> columns = {{"time_s", "s", "end of the averaged motion"}};
  for (int i = 1; i <= 5; ++i)
    columns.push_back({"lambda" + std::to_string(i), "", "exponent per sample up to this time"});
  const std::int64_t steps = steps_of(context, options);
  const bool of_the_paper = is_of_the_paper(context.case_data, options.switching);
  if (!of_the_paper) require_consistent(options);
  Table table(context, columns);
  if (of_the_paper)
    write_sampled_history(context, options, steps, table);
  else
    write_built_history(context, options, steps, table);
  table.commit();
}

}  // namespace holdfast::program
