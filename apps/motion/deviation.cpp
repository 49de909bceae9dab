#include "holdfast/phase_space/deviation.hpp"
#include "case/case_keys.hpp"
#include "case/model/moving_loop.hpp"
#include "job.hpp"
#include "jobs/motion/case_motion.hpp"
#include "jobs/motion/motion_digits.hpp"
#include "jobs/motion/motion_run.hpp"

namespace holdfast::program {
namespace {

struct DeviationQuestion {
  double offset = 1e-5;
  double duration = 10.0;
  Switching switching = Switching::sampled;

  void add_to(const Job& job) {
    job.add("--offset", offset);
    job.add("--duration", duration);
    job.add("--switching", switching);
  }

  void run(const JobContext& context) const {
    if (offset == 0.0)
      throw WrongInput("--offset is 0: the two motions would be the same; the default is 1e-5 m");
    require_within_span("--offset", offset, context.case_data);
    Table table(context, columns_of("deviation"));
    const std::int64_t samples = samples_of(context.case_data, duration);
    require_text_meant(context, samples, "rows", "give a shorter --duration");
    double last = 0.0, valid_until = -1.0;
    const MovingLoop moving = moving_loop_of(context.case_data, {switching});
    CaseMotion first(moving), second = first;
    second.displace_conductor(offset);
    const auto outcome = run_deviation(first, second, samples, [&](const Deviation& deviation) {
      table.row(deviation.time, deviation.displacement, deviation.state);
      last = deviation.state;
      if (deviation.is_above_rounding()) valid_until = deviation.time;
    });
    require_completed(outcome, first.time());
    if (valid_until < 0.0)
      throw NoAnswer(
          "the distance of the two motions is below rounding errors: give a larger --offset");
    table.note("above_rounding_until_s", format_number(valid_until));
    tell_of_end(context, end_of(first));
    table.trust(trusted_digits_of_deviation(moving, offset, samples));
    table.commit();
    if (last >= std::abs(offset))
      report_warning("the states of the two motions still differ by " + format_rounded(last) +
                         " at the end, so they may settle apart: compare by holdfast orbit",
                     context.quiet);
  }
};

}  // namespace

void add_deviation(CLI::App& program) { add_job<DeviationQuestion>(program, "deviation"); }

}  // namespace holdfast::program
