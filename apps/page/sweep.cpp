#include "job.hpp"
#include "sweep/sweep_plan.hpp"

namespace holdfast::program {
namespace {

struct SweepQuestion : SweepOptions {
  bool dry_run = false;

  void add_to(const Job& job) {
    job.add("--axis", axes);
    CLI::Option* metric = job.add("--metric", metrics);
    metric->description(filled(metric->get_description(), {{"metrics", metric_names()}}));
    job.add("--duration", duration);
    job.add("--max-period", largest_period);
    job.add("--best-gain", best_gain);
    job.add("--chunk", chunk_cells);
    job.add("--resume", resume);
    job.add("--part", part);
    job.add("--dry-run", dry_run);
    job.add("--switching", switching);
  }

  void run(const Job& job) {
    // The plan reduces the plant, if it is to be, of the case or of each cell.
    const JobContext context = job.context();
    instructions_given = job.has("--instructions");
    if (job.has("--family")) members = job.draws();
    dry_run ? write_sweep_size(context, *this) : write_sweep(context, *this);
  }
};

}  // namespace

void add_sweep(CLI::App& program) { add_job<SweepQuestion>(program, "sweep"); }

}  // namespace holdfast::program
