#include <memory>

#include "job.hpp"
#include "motion_options.hpp"
#include "sweep/sweep_run.hpp"

namespace holdfast::program {
namespace {

struct SweepArguments {
  SweepOptions question;
  bool dry_run = false;
};

/// How the work is cut, gone on with, or only told.
void add_tile_options(const Job& job, SweepArguments& options) {
  job->add_option("--tile", options.question.tile_cells,
                  "Cells that are computed and kept together; 0: chosen. Results do not depend on "
                  "it")
      ->check(CLI::Range(std::int64_t{0}, std::int64_t{1} << 16))
      ->type_name("N")
      ->capture_default_str();
  CLI::Option* resume = job->add_flag("--resume", options.question.resume,
                                      "Go on with the tiles that an earlier run left");
  job->add_flag("--dry-run", options.dry_run, "Tell how large it would be; compute nothing")
      ->excludes(resume);
}

}  // namespace

void add_sweep(CLI::App& program) {
  const Job job(program, "sweep", question::map,
                "Metrics of the motion over any number of axes, on all cores and machines");
  const auto options = std::make_shared<SweepArguments>();
  SweepOptions& asked = options->question;
  job->add_option("--axis", asked.axes,
                  "KEY=MIN:MAX:COUNT, KEY=log:MIN:MAX:COUNT or KEY=VALUE,VALUE,...: an axis over a "
                  "key of the case; repeatable, the first slowest")
      ->expected(1)
      ->take_all();
  job->add_option(
         "--metric", asked.metrics,
         "What is told of every cell; repeatable, in place of steady_peak, "
         "ratio_to_uncontrolled, attenuates, outcome (definitions: docs/theory.md, section "
         "16): " +
             metric_names())
      ->expected(1)
      ->take_all();
  add_duration(job, asked.duration)
      ->description("Length of the motion, s; its second half counts as steady");
  add_largest_period(job, asked.largest_period);
  job->add_flag("--best-gain", asked.best_gain,
                "D of every cell is that of least steady amplitude of the loop without backlash, "
                "among those whose transient falls to e^-5 in half the duration, as the job design "
                "finds it; the metric differential_gain tells it. P is the case's: with an axis "
                "over excitation.frequency use --set control.proportional_gain=tuned");
  add_tile_options(job, *options);
  add_switching(job, asked.switching);
  job.computes_on_packs();
  job->final_callback([job, options] {
    // The plan reduces the plant, if it is to be, of the case or of each cell.
    const JobContext context = job.context(PlantNeed::none);
    options->question.instructions_given = job.instructions_given();
    options->dry_run ? write_sweep_size(context, options->question)
                     : write_sweep(context, options->question);
  });
}

}  // namespace holdfast::program
