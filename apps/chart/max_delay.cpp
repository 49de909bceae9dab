#include <cmath>

#include "case/axes/axis.hpp"
#include "case/model/conditioning.hpp"
#include "case/model/linear_loop.hpp"
#include "case/model/plant_of_case.hpp"
#include "holdfast/stability/design/proved_max_delay.hpp"
#include "job.hpp"
#include "jobs/charts/proved_poles.hpp"
#include "jobs/design/best_gains.hpp"
#include "output/row_blocks.hpp"

namespace holdfast::program {
namespace {

struct MaxDelayQuestion {
  std::string frequency = "3:60:58";
  std::string criterion = "attenuates";
  bool prove = false;

  void add_to(const Job& job) {
    job.add("--frequency", frequency);
    job.add("--criterion", criterion);
    job.add("--prove", prove);
  }

  void run(const JobContext& context) {
    const Case& the_case = context.case_data;
    if (prove && criterion != "stable")
      throw WrongInput("--prove proves only stability: give --criterion stable");
    if (prove) poles_ = proved_poles_of(the_case);
    const LinearLoop loop(the_case);
    answer(context, loop);
    if (loop.walks() && !prove)
      report_warning(
          "sampling_period was searched in steps of 3 % (short periods: up to 30 %): an unstable "
          "interval narrower than a step may be missed",
          context.quiet);
  }

 private:
  /// Interval of periods (s) proved to be stable for some D. It starts at the shortest examined
  /// period; the proof tries to reach 1.01 `found`, or one period of the excitation if it is ∞.
  Interval<double> proved_periods(const JobContext& context, const LinearLoop& loop,
                                  const MaxDelayOptions& question, double found) const {
    const double shortest = std::min(question.shortest_period, 1e-3 / question.frequency);
    const double beyond = std::isfinite(found) ? 1.01 * found : 1.0 / question.frequency;
    return {shortest, proved_max_sampling_period(
                          poles_, question.proportional_gain,
                          EnclosedSamplings::of_period(sampling_of(context.case_data)),
                          {shortest, std::max(shortest, beyond)},
                          [&](double period) { return loop.stable_gains(question, period); },
                          [] { throw_if_interrupted(); })};
  }

  void answer(const JobContext& context, const LinearLoop& loop) {
    const Axis axis = parse_axis("--frequency", frequency);
    Table table(context, columns_of(prove ? "proved max-delay" : "max-delay"));
    for (const auto& [question, answer, proved] : answers_of(context, loop, axis)) {
      if (answer.outcome == MaxDelayOutcome::beyond_search)
        report_warning(
            "at " + format_rounded(question.frequency) +
                " Hz the search found no limit: every sampling period meets --criterion up to " +
                format_rounded(answer.sampling_period) + " s, where the search ended",
            context.quiet);
      note(loop, question, answer, context);
      const bool has_proof = proved.upper >= proved.lower;
      if (prove)
        table.row(question.frequency, question.proportional_gain, answer.sampling_period,
                  answer.differential_gain, has_proof ? proved.lower : std::nan(""),
                  has_proof ? proved.upper : std::nan(""));
      else
        table.row(question.frequency, question.proportional_gain, answer.sampling_period,
                  answer.differential_gain);
    }
    table.commit();
    if (on_boundary_ > 0)
      report_warning(std::to_string(on_boundary_) + " of " + std::to_string(axis.count) +
                         " values of differential_gain lie on the boundary of stability: give "
                         "a shorter control.sampling_period and find its best D by holdfast design",
                     context.quiet);
    report_warning(held_force_, context.quiet);
  }

  /// Options and answer for one frequency.
  struct Answered {
    MaxDelayOptions question;
    MaxDelay answer;
    Interval<double> proved;  // proved periods (s), with --prove
  };

  /// Answers at all frequencies, computed in parallel.
  std::vector<Answered> answers_of(const JobContext& context, const LinearLoop& loop,
                                   const Axis& axis) const {
    std::vector<Answered> all(static_cast<std::size_t>(axis.count));
    side_by_side(context, "max-delay", axis.count, [&](std::int64_t i) {
      Answered& here = all[static_cast<std::size_t>(i)];
      here.question = tuned_delay_question(context.case_data, axis.at(i));
      if (criterion == "stable") here.question.criterion = DelayCriterion::stable;
      here.answer = loop.longest_period(here.question);
      if (prove)
        here.proved = proved_periods(context, loop, here.question, here.answer.sampling_period);
    });
    return all;
  }

  /// Counts gains D on the stability boundary; notes if holding the force affects the attenuation.
  void note(const LinearLoop& loop, const MaxDelayOptions& question, const MaxDelay& answer,
            const JobContext& context) {
    if (!(answer.sampling_period > 0.0 && std::isfinite(answer.sampling_period))) return;
    const PdGains<double> gains{question.proportional_gain, answer.differential_gain};
    if (loop.excess(question.sampling(answer.sampling_period), gains) > -1e-9) ++on_boundary_;
    if (question.criterion == DelayCriterion::attenuates && held_force_.empty())
      held_force_ = held_force_warning(
          context.case_data, answer.sampling_period, question.frequency,
          "--criterion attenuates compares with no control under the continuous force");
  }

  std::vector<EnclosedPole> poles_;  // for the proofs; empty without --prove
  std::int64_t on_boundary_ = 0;
  std::string held_force_;
};

}  // namespace

void add_max_delay(CLI::App& program) { add_job<MaxDelayQuestion>(program, "max-delay"); }

}  // namespace holdfast::program
