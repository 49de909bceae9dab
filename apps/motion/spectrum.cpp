#include "holdfast/math/signal/spectrum.hpp"

#include <cmath>

#include "holdfast/motion/instant.hpp"
#include "holdfast/motion/trajectory.hpp"
#include "job.hpp"
#include "jobs/motion/case_motion.hpp"
#include "jobs/motion/motion_digits.hpp"
#include "jobs/motion/motion_run.hpp"

namespace holdfast::program {
namespace {

struct SpectrumQuestion {
  double duration = 60.0;
  std::optional<double> discard;
  std::string window = "rectangular";
  Switching switching = Switching::sampled;

  void add_to(const Job& job) {
    job.add("--duration", duration);
    job.add("--discard", discard);
    job.add("--window", window);
    job.add("--switching", switching);
  }
  void run(const JobContext& context) const;
};

/// Record of z1 without its initial transient.
struct SteadyRecord {
  std::vector<double> displacement;
  TrustedDigits trusted;  // digits of the samples
};

/// Record of z1 after the discarded time, cut to whole forcing and sampling periods.
SteadyRecord steady_record(const JobContext& context, const SpectrumQuestion& options) {
  const double period = context.case_data.control.sampling_period;
  const double discard = options.discard.value_or(options.duration / 2.0);
  if (!(discard < options.duration)) throw WrongInput("--discard must be shorter than --duration");
  const std::int64_t samples = samples_of(context.case_data, options.duration);
  const std::int64_t kept =
      whole_period_samples(samples - samples_within(discard, period),
                           excitation_of(context.case_data).frequency, period);
  if (kept < 2) throw WrongInput("give a longer --duration: fewer than two samples are left");
  constexpr std::int64_t most = 100'000'000;
  if (kept > most)
    throw NoAnswer(
        "a record of " + std::to_string(kept) + " samples is longer than the limit of " +
        std::to_string(most) +
        ": give a shorter --duration, a longer --discard or a longer control.sampling_period");
  const HarmonicExcitation<double> force = excitation_of(context.case_data);
  const double length = static_cast<double>(kept) * period;
  if (force.amplitude > 0.0 && !not_before(length, 1.0 / force.frequency))
    throw WrongInput(
        "--duration and --discard leave " + format_rounded(length) +
        " s, less than one period of the excitation, " + format_rounded(1.0 / force.frequency) +
        " s: the spectrum has no line at the excitation frequency; give a longer --duration");
  const double from = static_cast<double>(samples - kept) * period;
  const MovingLoop moving = moving_loop_of(context.case_data, {options.switching});
  auto digits = digits_beside(moving, {}, from);
  std::vector<double> record;
  record.reserve(static_cast<std::size_t>(kept));
  CaseMotion motion(moving);
  run_to_completion(motion, samples, {}, [&](const EventSample& sample) {
    if (digits) (*digits)(sample);
    if (sample.index >= samples - kept) record.push_back(sample.state[0]);
  });
  tell_of_end(context, end_of(motion));
  if (!digits) return {record, {}};
  return {record, digits->result()};
}

/// Warning if the amplitudes of the two halves of a record differ; else empty.
std::string unsettled_warning(const std::vector<double>& record) {
  const auto middle = record.begin() + static_cast<std::ptrdiff_t>(record.size() / 2);
  const auto root_mean_square = [](auto begin, auto end) {
    return std::sqrt(std::inner_product(begin, end, begin, 0.0) / static_cast<double>(end - begin));
  };
  const double first = root_mean_square(record.begin(), middle);
  const double second = root_mean_square(middle, record.end());
  if (std::abs(second - first) <= 0.1 * first) return "";
  return "the motion has not settled after --discard: the root mean square of z1 changes from " +
         format_rounded(first) + " m in the first half of the record to " + format_rounded(second) +
         " m in the second half; give a longer --duration";
}

void SpectrumQuestion::run(const JobContext& context) const {
  Table table(context, columns_of("spectrum"));
  const auto weighting = window == "hann" ? SpectralWindow::hann : SpectralWindow::rectangular;
  const SteadyRecord record = steady_record(context, *this);
  const auto lines =
      amplitude_spectrum(record.displacement, context.case_data.control.sampling_period, weighting);
  for (const SpectralLine& line : lines) table.row(line.frequency, line.amplitude);
  report_warning(unsettled_warning(record.displacement), context.quiet);
  tell_trust(context, table, record.trusted);
  table.commit();
}

}  // namespace

void add_spectrum(CLI::App& program) { add_job<SpectrumQuestion>(program, "spectrum"); }

}  // namespace holdfast::program
