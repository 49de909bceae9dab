#include "case/axes/axis.hpp"
#include "case/model/conditioning.hpp"
#include "case/model/linear_loop.hpp"
#include "case/model/plant_of_case.hpp"
#include "holdfast/control/gains.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "holdfast/stability/design/minimax_amplitude.hpp"
#include "holdfast/stability/design/minimum_amplitude.hpp"
#include "holdfast/stability/design/minimum_radius.hpp"
#include "job.hpp"
#include "jobs/design/best_gains.hpp"
#include "jobs/design/gain_margins.hpp"
#include "jobs/family/family_design.hpp"
#include "output/row_blocks.hpp"
#include "text/names.hpp"

namespace holdfast::program {
namespace {

constexpr Named<MinimumAmplitudeOutcome> amplitude_names[] = {
    {MinimumAmplitudeOutcome::stationary, "stationary"},
    {MinimumAmplitudeOutcome::edge, "edge"},
    {MinimumAmplitudeOutcome::none, "none"},
    {MinimumAmplitudeOutcome::aliased, "aliased"}};

constexpr const char* ratios_shown =
    "ratios are relative to the vibration without control under the continuous force";

std::string no_gain_text(double proportional_gain, double largest_radius) {
  return "no D keeps the spectral radius below " + format_rounded(largest_radius) +
         " at P = " + format_rounded(proportional_gain) + " N/m: change P";
}

/// Warns if there is no D of least amplitude, and gives the reason.
void warn_of_no_gain(MinimumAmplitudeOutcome outcome, double proportional_gain,
                     double largest_radius, bool quiet) {
  if (outcome == MinimumAmplitudeOutcome::none)
    report_warning(std::isfinite(proportional_gain)
                       ? no_gain_text(proportional_gain, largest_radius)
                       : "no P and D have the required margin: give a smaller --margin",
                   quiet);
  if (outcome == MinimumAmplitudeOutcome::aliased)
    report_warning(
        "the excitation frequency is not below half the sampling rate: the samples do not show the "
        "vibration; give a shorter control.sampling_period",
        quiet);
}

/// Best D at one frequency (Hz) and one P (N/m).
struct BestRow {
  double frequency, p;  // Hz, N/m
  MinimumAmplitude quietest;
  MinimumRadius fastest;
  GainMargins margins;  // with the D of least amplitude
};

/// Best gains at each frequency, computed in parallel.
/// @param tuned  whether P is tuned to each frequency by Eq. 6; otherwise P is that of the case
/// @param both   whether P is optimised too
std::vector<BestRow> best_rows(const JobContext& context, const AmplitudeOptions& options,
                               const Axis& axis, bool tuned, bool both) {
  const Case& the_case = context.case_data;
  const LinearLoop loop(the_case);
  std::vector<BestRow> rows(static_cast<std::size_t>(axis.count));
  side_by_side(context, "design", axis.count, [&](std::int64_t i) {
    BestRow& row = rows[static_cast<std::size_t>(i)];
    row.frequency = axis.at(i);
    row.p = tuned ? tuned_proportional_gain(the_case.plant.absorber_stiffness,
                                            the_case.plant.absorber_mass, row.frequency)
                  : gains_of(the_case).proportional;
    if (both) {
      const auto [p, quietest] = loop.quietest_pair(options, row.frequency);
      row.p = p;
      row.quietest = quietest;
    } else {
      row.quietest = loop.quietest(options, row.frequency, row.p);
    }
    row.fastest = loop.fastest(row.p);
    row.margins = gain_margins(loop, {row.p, row.quietest.differential_gain});
  });
  return rows;
}

/// Writes the best D at each frequency, with P tuned to that frequency by Eq. 6. Without
/// frequencies: the best D at the frequency and P of the case; with `both`, the best P and D.
void write_best_gains(const JobContext& context, const std::optional<Axis>& frequencies,
                      const AmplitudeOptions& options, bool both) {
  const Case& the_case = context.case_data;
  const double own = excitation_of(the_case).frequency;
  const Axis axis = frequencies.value_or(Axis{own, own, 1});
  Table table(context, columns_of("best gains"));
  double largest = 0.0;  // largest spectral radius
  for (const auto& [frequency, p, quietest, fastest, margins] :
       best_rows(context, options, axis, frequencies.has_value(), both)) {
    if (!frequencies) {
      warn_of_no_gain(quietest.outcome, p, options.largest_radius, context.quiet);
      report_warning(play_warning(the_case, {p, quietest.differential_gain},
                                  quietest.ratio_to_uncontrolled, context.instructions),
                     context.quiet);
    }
    largest = std::max(largest, margins.spectral_radius);
    table.row(frequency, p, quietest.differential_gain, quietest.ratio_to_uncontrolled,
              quietest.attenuation, fastest.differential_gain, fastest.radius,
              name_in(amplitude_names, quietest.outcome), margins.spectral_radius,
              margins.gain_decibels, margins.phase_degrees, margins.delay);
  }
  warn_of_edge(largest, options.sampling.period, context.quiet);
  if (largest > 0.0)
    report_warning(held_force_warning(the_case, options.sampling.period,
                                      std::max(axis.at(0), axis.at(axis.count - 1)), ratios_shown),
                   context.quiet);
  table.commit();
}

/// Writes the one D that minimises the largest amplitude ratio over a band (Hz), at the case's P.
void write_band_gain(const JobContext& context, const Range& band,
                     const AmplitudeOptions& options) {
  const Case& the_case = context.case_data;
  const double p = gains_of(the_case).proportional;
  const FrequencyBand frequencies{band.min, band.max};
  const LinearLoop loop(the_case);
  const auto answer = loop.quietest_over(options, p, frequencies);
  if (answer.outcome == MinimaxOutcome::none)
    throw NoAnswer(no_gain_text(p, options.largest_radius));
  report_warning(held_force_warning(the_case, options.sampling.period, band.max, ratios_shown),
                 context.quiet);
  if (answer.outcome == MinimaxOutcome::not_converged)
    report_warning(
        "the search stopped early: another D may have a lower worst_ratio, but not below " +
            format_rounded(answer.lower_bound),
        context.quiet);
  const GainMargins margins = gain_margins(loop, {p, answer.differential_gain});
  warn_of_edge(margins.spectral_radius, options.sampling.period, context.quiet);
  Table table(context, columns_of("band gain"));
  table.row(band.min, band.max, p, answer.differential_gain, answer.worst_ratio,
            answer.worst_frequency, answer.attenuation, answer.lower_bound, margins.spectral_radius,
            margins.gain_decibels, margins.phase_degrees, margins.delay);
  table.commit();
}

struct DesignQuestion {
  std::string frequency;
  std::string band, schedule;
  std::optional<double> largest_radius, margin, largest_ratio;
  bool both_gains = false, prove = false;

