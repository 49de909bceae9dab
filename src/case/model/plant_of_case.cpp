#include "case/model/plant_of_case.hpp"

#include <limits>

#include "holdfast/excitation/recorded_force.hpp"
#include "holdfast/motion/trajectory.hpp"
#include "io/text/text.hpp"
#include "process/errors.hpp"

namespace holdfast::program {

TwoMass<double> plant_of(const Case& the_case) {
  const auto& plant = the_case.plant;
  return {plant.conductor_mass, plant.conductor_stiffness, plant.conductor_damping,
          plant.absorber_mass,  plant.absorber_stiffness,  plant.absorber_damping};
}

PdGains<double> gains_of(const Case& the_case) {
  return {resolved_proportional_gain(the_case), the_case.control.differential_gain};
}

Sampling<double> sampling_of(const Case& the_case) {
  return {the_case.control.sampling_period, the_case.control.processing_delay};
}

SampledLoop<double> loop_of(const Case& the_case) {
  return sampled_loop(plant_of(the_case), sampling_of(the_case));
}

OperatingPoint operating_point_of(const Case& the_case) {
  return {plant_of(the_case), sampling_of(the_case), gains_of(the_case)};
}

HarmonicExcitation<double> excitation_of(const Case& the_case) {
  const auto excitation = effective_excitation(the_case);
  return {excitation.amplitude, excitation.frequency};
}

ForceHold force_hold_of(const Case& the_case) {
  return effective_excitation(the_case).hold == "exact" ? ForceHold::exact : ForceHold::sampled;
}

Vector<double, 4> initial_state_of(const Case& the_case) {
  const auto& initial = the_case.initial;
  return {initial.z1, initial.v1, initial.z2, initial.v2};
}

double end_of_force(const Case& the_case) {
  return the_case.force_record ? the_case.force_record->last_time()
                               : std::numeric_limits<double>::infinity();
}

void require_bearable(double samples) {
  constexpr double most = 1e10;
  if (samples > most)
    throw NoAnswer("the motions would have " + format_rounded(samples) +
                   " samples, more than the " + format_rounded(most) +
                   " that are followed: a shorter duration or a longer control.sampling_period has "
                   "fewer");
}

std::int64_t samples_of(const Case& the_case, double duration) {
  const double end = end_of_force(the_case);
  if (duration > end) {
    throw WrongInput("the motion lasts " + format_number(duration) +
                     " s, but the force in excitation.record ends at " + format_number(end) + " s");
  }
  const std::int64_t samples = samples_within(duration, the_case.control.sampling_period);
  require_bearable(static_cast<double>(samples));
  return samples;
}

}  // namespace holdfast::program
