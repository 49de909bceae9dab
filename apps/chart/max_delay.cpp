#include "holdfast/stability/design/max_delay.hpp"
#include "case/axes/axis.hpp"
#include "case/model/plant_of_case.hpp"
#include "holdfast/control/gains.hpp"
#include "io/text/table.hpp"
#include "job.hpp"
#include "process/interrupt.hpp"
#include "process/progress.hpp"

namespace holdfast::program {
namespace {

struct MaxDelayArguments {
  std::string frequency = "3:60:58";
  std::string criterion = "attenuates";
};

MaxDelayOptions question_of(const Case& the_case, const MaxDelayArguments& options) {
  MaxDelayOptions question;
  question.criterion =
      options.criterion == "stable" ? DelayCriterion::stable : DelayCriterion::attenuates;
  question.hold = force_hold_of(the_case);
  question.delay_fraction = the_case.control.processing_delay / the_case.control.sampling_period;
  return question;
}

void run(const JobContext& context, const MaxDelayArguments& options) {
  const TwoMass<double> plant = plant_of(context.case_data);
  const Axis axis = parse_axis("--frequency", options.frequency);
  MaxDelayOptions question = question_of(context.case_data, options);
  Table table(context,
              {{"frequency_Hz", "Hz", "excitation frequency f"},
               {"proportional_gain", "N/m", "P, tuned to the frequency by Eq. 6"},
               {"max_sampling_period_s", "s", "every shorter period serves; inf: no limit found"},
               {"differential_gain", "N.s/m", "a D that serves at that period"}});
  Progress progress(static_cast<std::uint64_t>(axis.count), "max-delay", progress_wanted(context));
  for (std::int64_t i = 0; i < axis.count; ++i) {
    throw_if_interrupted();
    question.frequency = axis.at(i);
    question.proportional_gain =
        tuned_proportional_gain(plant.absorber_stiffness, plant.absorber_mass, question.frequency);
    const MaxDelay answer = max_sampling_period(plant, question);
    table.row(question.frequency, question.proportional_gain, answer.sampling_period,
              answer.differential_gain);
    progress.advance();
  }
  table.commit();
}

}  // namespace

void add_max_delay(CLI::App& program) {
  const Job job(
      program, "max-delay", question::delay,
      "Largest sampling period against excitation frequency, P tuned by Eq. 6; the processing "
      "delay keeps its fraction of the period");
  const auto options = std::make_shared<MaxDelayArguments>();
  job.add_text("--frequency", options->frequency, "Excitation frequencies, MIN:MAX:COUNT, Hz");
  job->add_option("--criterion", options->criterion,
                  "stable: some D stabilises; attenuates: some stabilising D beats no control")
      ->check(CLI::IsMember({"stable", "attenuates"}))
      ->capture_default_str();
  job->final_callback([job, options] { run(job.context(), *options); });
}

}  // namespace holdfast::program