  void add_to(const Job& job) {
    job.add("--frequency", frequency);
    job.add("--band", band);
    job.add("--largest-radius", largest_radius);
    job.add("--margin", margin);
    job.add("--both-gains", both_gains);
    job.add("--largest-ratio", largest_ratio);
    job.add("--schedule", schedule);
    job.add("--prove", prove);
  }

  void run(const Job& job) const {
    const JobContext context = job.context();
    if (job.has("--family")) return serve_family(job, context);
    for (const char* of_family : {"--largest-ratio", "--schedule", "--prove", "--draws"})
      if (job.has(of_family)) throw WrongInput(std::string(of_family) + ": give --family as well");
    if (both_gains && !band.empty())
      throw WrongInput("--both-gains with --band needs --family: add --family");
    const AmplitudeOptions options =
        amplitude_options_of(context.case_data, largest_radius, margin);
    if (!band.empty()) return write_band_gain(context, parse_range("--band", band), options);
    std::optional<Axis> frequencies;
    if (!frequency.empty()) frequencies = parse_axis("--frequency", frequency);
    write_best_gains(context, frequencies, options, both_gains);
  }

  /// Writes gains for the whole family over the band, or at the frequency of the case.
  void serve_family(const Job& job, const JobContext& context) const {
    if (!frequency.empty()) throw WrongInput("--family works with --band, not with --frequency");
    Range range;
    if (band.empty())
      range.min = range.max = excitation_of(context.case_data).frequency;
    else
      range = parse_range("--band", band);
    write_family_gains(context,
                       {{range.min, range.max},
                        largest_radius,
                        margin,
                        largest_ratio,
                        both_gains,
                        prove,
                        schedule,
                        job.draws()},
                       [&](const std::vector<std::string>& overrides) {
                         return job.context_with(context, overrides);
                       });
  }
};

}  // namespace

void add_design(CLI::App& program) { add_job<DesignQuestion>(program, "design"); }

}  // namespace holdfast::program
