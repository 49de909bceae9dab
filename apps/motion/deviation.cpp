#include "holdfast/phase_space/deviation.hpp"
#include "case/model/motion_of_case.hpp"
#include "io/text/table.hpp"
#include "job.hpp"
#include "jobs/motion/motion_digits.hpp"
#include "jobs/motion/motion_run.hpp"
#include "motion_options.hpp"

namespace holdfast::program {
namespace {

struct DeviationOptions {
  double offset = 1e-5;
  double duration = 10.0;
  Switching switching = Switching::sampled;
};

void run(const JobContext& context, const DeviationOptions& options) {
  Table table(context, {{"time_s", "s", "t = j tau"},
                        {"z1_deviation_m", "m", "z1 of the neighbour minus z1 of the case"},
                        {"state_deviation", "",
                         "Euclidean norm of the difference of [z1, v1, z2, v2] in SI units"}});
  const std::int64_t samples = samples_of(context.case_data, options.duration);
  with_motion_of(context.case_data, {options.switching}, [&](auto first) {
    auto second = first;
    second.displace_conductor(options.offset);
    const auto outcome =
        run_deviation(first, second, samples, [&table](const Deviation& deviation) {
          table.row(deviation.time, deviation.displacement, deviation.state);
        });
    require_completed(outcome, first.time());
    require_resolved(first, context.quiet);
  });
  table.trust(
      trusted_digits_of_deviation(context.case_data, options.switching, options.offset, samples));
  table.commit();
}

}  // namespace

void add_deviation(CLI::App& program) {
  const Job job(program, "deviation", question::attractor,
                "How far two motions part that start close to each other");
  const auto options = std::make_shared<DeviationOptions>();
  job.add_number("--offset", options->offset, "Start of the neighbour: z1 displaced by this, m",
                 -1e6, 1e6);
  add_duration(job, options->duration);
  add_switching(job, options->switching);
  job->final_callback([job, options] { run(job.context(), *options); });
}

}  // namespace holdfast::program
