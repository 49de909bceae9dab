#include "loop_of_case.hpp"

namespace holdfast::program {
namespace {

SampledMotion<double> motion_with(const Case& the_case, const PdGains<double>& gains,
                                  double backlash_width) {
  const SampledLoop<double> loop = loop_of(the_case);
  const HarmonicExcitation<double> excitation = excitation_of(the_case);
  const HarmonicInput<double> input = harmonic_input(
      plant_of(the_case), loop, force_hold_of(the_case), excitation.angular_frequency());
  return {
      loop, gains, input, excitation, Backlash<double>(backlash_width), initial_state_of(the_case)};
}

}  // namespace

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

SampledMotion<double> motion_of(const Case& the_case) {
  return motion_with(the_case, gains_of(the_case), the_case.backlash.width);
}

SampledMotion<double> uncontrolled_motion_of(const Case& the_case) {
  return motion_with(the_case, {0.0, 0.0}, 0.0);
}

}  // namespace holdfast::program
