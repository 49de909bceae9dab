#include "case/model/plant_of_case.hpp"

#include <cmath>
#include <limits>

#include "case/needed.hpp"
#include "holdfast/excitation/recorded_force.hpp"
#include "holdfast/motion/trajectory.hpp"
#include "process/errors.hpp"
#include "text/text.hpp"

namespace holdfast::program {

namespace {

void require_two_masses(const Case& the_case) {
  // Missing keys of the reduction are reported first.
  if (the_case.conductor_given) require_keys(the_case, {"absorber.mass", "absorber.position"});
  require_keys(the_case,
               {"plant.conductor_mass", "plant.conductor_stiffness", "plant.conductor_damping",
                "plant.absorber_mass", "plant.absorber_stiffness", "plant.absorber_damping"});
}

/// The value, or `other` if the value is missing; for values on which the result does not depend.
double known_or(double other, double value) { return std::isnan(value) ? other : value; }

}  // namespace

TwoMass<double> plant_of(const Case& the_case) {
  if (is_two_masses(the_case))
    require_two_masses(the_case);
  else if (has_absorber(the_case) && !has_own_plant(the_case))
    require_keys(the_case, {"plant.absorber_stiffness", "plant.absorber_damping"});
  const auto& p = the_case.plant;
  return {known_or(1.0, p.conductor_mass),     known_or(1.0, p.conductor_stiffness),
          known_or(0.0, p.conductor_damping),  known_or(0.0, p.absorber_mass),
          known_or(1.0, p.absorber_stiffness), known_or(0.0, p.absorber_damping)};
}

PdGains<double> gains_of(const Case& the_case) {
  if (the_case.control.proportional_gain_tuned) {
    excitation_of(the_case);
    require_keys(the_case, {"plant.absorber_mass", "plant.absorber_stiffness"});
  }
  return {resolved_proportional_gain(the_case), the_case.control.differential_gain};
}

Sampling<double> sampling_of(const Case& the_case) {
  return {needed(the_case, "control.sampling_period"), the_case.control.processing_delay};
}

SampledLoop<double> loop_of(const Case& the_case) {
  return sampled_loop(plant_of(the_case), sampling_of(the_case));
}

OperatingPoint operating_point_of(const Case& the_case) {
  return {plant_of(the_case), sampling_of(the_case), gains_of(the_case)};
}

HarmonicExcitation<double> excitation_of(const Case& the_case) {
  const auto excitation = effective_excitation(the_case);
  if (!the_case.wind) require_keys(the_case, {"excitation.frequency"});
  return {excitation.amplitude, excitation.frequency};
}

HarmonicExcitation<double> motion_excitation_of(const Case& the_case) {
  const auto excitation = effective_excitation(the_case);
  if (excitation.amplitude > 0.0 || !std::isnan(excitation.frequency))
    return excitation_of(the_case);
  return {0.0, 1.0 / sampling_of(the_case).period};
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
    throw NoAnswer("the motions would take " + format_rounded(samples) +
                   " samples, more than the limit of " + format_rounded(most) +
                   ": give a shorter duration or a longer control.sampling_period");
}

std::int64_t samples_of(const Case& the_case, double duration) {
  const double end = end_of_force(the_case);
  if (duration > end) {
    throw WrongInput("the motion lasts " + format_number(duration) +
                     " s, but the force in excitation.record ends at " + format_number(end) +
                     " s: give a shorter duration or a longer record");
  }
  const std::int64_t samples = samples_within(duration, sampling_of(the_case).period);
  require_bearable(static_cast<double>(samples));
  return samples;
}

}  // namespace holdfast::program
