#include "case/model/held_force.hpp"

#include <cmath>

#include "case/model/modal/modal_plant_of_case.hpp"
#include "text/text.hpp"

namespace holdfast::program {

double held_share(const Case& the_case, double sampling_period, double frequency) {
  if (force_hold_of(the_case) == ForceHold::exact || !(excitation_of(the_case).amplitude > 0.0))
    return 1.0;
  const double omega = 2.0 * pi<double> * frequency;
  return steady_response_of(the_case, {sampling_period}, ForceHold::sampled, omega)
             .uncontrolled_amplitude_per_force() /
         true_amplitude_of(the_case, omega);
}

std::string held_force_warning(const Case& the_case, double sampling_period, double frequency,
                               const std::string& shown) {
  constexpr double noticeable = 0.02;
  const double share = held_share(the_case, sampling_period, frequency);
  if (std::abs(share - 1.0) <= noticeable) return "";
  return "held over samples of " + format_rounded(sampling_period) +
         " s (excitation.hold = \"sampled\") the force of " + format_rounded(frequency) +
         " Hz would give " + format_rounded(share) +
         " times the amplitude without control that the true force gives; " + shown;
}

std::string held_force_warning(const Case& the_case, const std::string& shown) {
  return held_force_warning(the_case, the_case.control.sampling_period,
                            excitation_of(the_case).frequency, shown);
}

}  // namespace holdfast::program
