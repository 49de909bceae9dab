#include "loop_of_case.hpp"

#include "case_keys.hpp"

namespace holdfast::program {
TwoDof<double> plant_of(const Case& the_case) {
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

LoopPoint loop_point_of(const Case& the_case) {
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

ForcedLoop<double> forced_loop_of(const Case& the_case) {
  return {plant_of(the_case),      sampling_of(the_case),   gains_of(the_case),
          excitation_of(the_case), the_case.backlash.width, force_hold_of(the_case)};
}

ForcedLoop<double> forced_loop_with(const Case& the_case, const std::string& key, double value) {
  Case changed = the_case;
  set_case_value(changed, key, value);
  check_case(changed);
  return forced_loop_of(changed);
}

SampledMotion<double> motion_of(const Case& the_case) {
  return harmonically_forced_motion(forced_loop_of(the_case), initial_state_of(the_case));
}

ForcedLoop<double> uncontrolled(ForcedLoop<double> loop) {
  loop.gains = {0.0, 0.0};
  loop.backlash_width = 0.0;
  return loop;
}

SampledMotion<double> uncontrolled_motion_of(const Case& the_case) {
  return harmonically_forced_motion(uncontrolled(forced_loop_of(the_case)),
                                    initial_state_of(the_case));
}

}  // namespace holdfast::program
