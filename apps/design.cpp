#include "holdfast/stability/design.hpp"
#include "axis.hpp"
#include "holdfast/control/gains.hpp"
#include "interrupt.hpp"
#include "job.hpp"
#include "loop_of_case.hpp"
#include "progress.hpp"
#include "table.hpp"

namespace holdfast::program {
namespace {

struct Options {
  std::string frequency;
};

void run(const JobContext& context, const Options& options) {
  const TwoDof<double> plant = plant_of(context.case_data);
  const double own = excitation_of(context.case_data).frequency;
  const Axis axis =
      options.frequency.empty() ? Axis{own, own, 1} : parse_axis("--frequency", options.frequency);
  Table table(context,
              {{"frequency_Hz", "Hz", "excitation frequency f"},
               {"proportional_gain", "N/m", "P: of the case, or tuned by Eq. 6 with --frequency"},
               {"least_amplitude_gain", "N.s/m",
                "stabilising D of least steady amplitude without backlash"},
               {"ratio_to_uncontrolled", "", "the amplitude it leaves over that without control"},
               {"attenuation_dB", "dB", "-20 log10 of that ratio"},
               {"least_radius_gain", "N.s/m", "D of least spectral radius"},
               {"least_radius", "", "the spectral radius it gives; stable below 1"}});
  Progress progress(static_cast<std::uint64_t>(axis.count), "design", progress_wanted(context));
  for (std::int64_t i = 0; i < axis.count; ++i) {
    throw_if_interrupted();
    const double frequency = axis.at(i);
    const double p =
        options.frequency.empty()
            ? gains_of(context.case_data).proportional
            : tuned_proportional_gain(plant.absorber_stiffness, plant.absorber_mass, frequency);
    const Design answer = design(plant, sampling_of(context.case_data),
                                 {frequency, p, force_hold_of(context.case_data)});
    table.row(frequency, p, answer.least_amplitude_gain, answer.ratio_to_uncontrolled,
              answer.attenuation, answer.least_radius_gain, answer.least_radius);
    progress.advance();
  }
  table.commit();
}

}  // namespace

void add_design(CLI::App& program) {
  const Job job(program, "design", question::gains,
                "The best D: of least amplitude and of least spectral radius");
  const auto options = std::make_shared<Options>();
  job->add_option("--frequency", options->frequency,
                  "Excitation frequencies, MIN:MAX:COUNT, Hz, P tuned to each by Eq. 6; without it "
                  "the frequency and P of the case");
  job->final_callback([job, options] { run(job.context(), *options); });
}

}  // namespace holdfast::program
