#include "case/model/modal_plant_of_case.hpp"

#include <algorithm>
#include <cmath>

#include "case/model/cable_of_case.hpp"
#include "case/model/loop_of_case.hpp"
#include "holdfast/math/linalg/spectral_radius.hpp"
#include "holdfast/plant/modal_plant.hpp"
#include "holdfast/stability/response/loop_roots.hpp"
#include "holdfast/stability/response/modal_steady_response.hpp"
#include "io/text/text.hpp"
#include "process/errors.hpp"
#include "process/interrupt.hpp"

namespace holdfast::program {
namespace {

/// Of what is chosen.
constexpr int fewest_modes = 60, most_modes = 300;

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

/// Σ φ²/M (1/kg): the place with its clamp off starts under a newton as one over it would.
double mobility_of(const std::vector<PlaceMode<double>>& modes) {
  double sum = 0.0;
  for (const PlaceMode<double>& mode : modes) sum += mode.shape * mode.shape / mode.mass;
  return sum;
}

/// All modes of the string, `apart` of them on their own.
std::vector<PlaceMode<double>> all_modes_of(const Case& the_case, int apart) {
  const TautString<double> string = string_of(the_case);
  // Beyond, what is left out is felt by no clamp: it passes many times within a sample.
  const double highest =
      std::max(100.0 / the_case.control.sampling_period, 10.0 * string.angular_frequency(apart));
  return bundled_string_modes(string, the_case.absorber.position, apart, highest);
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

const char* const coinciding_motions =
    "two natural motions of conductor and absorber coincide too nearly to be told apart: change "
    "plant.absorber_damping or absorber.position by a thousandth";

bool is_modal(const Case& the_case) { return the_case.plant.model != "two_masses"; }

TautString<double> string_of(const Case& the_case) {
  TautString<double> string = taut_string(conductor_of(the_case));
  if (std::isfinite(the_case.conductor.tension)) string.tension = the_case.conductor.tension;
  string.bending_stiffness = the_case.conductor.bending_stiffness;
  return string;
}

int modes_of(const Case& the_case) {
  if (std::isfinite(the_case.plant.modes)) return static_cast<int>(the_case.plant.modes);
  const double seen = std::max(0.5 / the_case.control.sampling_period,
                               2.0 * effective_excitation(the_case).frequency);
  return std::clamp(first_above(string_of(the_case), seen, most_modes), fewest_modes, most_modes);
}

std::vector<PlaceMode<double>> place_modes_of(const Case& the_case) {
  const int modes = modes_of(the_case);
  if (!std::isfinite(the_case.plant.modes)) return all_modes_of(the_case, modes);
  return string_modes(string_of(the_case), the_case.absorber.position, modes);
}

Absorber<double> absorber_of(const Case& the_case) {
  const auto& plant = the_case.plant;
  return {plant.absorber_mass, plant.absorber_stiffness, plant.absorber_damping,
          the_case.absorber.clamp_mass};
}

LinearPlant<double> modal_plant_of(const Case& the_case) {
  return modal_plant(place_modes_of(the_case), absorber_of(the_case));
}

std::vector<PlantPole> poles_of(const Case& the_case) {
  std::vector<PlantPole> poles = plant_poles(place_modes_of(the_case), absorber_of(the_case));
  if (poles.empty()) throw NoAnswer(coinciding_motions);
  return poles;
}

namespace {

ModalResponse<double> response_of(const Case& the_case,
                                  const std::vector<PlaceMode<double>>& modes) {
  throw_if_interrupted();
  auto response = modal_response(modes, absorber_of(the_case), sampling_of(the_case));
  throw_if_interrupted();
  return response;
}

}  // namespace

ResolvedCircle<double> circle_of(const Case& the_case) {
  return ResolvedCircle<double>(response_of(the_case, place_modes_of(the_case)));
}

ModalRadius::ModalRadius(const Case& the_case)
    : case_(the_case), response_(response_of(the_case, place_modes_of(the_case))) {}

double ModalRadius::operator()(const PdGains<double>& gains) {
  const std::complex<double> root = largest_loop_root(response_, gains);
  if (std::abs(root) > 0.0) return std::abs(root);
  if (!map_) map_ = loop_map(modal_plant_of(case_), sampling_of(case_));
  return spectral_radius(map_->closed_map(gains));
}

std::complex<double> largest_root_of(const Case& the_case, const PdGains<double>& gains) {
  return largest_loop_root(response_of(the_case, place_modes_of(the_case)), gains);
}

bool is_stable_with_clamp(const Case& the_case, double clamp_mass) {
  Case changed = the_case;
  changed.absorber.clamp_mass = clamp_mass;
  const auto modes = all_modes_of(changed, std::min(60, modes_of(changed)));
  const ModalResponse<double> response = response_of(changed, modes);
  const PdGains<double> gains = gains_of(changed);
  const double radius = std::abs(largest_loop_root(response, gains));
  if (std::isfinite(radius)) return radius < 1.0;
  return ResolvedCircle<double>(response).roots_outside(gains) == 0;
}

OtherModes other_modes_of(const Case& the_case) {
  const auto circle_by = [&](const std::vector<PlaceMode<double>>& modes) {
    return ResolvedCircle<double>(response_of(the_case, modes));
  };
  const int modes = modes_of(the_case);
  if (std::isfinite(the_case.plant.modes))
    return {circle_by(all_modes_of(the_case, modes)), "with all modes"};
  const int half = (modes + 1) / 2;
  return {circle_by(all_modes_of(the_case, half)),
          "with " + std::to_string(half) + " modes kept apart instead of " + std::to_string(modes)};
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
  const double end = frequency(string, modes), force = effective_excitation(the_case).frequency;
  const std::string faster =
      force > end ? "; the force, " + format_rounded(force) + " Hz, is faster than they" : "";
  const std::string kept =
      std::to_string(modes) + " modes of the conductor, up to " + format_rounded(end) + " Hz, ";
  if (!std::isfinite(the_case.plant.modes)) {
    const double returned = std::exp(-2.0 * pi<double> * string.damping_ratio * modes);
    if (returned < 0.05 && faster.empty()) return "";
    return kept +
           "are kept apart and the faster ones bundled, as if their waves did not come back" +
           (returned < 0.05 ? ""
                            : "; with the case's damping up to " +
                                  format_rounded(100.0 * returned) + " % of such a wave does") +
           faster;
  }
  const double cut_mass = 1.0 / mobility_of(place_modes_of(the_case));
  const double felt_mass =
      std::max(the_case.absorber.clamp_mass,
               (the_case.plant.absorber_damping + 2.0 * string.wave_impedance()) *
                   the_case.control.sampling_period / 2.0);
  const double half_rate = 0.5 / the_case.control.sampling_period;
  if (cut_mass < 0.02 * felt_mass && end > half_rate && faster.empty()) return "";
  return kept + "are kept and the faster ones left out: the drive feels that as " +
         format_rounded(1e3 * cut_mass) +
         " g more at the clamp, and gains may look stable far beyond where they are; without "
         "plant.modes all modes count" +
         faster;
}

}  // namespace holdfast::program
