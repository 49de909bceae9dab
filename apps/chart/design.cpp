#include <optional>
#include <string>

#include "case/axes/axis.hpp"
#include "case/model/plant_of_case.hpp"
#include "holdfast/control/gains.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "holdfast/stability/design/minimax_amplitude.hpp"
#include "holdfast/stability/design/minimum_amplitude.hpp"
#include "holdfast/stability/design/minimum_radius.hpp"
#include "holdfast/stability/design/minimum_radius_gains.hpp"
#include "io/text/names.hpp"
#include "io/text/table.hpp"
#include "io/text/text.hpp"
#include "job.hpp"
#include "process/errors.hpp"
#include "process/exit.hpp"
#include "process/interrupt.hpp"
#include "process/progress.hpp"

namespace holdfast::program {
namespace {

constexpr Named<MinimumAmplitudeOutcome> amplitude_names[] = {
    {MinimumAmplitudeOutcome::stationary, "stationary"},
    {MinimumAmplitudeOutcome::edge, "edge"},
    {MinimumAmplitudeOutcome::none, "none"},
    {MinimumAmplitudeOutcome::aliased, "aliased"}};

AmplitudeOptions options_of(const Case& the_case, double largest_radius) {
  return {sampling_of(the_case), force_hold_of(the_case), largest_radius};
}

std::string no_gain_text(double proportional_gain, double largest_radius) {
  return "at P = " + format_rounded(proportional_gain) +
         " N/m no D keeps the spectral radius below " + format_rounded(largest_radius);
}

/// Why a single row has no D of minimum amplitude.
void warn_of_no_gain(MinimumAmplitudeOutcome outcome, double proportional_gain,
                     double largest_radius, bool quiet) {
  if (outcome == MinimumAmplitudeOutcome::none)
    report_warning(no_gain_text(proportional_gain, largest_radius), quiet);
  if (outcome == MinimumAmplitudeOutcome::aliased)
    report_warning(
        "the excitation frequency is not below half the sampling rate: its samples do "
        "not show the vibration",
        quiet);
}

/// The best D at each frequency, P tuned to each by Eq. 6; without frequencies at the case's own
/// frequency and P.
void write_best_gains(const JobContext& context, const std::optional<Axis>& frequencies,
                      double largest_radius) {
  const Case& the_case = context.case_data;
  const TwoMass<double> plant = plant_of(the_case);
  const auto loop = sampled_loop(plant, sampling_of(the_case));
  const double own = excitation_of(the_case).frequency;
  const Axis axis = frequencies.value_or(Axis{own, own, 1});
  Table table(
      context,
      {{"frequency_Hz", "Hz", "excitation frequency f"},
       {"proportional_gain", "N/m", "P: of the case, or tuned by Eq. 6 with --frequency"},
       {"least_amplitude_gain", "N.s/m", "D of least steady amplitude without backlash"},
       {"ratio_to_uncontrolled", "", "the amplitude it leaves over that without control"},
       {"attenuation_dB", "dB", "-20 log10 of that ratio"},
       {"least_radius_gain", "N.s/m", "D of least spectral radius"},
       {"least_radius", "", "the spectral radius it gives; stable below 1"},
       {"least_amplitude_at", "",
        "stationary: amid the admissible D; edge: a limit at their edge; none: no D is admissible; "
        "aliased: the samples do not show the vibration",
        "string"}});
  Progress progress(static_cast<std::uint64_t>(axis.count), "design", progress_wanted(context));
  for (std::int64_t i = 0; i < axis.count; ++i) {
    throw_if_interrupted();
    const double frequency = axis.at(i);
    const double p = frequencies ? tuned_proportional_gain(plant.absorber_stiffness,
                                                           plant.absorber_mass, frequency)
                                 : gains_of(the_case).proportional;
    const auto quietest =
        minimum_amplitude(plant, options_of(the_case, largest_radius), frequency, p);
    const MinimumRadius fastest = minimum_radius(loop, p);
    if (!frequencies) warn_of_no_gain(quietest.outcome, p, largest_radius, context.quiet);
    table.row(frequency, p, quietest.differential_gain, quietest.ratio_to_uncontrolled,
              quietest.attenuation, fastest.differential_gain, fastest.radius,
              name_in(amplitude_names, quietest.outcome));
    progress.advance();
  }
  table.commit();
}

/// The one D whose largest amplitude over a band of frequencies (Hz) is least, at the case's P.
void write_band_gain(const JobContext& context, const Range& band, double largest_radius) {
  const Case& the_case = context.case_data;
  const double p = gains_of(the_case).proportional;
  const auto answer = minimax_amplitude(plant_of(the_case), options_of(the_case, largest_radius), p,
                                        {band.min, band.max});
  if (answer.outcome == MinimaxOutcome::none) throw NoAnswer(no_gain_text(p, largest_radius));
  if (answer.outcome == MinimaxOutcome::not_converged)
    report_warning("the search has not closed: some D may have a worst ratio as small as " +
                       format_rounded(answer.lower_bound),
                   context.quiet);
  Table table(context,
              {{"frequency_min_Hz", "Hz", "lower end of the band"},
               {"frequency_max_Hz", "Hz", "upper end of the band"},
               {"proportional_gain", "N/m", "P of the case"},
               {"differential_gain", "N.s/m", "D whose largest amplitude over the band is least"},
               {"worst_ratio", "", "the largest amplitude over that without control"},
               {"worst_frequency_Hz", "Hz", "where it occurs"},
               {"attenuation_dB", "dB", "-20 log10 of the worst ratio"},
               {"lower_bound", "", "no admissible D has a smaller worst ratio"}});
  table.row(band.min, band.max, p, answer.differential_gain, answer.worst_ratio,
            answer.worst_frequency, answer.attenuation, answer.lower_bound);
  table.commit();
}

void write_best_pair(const JobContext& context) {
  const auto answer = minimum_radius_gains(loop_of(context.case_data));
  if (answer.outcome == MinimumRadiusGainsOutcome::idle)
    report_warning("the gains do not move all roots; P is set to 0", context.quiet);
  if (answer.outcome == MinimumRadiusGainsOutcome::open)
    report_warning("the search has not closed: better gains may exist", context.quiet);
  Table table(context, {{"proportional_gain", "N/m", "P of least spectral radius"},
                        {"differential_gain", "N.s/m", "D of least spectral radius"},
                        {"spectral_radius", "", "max |root| there; stable below 1"},
                        {"lower_bound", "", "no gains have a smaller spectral radius"}});
  table.row(answer.gains.proportional, answer.gains.differential, answer.radius,
            answer.lower_bound);
  table.commit();
}

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
