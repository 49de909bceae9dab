#include "holdfast/phase_space/section.hpp"
#include "case/model/modal/modes_warning.hpp"
#include "case/model/moving_loop.hpp"
#include "holdfast/motion/instant.hpp"
#include "job.hpp"
#include "jobs/motion/case_motion.hpp"
#include "jobs/motion/motion_digits.hpp"
#include "jobs/motion/motion_run.hpp"

namespace holdfast::program {
namespace {

struct SectionQuestion {
  double duration = 60.0;
  double from = 30.0;
  Switching switching = Switching::sampled;

  void add_to(const Job& job) {
    job.add("--duration", duration);
    job.add("--from", from);
    job.add("--switching", switching);
  }

  void run(const JobContext& context) const {
    if (from > duration) throw WrongInput("--from is after --duration: give an earlier --from");
    Table table(context, columns_of("section"));
    const std::int64_t before = samples_of(context.case_data, from) - 1;
    const std::int64_t samples = samples_of(context.case_data, duration) - 1;
    const auto run_of = [&](auto motion) {
      const auto write = [&](const auto& point) {
        throw_if_interrupted();
        if (!not_before(point.time, from)) return;
        const Vector<double, 4> state = motion.readings().both_sides(point.state);
        table.row(point.time, state[0], state[1], state[2], point.rising ? 1 : 0,
                  point.engaged ? 0 : 1);
      };
      run_to_completion(motion, before, {});
      require_completed(run_section(motion, samples - before, write), motion.time());
      tell_of_end(context, end_of(motion));
    };
    report_warning(dense_work_warning(context.case_data, Switching::exact), context.quiet);
    const BuiltLoop built = built_loop_of(context.case_data, {switching});
    std::visit([&](const auto& one) { run_of(motion_of(one)); }, built);
    const MovingLoop moving = moving_loop_of(context.case_data, {switching});
    tell_trust(context, table, trusted_digits_of_motion(moving, built, samples, from));
    table.commit();
  }
};

}  // namespace

void add_section(CLI::App& program) { add_job<SectionQuestion>(program, "section"); }

}  // namespace holdfast::program
