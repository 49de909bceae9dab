#include "case/axes/axis.hpp"
#include "case/case_keys.hpp"
#include "case/model/modal/modes_warning.hpp"
#include "holdfast/motion/instant.hpp"
#include "holdfast/motion/trajectory.hpp"
#include "job.hpp"
#include "jobs/motion/case_motion.hpp"
#include "jobs/motion/elements_run.hpp"
#include "jobs/motion/motion_columns.hpp"
#include "jobs/motion/motion_digits.hpp"
#include "jobs/motion/motion_run.hpp"

namespace holdfast::program {
namespace {

struct SimulateQuestion {
  double duration = 10.0;
  double from = 0.0;
  std::optional<std::string> kick;
  bool no_control = false;
  Switching switching = Switching::sampled;
  std::string plant = "case";
  std::optional<int> elements;

  void add_to(const Job& job) {
    job.add("--duration", duration);
    job.add("--from", from);
    job.add("--kick", kick);
    job.add("--no-control", no_control);
    job.add("--switching", switching);
    job.add("--plant", plant);
    job.add("--elements", elements);
  }

  void run(const JobContext& context) const {
    const std::optional<Kick> kicked = parsed_kick();
    if (from > duration) throw WrongInput("--from is after --duration: give an earlier --from");
    if (kicked) require_within_span("--kick", kicked->displacement, context.case_data);
    if (kicked && kicked->time > duration)
      throw WrongInput("the time of --kick is after --duration: give an earlier time");
    const std::int64_t samples = samples_of(context.case_data, duration);
    require_text_meant(context, samples_of(context.case_data, duration - from), "rows",
                       "give a later --from or a shorter --duration");
    Table table(context, motion_columns(switching));
    table.expect(samples_of(context.case_data, duration - from));
    if (elements && plant != "elements") throw WrongInput("--elements: add --plant elements too");
    if (plant == "elements") {
      write_elements(context, table, samples);
      table.commit();
      return;
    }
    note_first_contact(context.case_data, table);
    report_warning(dense_work_warning(context.case_data, switching), context.quiet);
    const MovingLoop moving = moving_loop_of(context.case_data, {switching, !no_control});
    auto digits = digits_beside(moving, kicked, from);
    CaseMotion motion(moving);
    run_to_completion(motion, samples, kicked, [&](const EventSample& sample) {
      if (digits) (*digits)(sample);
      if (!not_before(sample.time, from)) return;
      write_motion_row(table, switching, sample);
    });
    tell_of_end(context, end_of(motion), !no_control, kicked ? kicked->displacement : 0.0);
    if (digits) tell_trust(context, table, digits->result());
    table.commit();
  }

  /// Adds a note to the table on where in its play the drive starts.
  void note_first_contact(const Case& the_case, Table& table) const {
    if (no_control || the_case.backlash.width == 0.0) return;
    if (the_case.backlash.law == "none" || the_case.backlash.law == "dead_zone") return;
    table.note("play_at_start",
               "the drive is engaged at the start: its first reversal crosses the whole play");
  }

  /// Writes the rows of the nonlinear cable.
  void write_elements(const JobContext& context, Table& table, std::int64_t samples) const {
    if (kick) throw WrongInput("--plant elements takes no --kick: leave --kick out");
    Progress progress(static_cast<std::uint64_t>(samples), "simulate, samples",
                      progress_wanted(context));
    const ElementsQuestion question{elements.value_or(200), !no_control, samples};
    report_warning(coarse_bars_warning(context.case_data, question), context.quiet);
    run_elements(context.case_data, question, [&](const auto& sample) {
      progress.advance();
      if (!not_before(sample.time, from)) return;
      const ContactMode mode = sample.engaged ? ContactMode::engaged : ContactMode::gap;
      write_motion_row(table, switching, {sample, mode});
    });
  }

  std::optional<Kick> parsed_kick() const {
    if (!kick) return std::nullopt;
    const KickOption parsed = parse_kick("--kick", *kick);
    return Kick{parsed.time, parsed.displacement};
  }
};

}  // namespace

void add_simulate(CLI::App& program) { add_job<SimulateQuestion>(program, "simulate"); }

}  // namespace holdfast::program
