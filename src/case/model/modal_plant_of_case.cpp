#include "case/model/modal_plant_of_case.hpp"

#include <algorithm>
#include <cmath>

#include "case/model/cable_of_case.hpp"
#include "case/model/loop_of_case.hpp"
#include "holdfast/plant/modal_plant.hpp"
#include "holdfast/stability/response/modal_steady_response.hpp"
#include "io/text/text.hpp"
#include "process/errors.hpp"

namespace holdfast::program {
namespace {

constexpr int fewest_modes = 20, most_modes = 500;

/// Of mode n, Hz.
double frequency(const TautString<double>& string, int n) {
  return string.angular_frequency(n) / (2.0 * pi<double>);
}

/// The first mode above a frequency, Hz; at most one beyond `last`.
int first_above(const TautString<double>& string, double limit, int last) {
  int n = 1;
  while (n <= last && frequency(string, n) <= limit) ++n;
  return n;
}

/// What is given that nothing of the two masses depends on.
std::string idle_keys_warning(const Case& the_case) {
  std::string names;
  const auto add = [&](bool counts, const char* name) {
    if (counts) names += (names.empty() ? "" : ", ") + std::string(name);
  };
  add(the_case.absorber.clamp_mass > 0.0, "absorber.clamp_mass");
  add(the_case.conductor.bending_stiffness > 0.0, "conductor.bending_stiffness");
  add(std::isfinite(the_case.plant.modes), "plant.modes");
  if (names.empty()) return "";
  return names + ": the two masses do not depend on it; plant.model = \"string\" does";
}

}  // namespace

bool is_modal(const Case& the_case) { return the_case.plant.model != "two_masses"; }

TautString<double> string_of(const Case& the_case) {
  TautString<double> string = taut_string(conductor_of(the_case));
  if (std::isfinite(the_case.conductor.tension)) string.tension = the_case.conductor.tension;
  string.bending_stiffness = the_case.conductor.bending_stiffness;
  return string;
}

int modes_of(const Case& the_case) {
  if (std::isfinite(the_case.plant.modes)) return static_cast<int>(the_case.plant.modes);
  const double rate = 1.0 / the_case.control.sampling_period;
  return std::clamp(first_above(string_of(the_case), rate, most_modes), fewest_modes, most_modes);
}

std::vector<PlaceMode<double>> place_modes_of(const Case& the_case) {
  return string_modes(string_of(the_case), the_case.absorber.position, modes_of(the_case));
}

Absorber<double> absorber_of(const Case& the_case) {
  const auto& plant = the_case.plant;
  return {plant.absorber_mass, plant.absorber_stiffness, plant.absorber_damping,
          the_case.absorber.clamp_mass};
}

LinearPlant<double> modal_plant_of(const Case& the_case) {
  return modal_plant(place_modes_of(the_case), absorber_of(the_case));
}

ResolvedCircle<double> circle_of(const Case& the_case) {
  return ResolvedCircle<double>(
      modal_response(place_modes_of(the_case), absorber_of(the_case), sampling_of(the_case)));
}

SteadyResponse<double> steady_response_of(const Case& the_case, const Sampling<double>& sampling,
                                          ForceHold hold, double angular_frequency) {
  if (!is_modal(the_case))
    return steady_response(plant_of(the_case), sampling, hold, angular_frequency);
  return steady_response(place_modes_of(the_case), absorber_of(the_case), sampling, hold,
                         angular_frequency);
}

double true_amplitude_of(const Case& the_case, double angular_frequency) {
  if (!is_modal(the_case)) return true_amplitude_per_force(plant_of(the_case), angular_frequency);
  return true_amplitude_per_force(place_modes_of(the_case), absorber_of(the_case),
                                  angular_frequency);
}

ModalLoop modal_loop_of(const Case& the_case) {
  const IdealLoop<double> loop = ideal_loop_of(the_case);
  return {place_modes_of(the_case), absorber_of(the_case), loop.sampling, loop.gains,
          loop.excitation,          loop.backlash_width,   loop.hold};
}

ImplementedLoopOf<LinearPlant<double>> modal_implemented_loop_of(const Case& the_case,
                                                                 Switching switching) {
  const ImplementedLoop loop = implemented_loop_of(the_case, switching);
  return {modal_plant_of(the_case), loop.digital, loop.backlash, loop.switching};
}

Vector<double, Eigen::Dynamic> modal_state_of(const Case& the_case) {
  const auto modes = place_modes_of(the_case);
  const auto& initial = the_case.initial;
  const auto absorber = static_cast<Eigen::Index>(2 * modes.size());
  Vector<double, Eigen::Dynamic> state = Vector<double, Eigen::Dynamic>::Zero(absorber + 2);
  state(Eigen::seq(0, absorber - 2, 2)) = initial.z1 * bent_conductor(modes);
  state(Eigen::seq(1, absorber - 1, 2)) = initial.v1 * struck_conductor(modes);
  state[absorber] = initial.z2;
  state[absorber + 1] = initial.v2;
  return state;
}

void refuse_on_modes(const Case& the_case, bool given, const std::string& option) {
  if (given && is_modal(the_case))
    throw WrongInput(option + " goes with plant.model = \"two_masses\" alone");
}

std::string modes_warning(const Case& the_case) {
  if (!is_modal(the_case)) return idle_keys_warning(the_case);
  const TautString<double> string = string_of(the_case);
  const int modes = modes_of(the_case);
  const double half_rate = 0.5 / the_case.control.sampling_period;
  const std::string kept = std::to_string(modes) + " modes of the conductor are kept, up to " +
                           format_rounded(frequency(string, modes)) + " Hz: ";
  const std::string rate = "half the sampling rate, " + format_rounded(half_rate) + " Hz";
  const int seen = first_above(string, half_rate, modes) - 1;
  if (seen == modes)
    return kept + "they end below " + rate +
           ", and what the controller does to faster ones is not seen; plant.modes keeps more";
  if (!std::isfinite(the_case.plant.modes)) return "";
  return kept + "those from the " + std::to_string(seen + 1) + "th on lie above " + rate +
         ", and the computer sees them folded below it";
}

}  // namespace holdfast::program
