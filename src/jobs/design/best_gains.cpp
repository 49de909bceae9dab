#include "jobs/design/best_gains.hpp"

#include <cmath>

#include "case/model/plant_of_case.hpp"
#include "holdfast/sweep/sweep_motion.hpp"
#include "jobs/design/gain_margins.hpp"
#include "process/interrupt.hpp"

namespace holdfast::program {
namespace {

bool have_one_answer(const IdealLoop<double>& one, const IdealLoop<double>& other) {
  return numbers_of(one.plant) == numbers_of(other.plant) &&
         one.sampling.period == other.sampling.period &&
         one.sampling.processing_delay == other.sampling.processing_delay &&
         one.gains.proportional == other.gains.proportional &&
         one.excitation.frequency == other.excitation.frequency && one.hold == other.hold;
}

}  // namespace

const MinimumAmplitude& BestGains::of(const IdealLoop<double>& loop) {
  // Neighbours in a sweep often differ in nothing that the gain depends on.
  if (!known_ || !have_one_answer(*known_, loop)) {
    const double radius = std::exp(-10.0 * loop.sampling.period / duration_);
    answer_ = minimum_amplitude(loop.plant, {loop.sampling, loop.hold, radius, usual_margin, true},
                                loop.excitation.frequency, loop.gains.proportional);
    known_ = loop;
  }
  return answer_;
}

MaxDelayOptions tuned_delay_question(const Case& the_case, double frequency) {
  const TwoMass<double> plant = plant_of(the_case);
  MaxDelayOptions question;
  question.watch = throw_if_interrupted;
  question.criterion = DelayCriterion::attenuates;
  question.hold = force_hold_of(the_case);
  question.delay_fraction = the_case.control.processing_delay / the_case.control.sampling_period;
  question.frequency = frequency;
  question.proportional_gain =
      tuned_proportional_gain(plant.absorber_stiffness, plant.absorber_mass, frequency);
  return question;
}

}  // namespace holdfast::program
