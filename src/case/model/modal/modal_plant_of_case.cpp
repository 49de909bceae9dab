#include "case/model/modal/modal_plant_of_case.hpp"

#include <algorithm>
#include <cmath>

#include "case/model/cable_of_case.hpp"
#include "case/model/loop_of_case.hpp"
#include "holdfast/math/linalg/spectral_radius.hpp"
#include "holdfast/plant/modal_plant.hpp"
#include "holdfast/stability/response/loop_roots.hpp"
#include "holdfast/stability/response/modal_steady_response.hpp"
#include "process/errors.hpp"
#include "process/interrupt.hpp"
#include "process/memo.hpp"

namespace holdfast::program {

Absorber<double> absorber_of(const Case& the_case) {
  const auto& plant = the_case.plant;
  return {plant.absorber_mass, plant.absorber_stiffness, plant.absorber_damping,
          the_case.absorber.clamp_mass};
}

LinearPlant<double> modal_plant_of(const Case& the_case) {
  return modal_plant(place_modes_of(the_case), absorber_of(the_case));
}

namespace {

/// All that the poles depend on.
std::vector<double> numbers_of(const std::vector<PlaceMode<double>>& modes,
                               const Absorber<double>& absorber) {
  std::vector<double> numbers = {absorber.mass, absorber.stiffness, absorber.damping,
                                 absorber.clamp_mass};
  numbers.reserve(4 * modes.size() + 4);
  for (const PlaceMode<double>& mode : modes)
    numbers.insert(numbers.end(),
                   {mode.angular_frequency, mode.damping_ratio, mode.shape, mode.mass});
  return numbers;
}

/// As `plant_poles`.
std::vector<PlantPole> remembered_poles(const std::vector<PlaceMode<double>>& modes,
                                        const Absorber<double>& absorber) {
  constexpr std::size_t enough = 64;
  static Memo<std::vector<double>, std::vector<PlantPole>> memo(enough);
  return memo.of(numbers_of(modes, absorber), [&] { return plant_poles(modes, absorber); });
}

ModalResponse<double> response_of(const Case& the_case,
                                  const std::vector<PlaceMode<double>>& modes) {
  throw_if_interrupted();
  const Absorber<double> absorber = absorber_of(the_case);
  auto response =
      modal_response(modes, absorber, remembered_poles(modes, absorber), sampling_of(the_case));
  throw_if_interrupted();
  return response;
}

}  // namespace

std::vector<PlantPole> poles_of(const Case& the_case) {
  std::vector<PlantPole> poles = remembered_poles(place_modes_of(the_case), absorber_of(the_case));
  if (poles.empty())
    throw NoAnswer(
        "two natural motions of conductor and absorber coincide too nearly to be told apart: "
        "change plant.absorber_damping or absorber.position by a thousandth");
  return poles;
}

void require_natural_motions(const Case& the_case) { static_cast<void>(poles_of(the_case)); }

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
  constexpr int enough = 60;
  const auto modes = all_conductor_modes_of(changed, enough).modes;
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
  const ConductorModes kept = conductor_modes_of(the_case);
  if (std::isfinite(the_case.plant.modes))
    return {circle_by(finer_modes_of(the_case, kept).modes), "with all modes"};
  const ConductorModes other = coarser_modes_of(the_case, kept);
  const std::string fewer_bars =
      is_cable(the_case) ? " and " + std::to_string(other.bars) + " bars" : "";
  return {circle_by(other.modes),
          "with " + std::to_string(other.apart) + " modes kept apart" + fewer_bars +
              " instead of " + std::to_string(kept.apart) +
              (fewer_bars.empty() ? "" : " and " + std::to_string(kept.bars))};
}

SteadyResponse<double> steady_response_of(const Case& the_case, const Sampling<double>& sampling,
                                          ForceHold hold, double angular_frequency) {
  if (!is_modal(the_case))
    return steady_response(plant_of(the_case), sampling, hold, angular_frequency);
  const auto modes = place_modes_of(the_case);
  const Absorber<double> absorber = absorber_of(the_case);
  return steady_response(modes, absorber, remembered_poles(modes, absorber), sampling, hold,
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

void require_sweepable(const Case& the_case, Switching switching) {
  if (is_modal(the_case) && !is_of_the_paper(the_case, switching))
    throw WrongInput("of plant.model = \"" + the_case.plant.model +
                     "\" motions are swept in the paper's model alone: switching at samples, its "
                     "law of the backlash, one harmonic, an ideal computer");
}

ModalLoop swept_loop_of(const Case& the_case, Switching switching) {
  require_sweepable(the_case, switching);
  require_natural_motions(the_case);
  return modal_loop_of(the_case);
}

ImplementedLoopOf<LinearPlant<double>> modal_implemented_loop_of(const Case& the_case,
                                                                 Switching switching) {
  const ImplementedLoop loop = implemented_loop_of(the_case, switching);
  return {modal_plant_of(the_case), loop.digital, loop.backlash, loop.switching};
}

ImplementedLoopOf<ControlledPlant> controlled_conductor_of(const Case& the_case,
                                                           Switching switching) {
  const ImplementedLoop loop = implemented_loop_of(the_case, switching);
  if (!is_ideal(loop.digital.limits))
    throw WrongInput("of plant.model = \"" + the_case.plant.model +
                     "\" orbits, exponents and verdicts are of a computer without quanta, limits "
                     "of its force and differences");
  ImplementedLoopOf<ControlledPlant> own{
      with_controller(modal_plant_of(the_case), loop.digital.gains), loop.digital, loop.backlash,
      loop.switching};
  own.digital.gains = {0.0, 0.0};
  return own;
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

}  // namespace holdfast::program
