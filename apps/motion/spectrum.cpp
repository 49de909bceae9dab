#include "holdfast/math/signal/spectrum.hpp"
#include "case/model/loop_of_case.hpp"
#include "case/model/motion_of_case.hpp"
#include "holdfast/motion/trajectory.hpp"
#include "io/text/table.hpp"
#include "job.hpp"
#include "jobs/motion/motion_digits.hpp"
#include "jobs/motion/motion_run.hpp"
#include "motion_options.hpp"
#include "process/errors.hpp"

namespace holdfast::program {
namespace {

struct SpectrumOptions {
  double duration = 60.0;
  std::optional<double> discard;
  std::string window = "rectangular";
  Switching switching = Switching::sampled;
};

/// A motion's z1 without its transient.
struct SteadyRecord {
  std::vector<double> displacement;
  TrustedDigits trusted;  // of the samples
};

/// z1 of the samples after the discarded time, cut to whole forcing and sampling periods.
SteadyRecord steady_record(const JobContext& context, const SpectrumOptions& options) {
  const double period = context.case_data.control.sampling_period;
  const double discard = options.discard.value_or(options.duration / 2.0);
  if (!(discard < options.duration)) throw WrongInput("--discard leaves nothing of --duration");
  const std::int64_t samples = samples_of(context.case_data, options.duration);
  const std::int64_t kept =
      whole_period_samples(samples - samples_within(discard, period),
                           excitation_of(context.case_data).frequency, period);
  if (kept < 2) throw WrongInput("--duration and --discard leave fewer than two samples");
  const double from = static_cast<double>(samples - kept) * period;
  auto digits = digits_beside(context.case_data, {options.switching}, {}, from);
  std::vector<double> record;
  record.reserve(static_cast<std::size_t>(kept));
  with_motion_of(context.case_data, {options.switching}, [&](auto motion) {
    run_to_completion(motion, samples, {}, [&](const MotionSample<double>& sample) {
      if (digits) (*digits)(sample);
      if (sample.index >= samples - kept) record.push_back(sample.state[0]);
    });
    require_resolved(motion, context.quiet);
  });
  return {record, digits ? digits->result() : TrustedDigits{}};
}

void run(const JobContext& context, const SpectrumOptions& options) {
  Table table(context,
              {{"frequency_Hz", "Hz", "frequency of the line"},
               {"amplitude_m", "m", "amplitude of z1: a sine of amplitude a on a line shows a"}});
  const auto window = options.window == "hann" ? SpectralWindow::hann : SpectralWindow::rectangular;
  const SteadyRecord record = steady_record(context, options);
  const auto lines =
      amplitude_spectrum(record.displacement, context.case_data.control.sampling_period, window);
  for (const SpectralLine& line : lines) table.row(line.frequency, line.amplitude);
  tell_trust(context, table, record.trusted);
  table.commit();
}

}  // namespace

void add_spectrum(CLI::App& program) {
  const Job job(program, "spectrum", question::attractor,
                "Amplitude spectrum of z1 over a whole number of forcing periods");
  const auto options = std::make_shared<SpectrumOptions>();
  add_duration(job, options->duration);
  job->add_option("--discard", options->discard,
                  "Transient left out at the start, s (default: half)")
      ->check(number_from(0.0, 1e12))
      ->type_name("");
  job->add_option("--window", options->window, "Weighting of the record: rectangular or hann")
      ->check(CLI::IsMember({"rectangular", "hann"}))
      ->capture_default_str();
  add_switching(job, options->switching);
  job->final_callback([job, options] { run(job.context(), *options); });
}

}  // namespace holdfast::program
