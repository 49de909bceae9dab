#include "case.hpp"

namespace holdfast::program {

case_tables::Excitation effective_excitation(const Case& the_case) {
  case_tables::Excitation force = the_case.excitation;
  if (!the_case.wind) return force;
  const case_tables::Wind& wind = *the_case.wind;
  force.frequency = wind.strouhal * wind.speed / wind.diameter;
  force.amplitude = 0.5 * wind.air_density * wind.speed * wind.speed * wind.diameter *
                    wind.effective_length * wind.lift_coefficient;
  return force;
}

double resolved_proportional_gain(const Case& the_case) {
  if (!the_case.control.proportional_gain_tuned) return the_case.control.proportional_gain;
  constexpr double pi = 3.14159265358979323846;
  const double omega = 2.0 * pi * effective_excitation(the_case).frequency;
  return the_case.plant.absorber_stiffness - the_case.plant.absorber_mass * omega * omega;
}

}  // namespace holdfast::program
