#include "case/model/conditioning.hpp"

#include <algorithm>
#include <cmath>

#include "case/model/cable_of_case.hpp"
#include "case/model/linear_loop.hpp"
#include "case/model/loop_of_case.hpp"
#include "case/model/modal/modal_plant_of_case.hpp"
#include "case/model/resolved_plant.hpp"
#include "holdfast/orbit/loop_orbit.hpp"
#include "text/text.hpp"

namespace holdfast::program {

std::string sensitive_reduction_warning(const Case& the_case) {
  const ReductionResult result = reduction_of(the_case);
  const ReducedMasses& taken = result.solutions[0];
  if (result.outcome != ReductionOutcome::double_solution && !taken.is_ill_conditioned()) return "";
  return "the reduction to two masses has two nearly equal solutions (discriminant " +
         format_rounded(result.discriminant) +
         "): an error of 1 % in k1, m2 and the two frequencies may become " +
         format_rounded(taken.stiffness_condition) + " % in k2 and " +
         format_rounded(taken.mass_condition) + " % in m1";
}

std::string near_border_warning(double border_share) {
  if (!(border_share < near_border)) return "";
  return "the orbit passes a switching surface at a distance of " + format_rounded(border_share) +
         " of the orbit's size: a parameter that changes by this share may destroy the orbit";
}

std::string shifted_copies_warning(std::int64_t period, std::int64_t coincidence) {
  const std::int64_t copies = period / coincidence;
  if (copies < 2) return "";
  return "the orbit has " + std::to_string(copies) + " copies, shifted in time by " +
         std::to_string(coincidence) +
         " samples each: motions that settle on different copies stay apart, although every copy "
         "is stable; holdfast deviation compares two motions";
}

std::string open_sign_warning(const LyapunovResult& result) {
  if (result.sign_is_known()) return "";
  return "the largest exponent, " + format_rounded(result.exponents[0]) + " per sample with the " +
         "standard error " + format_rounded(result.standard_errors[0]) +
         ", may be zero: a longer --duration may show its sign";
}

std::string stepped_reading_warning(const Case& the_case) {
  const auto& control = the_case.control;
  if (control.displacement_quantum == 0.0 && control.velocity_quantum == 0.0) return "";
  return "control.displacement_quantum or control.velocity_quantum rounds the readings to steps: "
         "the exponents hold only for motions closer than one step; holdfast deviation compares "
         "motions farther apart";
}

std::string short_average_warning(const Case& the_case, double averaged) {
  constexpr double least_periods = 20.0;
  const double periods = averaged * effective_excitation(the_case).frequency;
  if (!(periods < least_periods)) return "";
  return "the exponents are averaged over only " + format_rounded(periods) +
         " forcing periods: averages over fewer than 20 describe the transient, not the settled "
         "motion; give a longer --duration";
}

double settling_time(double radius, double sampling_period) {
  return std::log(20.0) * sampling_period / -std::log(radius);
}

std::string transient_warning(const Case& the_case, double duration) {
  if (is_two_masses(the_case) || the_case.own) return "";
  const double radius = LinearLoop(the_case).radius(gains_of(the_case));
  const double settling = settling_time(radius, the_case.control.sampling_period);
  if (!(radius < 1.0 && settling > 0.5 * duration)) return "";
  return "a motion of this loop takes " + format_rounded(settling) +
         " s to settle: steady values from the second half of " + format_rounded(duration) +
         " s still contain transients; give a longer --duration, or ask holdfast response";
}

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
  return "excitation.hold = \"sampled\": held over " + format_rounded(sampling_period) +
         " s, the force of " + format_rounded(frequency) + " Hz gives " + format_rounded(share) +
         " times the amplitude of the continuous force, both without control; " + shown;
}

std::string held_force_warning(const Case& the_case, const std::string& shown) {
  return held_force_warning(the_case, the_case.control.sampling_period,
                            excitation_of(the_case).frequency, shown);
}

}  // namespace holdfast::program
