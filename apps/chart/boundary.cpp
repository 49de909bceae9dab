#include "case/axes/axis.hpp"
#include "case/model/plant_of_case.hpp"
#include "job.hpp"
#include "jobs/charts/gain_plane_tables.hpp"
#include "process/errors.hpp"

namespace holdfast::program {
namespace {

struct BoundaryOptions {
  std::string p = "-1000:200";
  std::string d = "-40:20";
  bool p_given = false, d_given = false, continuous = false;
  bool stable_interval = false, regions = false, features = false;
};

ProportionalRange proportional_range(const BoundaryOptions& options) {
  const Range range = parse_range("--p", options.p);
  return {range.min, range.max};
}

GainWindow window(const BoundaryOptions& options) {
  const Range d = parse_range("--d", options.d);
  return {proportional_range(options), {d.min, d.max}};
}

/// The gains of the options; the case's own where neither is given.
FixedGains fixed_gains(const JobContext& context, const BoundaryOptions& options) {
  const PdGains<double> own = gains_of(context.case_data);
  if (!options.p_given && !options.d_given) return {{own.proportional}, {own.differential}};
  FixedGains fixed;
  if (options.p_given) fixed.proportional = parse_list("--p", options.p);
  if (options.d_given) fixed.differential = parse_list("--d", options.d);
  return fixed;
}

void run(const JobContext& context, const BoundaryOptions& options) {
  const bool continuous = options.continuous;
  if (options.stable_interval) {
    write_stable_intervals(context, fixed_gains(context, options), continuous);
  } else if (options.regions) {
    write_gain_regions(context, window(options), continuous);
  } else if (options.features) {
    write_boundary_features(context, window(options), continuous);
  } else if (options.d_given) {
    throw WrongInput("--d goes with --stable-interval, --regions or --features");
  } else {
    write_boundary(context, proportional_range(options), continuous);
  }
}

}  // namespace

void add_boundary(CLI::App& program) {
  const Job job(program, "boundary", question::gains,
                "Exact curves on which a characteristic root leaves the stable region");
  const auto options = std::make_shared<BoundaryOptions>();
  job.add_text("--p", options->p,
               "Proportional gains P, MIN:MAX, N/m; with --stable-interval P or P,P,…");
  job.add_text("--d", options->d, "Window in D, MIN:MAX, N s/m; with --stable-interval D or D,D,…");
  job->add_flag("--continuous", options->continuous,
                "Without sampling: the continuous loop; angle columns then hold rad/s");
  CLI::Option* intervals = job->add_flag(
      "--stable-interval", options->stable_interval,
      "Instead, stable D at P and stable P at D; without --p and --d at the case's gains");
  CLI::Option* regions =
      job->add_flag("--regions", options->regions, "Instead, the regions of the window --p, --d");
  job->add_flag("--features", options->features,
                "Instead, tangents, cusps, crossings and ends of the curves in the window");
  job->get_option("--features")->excludes(intervals)->excludes(regions);
  regions->excludes(intervals);
  job->final_callback([job, options] {
    options->p_given = job->count("--p") > 0;
    options->d_given = job->count("--d") > 0;
    run(job.context(), *options);
  });
}

}  // namespace holdfast::program
