#include "case/axes/axis.hpp"
#include "job.hpp"
#include "jobs/design/design_tables.hpp"
#include "process/errors.hpp"

namespace holdfast::program {
namespace {

struct DesignOptions {
  std::string frequency;
  std::string band;
  double largest_radius = 1.0;
  bool both_gains = false;
};

void run(const JobContext& context, const DesignOptions& options) {
  if (options.both_gains) {
    write_best_pair(context);
  } else if (!options.band.empty()) {
    write_band_gain(context, parse_range("--band", options.band), options.largest_radius);
  } else {
    std::optional<Axis> frequencies;
    if (!options.frequency.empty()) frequencies = parse_axis("--frequency", options.frequency);
    write_best_gains(context, frequencies, options.largest_radius);
  }
}

}  // namespace

void add_design(CLI::App& program) {
  const Job job(program, "design", question::gains,
                "The best D: of least amplitude and of least spectral radius; one D for a band of "
                "frequencies; the best P and D");
  const auto options = std::make_shared<DesignOptions>();
  CLI::Option* frequency =
      job->add_option("--frequency", options->frequency,
                      "Excitation frequencies, MIN:MAX:COUNT, Hz, P tuned to each by Eq. 6; "
                      "without it the frequency and P of the case");
  CLI::Option* band =
      job->add_option("--band", options->band,
                      "Instead, one D for all excitation frequencies MIN:MAX, Hz, at the case's P: "
                      "that of least largest amplitude relative to no control")
          ->excludes(frequency);
  CLI::Option* radius =
      job->add_option("--largest-radius", options->largest_radius,
                      "Spectral radius that the D of least amplitude must stay below; less than 1 "
                      "asks for a transient that decays by it every sample")
          ->check(number_from(1e-6, 1.0))
          ->capture_default_str();
  job->add_flag("--both-gains", options->both_gains,
                "Instead, the P and D of least spectral radius")
      ->excludes(frequency)
      ->excludes(band)
      ->excludes(radius);
  job->final_callback([job, options] { run(job.context(), *options); });
}

}  // namespace holdfast::program
