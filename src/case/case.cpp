#include "case/case.hpp"

#include "io/text/text.hpp"

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

std::string wind_warning(const Case& the_case) {
  if (!the_case.wind) return {};
  const double frequency = effective_excitation(the_case).frequency;
  if (frequency >= 3.0 && frequency <= 150.0) return {};
  const std::string found = "the wind sheds vortices at " + format_number(frequency) +
                            " Hz, outside the 3 to 150 Hz of aeolian vibration: ";
  if (frequency < 3.0)
    return found + "so slow a force is a breeze that sways the whole span, not one loop of it";
  return found + "so fast a vibration is damped by the conductor itself";
}

double resolved_proportional_gain(const Case& the_case) {
  if (!the_case.control.proportional_gain_tuned) return the_case.control.proportional_gain;
  constexpr double pi = 3.14159265358979323846;
  const double omega = 2.0 * pi * effective_excitation(the_case).frequency;
  return the_case.plant.absorber_stiffness - the_case.plant.absorber_mass * omega * omega;
}

}  // namespace holdfast::program
