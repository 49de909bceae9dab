#include "lyapunov_tables.hpp"

#include <memory>

#include "errors.hpp"
#include "exit.hpp"
#include "holdfast/attractor/lyapunov.hpp"
#include "holdfast/attractor/lyapunov_run.hpp"
#include "loop_of_case.hpp"
#include "motion_run.hpp"
#include "table.hpp"

namespace holdfast::program {
namespace {

/// The loop whose S and S* are the tangents: that of the motion, or the printed one with δ = τ.
SampledLoop<double> tangent_loop_of(const Case& the_case, const LyapunovQuestion& question) {
  Sampling<double> sampling = sampling_of(the_case);
  if (question.tangent == "printed") sampling.processing_delay = sampling.period;
  return sampled_loop(plant_of(the_case), sampling);
}

std::int64_t steps_of(const JobContext& context, const LyapunovQuestion& question) {
  const double period = context.case_data.control.sampling_period;
  const std::int64_t steps = samples_within(question.duration, period) - 1;
  if (steps < 1) throw WrongInput("--duration is shorter than one sampling period");
  return steps;
}

}  // namespace

void write_exponents(const JobContext& context, const LyapunovQuestion& question) {
  const double period = context.case_data.control.sampling_period;
  const std::int64_t steps = steps_of(context, question);
  const std::int64_t discard = samples_within(question.discard, period) - 1;
  if (discard >= steps) throw WrongInput("--discard leaves nothing of --duration");
  Table table(
      context,
      {{"exponent", "", "number of the exponent, in the order of the QR; descending once converged",
        "integer"},
       {"per_sample", "", "natural logarithm per sample; -inf where a direction is annihilated"},
       {"per_second", "1/s", "per sample over the sampling period"},
       {"standard_error", "", "of per_sample, by batch means"}});
  LyapunovRun run{steps - discard, discard, question.standard_error, LyapunovScope::all,
                  LyapunovScope::largest};
  if (question.largest) run.scope = LyapunovScope::largest;
  InterruptibleMotion motion(motion_of(context.case_data));
  const auto words = std::make_shared<const ContactWords>(
      tangent_loop_of(context.case_data, question), gains_of(context.case_data));
  const LyapunovResult result = run_lyapunov(motion, words, run);
  if (result.outcome == LyapunovOutcome::diverged) refuse_diverging(motion.time());
  if (question.standard_error > 0.0 && result.outcome == LyapunovOutcome::sample_limit)
    report_warning("--standard-error was not reached within --duration", context.quiet);
  for (int i = 0; i < (question.largest ? 1 : 5); ++i)
    table.row(i + 1, result.exponents[i], result.exponents[i] / period, result.standard_errors[i]);
  table.commit();
}

void write_exponent_history(const JobContext& context, const LyapunovQuestion& question) {
  const double period = context.case_data.control.sampling_period;
  std::vector<Column> columns = {{"time_s", "s", "end of the averaged motion"}};
  for (int i = 1; i <= 5; ++i)
    columns.push_back({"lambda" + std::to_string(i), "", "exponent per sample up to this time"});
  const std::int64_t steps = steps_of(context, question);
  Table table(context, columns);
  LyapunovObserver observer(tangent_loop_of(context.case_data, question),
                            gains_of(context.case_data));
  auto motion = motion_of(context.case_data);
  const auto write_row = [&](const MotionSample<double>& sample) {
    table.writer().cell(sample.time + period);
    for (const double exponent : observer.spectrum().exponents()) table.writer().cell(exponent);
    table.writer().end_row();
  };
  run_to_completion(motion, steps, {}, observer, write_row);
  table.commit();
}

}  // namespace holdfast::program
