#include "holdfast/attractor/lyapunov.hpp"
#include "errors.hpp"
#include "holdfast/motion/trajectory.hpp"
#include "job.hpp"
#include "loop_of_case.hpp"
#include "motion_options.hpp"
#include "table.hpp"

namespace holdfast::program {
namespace {

struct Options {
  double duration = 100.0;
  std::string tangent = "consistent";
  std::string switching = "sampled";
  bool history = false;
};

/// The loop whose S and S* are the tangents: that of the motion, or the printed one with δ = τ.
SampledLoop<double> tangent_loop_of(const Case& the_case, const Options& options) {
  Sampling<double> sampling = sampling_of(the_case);
  if (options.tangent == "printed") sampling.processing_delay = sampling.period;
  return sampled_loop(plant_of(the_case), sampling);
}

std::vector<Column> columns(const Options& options) {
  if (!options.history) {
    return {
        {"exponent", "",
         "number of the exponent, in the order of the QR; descending once converged", "integer"},
        {"per_sample", "", "natural logarithm per sample; -inf where a direction is annihilated"},
        {"per_second", "1/s", "per sample over the sampling period"},
        {"standard_error", "", "of per_sample, by batch means"}};
  }
  std::vector<Column> result = {{"time_s", "s", "end of the averaged motion"}};
  for (int i = 1; i <= 5; ++i) {
    result.push_back({"lambda" + std::to_string(i), "", "exponent per sample up to this time"});
  }
  return result;
}

void write_history_row(CsvWriter& writer, double time,
                       const LyapunovSpectrum<double, 5>& spectrum) {
  writer.cell(time);
  for (const double exponent : spectrum.exponents()) writer.cell(exponent);
  writer.end_row();
}

void run(const JobContext& context, const Options& options) {
  const double period = context.case_data.control.sampling_period;
  const std::int64_t steps = samples_within(options.duration, period) - 1;
  if (steps < 1) throw WrongInput("--duration is shorter than one sampling period");
  Table table(context, columns(options));
  LyapunovObserver observer(tangent_loop_of(context.case_data, options),
                            gains_of(context.case_data));
  auto motion = motion_of(context.case_data);
  run_to_completion(motion, steps, {}, observer, [&](const MotionSample<double>& sample) {
    if (options.history)
      write_history_row(table.writer(), sample.time + period, observer.spectrum());
  });
  if (!options.history) {
    const auto exponents = observer.spectrum().exponents();
    const auto errors = observer.spectrum().standard_errors();
    for (int i = 0; i < 5; ++i) table.row(i + 1, exponents[i], exponents[i] / period, errors[i]);
  }
  table.commit();
}

}  // namespace

void add_lyapunov(CLI::App& program) {
  const Job job(program, "lyapunov", question::attractor,
                "The five Lyapunov exponents of the sampled motion");
  const auto options = std::make_shared<Options>();
  add_duration(job, options->duration);
  job->add_option("--tangent", options->tangent,
                  "consistent: of the motion itself; printed: S and S* with delay tau, as the "
                  "paper's Table 2")
      ->check(CLI::IsMember({"consistent", "printed"}))
      ->capture_default_str();
  job->add_flag("--history", options->history, "Write the exponents after every sample");
  add_switching(job, options->switching);
  job->final_callback([job, options] { run(job.context(), *options); });
}

}  // namespace holdfast::program
