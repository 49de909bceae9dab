#include "case/model/modal/modal_plant_of_case.hpp"

#include <algorithm>
#include <cmath>

#include "case/model/cable_of_case.hpp"
#include "case/model/loop_of_case.hpp"
#include "case/model/own/own_parts.hpp"
#include "case/model/span/span_loop.hpp"
#include "case/needed.hpp"
#include "holdfast/control/late_controller.hpp"
#include "holdfast/plant/loop_hardware.hpp"
#include "holdfast/plant/modal_plant.hpp"
#include "holdfast/stability/response/modal_response.hpp"
#include "holdfast/stability/response/modal_steady_response.hpp"
#include "process/errors.hpp"
#include "process/interrupt.hpp"
#include "process/memo.hpp"
#include "text/text.hpp"

namespace holdfast::program {

void require_absorber(const Case& the_case) {
  if (has_absorber(the_case)) return;
  require_keys(the_case, {"plant.absorber_mass"});
  const auto place = the_case.places.find("plant.absorber_mass");
  const bool in_file = place != the_case.places.end() && place->second.rfind("--set", 0) != 0;
  throw WrongInput((in_file ? place->second + ": " : "") +
                   "plant.absorber_mass = 0: this job needs an absorber: set a mass above 0 kg");
}

Absorber<double> absorber_of(const Case& the_case) {
  const auto& plant = the_case.plant;
  require_absorber(the_case);
  require_keys(the_case, {"plant.absorber_stiffness", "plant.absorber_damping"});
  // The clamp of a string without ends is the mass of its mode; two masses have no clamp.
  const bool clamped = !is_two_masses(the_case) && !is_infinite(the_case);
  return {plant.absorber_mass, plant.absorber_stiffness, plant.absorber_damping,
          clamped ? the_case.absorber.clamp_mass : 0.0};
}

LoopHardware hardware_of(const Case& the_case) {
  const auto& control = the_case.control;
  return {control.measurement_filter, control.drive_bandwidth, control.drive_damping,
          control.velocity == "measured"};
}

namespace {

/// All numbers on which the poles depend.
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

/// The result of `plant_poles`, cached.
std::vector<PlantPole> remembered_poles(const std::vector<PlaceMode<double>>& modes,
                                        const Absorber<double>& absorber) {
  constexpr std::size_t enough = 64;
  static Memo<std::vector<double>, std::vector<PlantPole>> memo(enough);
  return memo.of(numbers_of(modes, absorber), [&] { return plant_poles(modes, absorber); });
}

/// The conductor with absorber. Its poles include devices on the span; its modes do not.
ConductorWithAbsorber conductor_by(const Case& the_case, const ConductorModes& conductor) {
  const Absorber<double> absorber = absorber_of(the_case);
  auto poles = the_case.devices.empty() ? remembered_poles(conductor.modes, absorber)
                                        : poles_with_devices(the_case, conductor, absorber);
  return {conductor.modes, absorber, std::move(poles), hardware_of(the_case),
          !the_case.devices.empty()};
}

/// The poles without the drift of a string without ends, which the drive does not excite.
std::vector<PlantPole> without_drift(const Case& the_case, std::vector<PlantPole> poles) {
  if (!is_infinite(the_case)) return poles;
  const double slow = 1e-11 / the_case.control.sampling_period;
  poles.erase(std::remove_if(poles.begin(), poles.end(),
                             [&](const PlantPole& pole) { return std::abs(pole.s) < slow; }),
              poles.end());
  return poles;
}

ModalResponse<double> response_of(const Case& the_case, const ConductorModes& modes) {
  throw_if_interrupted();
  ConductorWithAbsorber conductor = conductor_by(the_case, modes);
  conductor.poles = without_drift(the_case, std::move(conductor.poles));
  auto response = modal_response(conductor, sampling_of(the_case));
  throw_if_interrupted();
  return response;
}

/// Calls `visit` with the controller: P and D with limits and delay, or a user-defined one.
template <class Visit>
auto with_law_of(const Case& the_case, bool controlled, const Visit& visit) {
  const DigitalLoop digital = implemented_loop_of(the_case, Switching::sampled).digital;
  if (the_case.own != nullptr && the_case.own->controller)
    return visit(own_law_of(the_case, controlled));
  return visit(late_controller(controlled ? digital.gains : PdGains<double>{}, digital.limits,
                               digital.sampling));
}

}  // namespace

ConductorWithAbsorber conductor_with_absorber_of(const Case& the_case) {
  if (has_own_plant(the_case))
    throw WrongInput("this job cannot use a plant of your own: give [conductor] and [absorber]");
  ConductorWithAbsorber conductor = conductor_by(the_case, conductor_modes_of(the_case));
  if (conductor.poles.empty())
    throw NoAnswer(
        "two poles of conductor and absorber nearly coincide and cannot be separated: "
        "change plant.absorber_damping or absorber.position by a thousandth");
  if (with_hardware(conductor.poles, conductor.hardware).empty())
    throw NoAnswer(
        "a pole of conductor and absorber nearly coincides with a pole of filter or drive: change "
        "control.measurement_filter or control.drive_bandwidth by a thousandth");
  return conductor;
}

std::vector<PlantPole> loop_poles_of(const Case& the_case) {
  if (has_own_plant(the_case)) return poles_of(modal_plant_of(the_case));
  const ConductorWithAbsorber conductor = conductor_with_absorber_of(the_case);
  return with_hardware(without_drift(the_case, conductor.poles), conductor.hardware);
}

LinearPlant<double> modal_plant_of(const Case& the_case) {
  if (has_own_plant(the_case)) return with_hardware(*the_case.own->plant, hardware_of(the_case));
  if (!the_case.devices.empty())
    throw NoAnswer("this job cannot include devices: remove the [[device]] tables");
  return linear_plant(ConductorWithAbsorber{
      conductor_modes_of(the_case).modes, absorber_of(the_case), {}, hardware_of(the_case)});
}

ModalResponse<double> command_response_of(const Case& the_case) {
  if (!has_own_plant(the_case)) return response_of(the_case, conductor_modes_of(the_case));
  return ModalResponse<double>(modal_plant_of(the_case), sampling_of(the_case))
      .with_sensor(hardware_of(the_case).has_velocity_sensor);
}

std::complex<double> largest_root_of(const Case& the_case, const PdGains<double>& gains) {
  return largest_loop_root(command_response_of(the_case), gains);
}

/// Number of single modes with which all modes of a conductor are modelled; others are bundled.
constexpr int enough = 60;

bool is_stable_with_clamp(const Case& the_case, double clamp_mass) {
  Case changed = the_case;
  changed.absorber.clamp_mass = clamp_mass;
  const ModalResponse<double> response =
      response_of(changed, all_conductor_modes_of(changed, enough));
  return loop_excess_or_turn(response, gains_of(changed)) < 0.0;
}

OtherModes other_modes_of(const Case& the_case) {
  if (has_own_plant(the_case))
    return {UnitCircleCrossings<double>(command_response_of(the_case)), "with all modes"};
  const auto circle_by = [&](const ConductorModes& modes) {
    return UnitCircleCrossings<double>(response_of(the_case, modes));
  };
  const ConductorModes kept = conductor_modes_of(the_case);
  if (std::isfinite(the_case.plant.modes))
    return {circle_by(all_conductor_modes_of(the_case, std::max(kept.apart, enough))),
            "with all modes"};
  ConductorModes other = has_chosen_modes(the_case) ? judged_modes_of(the_case) : kept;
  if (other.apart == kept.apart) other = coarser_modes_of(the_case, kept);
  const std::string fewer_bars =
      is_cable(the_case) ? " and " + std::to_string(other.bars) + " bars" : "";
  return {circle_by(other), "with " + std::to_string(other.apart) + " modes computed singly" +
                                fewer_bars + " instead of " + std::to_string(kept.apart) +
                                (fewer_bars.empty() ? "" : " and " + std::to_string(kept.bars))};
}

namespace {

JudgedLoop loop_on_string(Case the_case, ConductorModes (*modes_of)(const Case&)) {
  the_case.plant.model = "string";
  the_case.plant.modes = std::nan("");
  const ConductorModes modes = modes_of(the_case);
  return {UnitCircleCrossings<double>(response_of(the_case, modes)), modes.apart,
          modes.highest_frequency()};
}

}  // namespace

JudgedLoop judged_loop_of(const Case& the_case) {
  return loop_on_string(the_case, judged_modes_of);
}

JudgedLoop cut_loop_of(const Case& the_case) { return loop_on_string(the_case, cut_modes_of); }

bool has_chosen_modes(const Case& the_case) {
  return the_case.plant.model == "string" && !std::isfinite(the_case.plant.modes) &&
         !has_own_plant(the_case);
}

std::string judged_otherwise(const Case& the_case) {
  if (!has_chosen_modes(the_case)) return "";
  const JudgedLoop loop = judged_loop_of(the_case);
  if (loop.is_stable(gains_of(the_case))) return "";
  return "with " + std::to_string(loop.modes) + " modes of the conductor, up to " +
         format_rounded(loop.highest) + " Hz, the loop is unstable, but it is stable with the " +
         std::to_string(conductor_modes_of(the_case).apart) + " modes used here";
}

namespace {

/// The conductor with its poles, if they are found; with devices a missing pole is an error.
ConductorWithAbsorber placed_conductor_of(const Case& the_case) {
  return the_case.devices.empty() ? conductor_by(the_case, conductor_modes_of(the_case))
                                  : conductor_with_absorber_of(the_case);
}

}  // namespace

SteadyResponse<double> steady_response_of(const Case& the_case, const Sampling<double>& sampling,
                                          ForceHold hold, double angular_frequency) {
  if (has_closed_forms(the_case))
    return steady_response(plant_of(the_case), sampling, hold, angular_frequency);
  if (has_own_plant(the_case)) {
    const auto response =
        steady_response(modal_plant_of(the_case), sampling, hold, angular_frequency);
    return hardware_of(the_case).has_velocity_sensor
               ? response
               : response.with_velocity_by_difference(angular_frequency * sampling.period,
                                                      sampling.period);
  }
  return steady_response(placed_conductor_of(the_case), sampling, hold, angular_frequency);
}

double true_amplitude_of(const Case& the_case, double angular_frequency) {
  if (is_two_masses(the_case))
    return true_amplitude_per_force(plant_of(the_case), angular_frequency);
  if (has_own_plant(the_case))
    return true_amplitude_per_force(modal_plant_of(the_case), angular_frequency);
  return true_amplitude_per_force(placed_conductor_of(the_case), angular_frequency);
}

ImplementedLoopOf<ControlledPlant> conductor_loop_of(const Case& the_case,
                                                     const MotionChoice& choice) {
  if (is_infinite(the_case) && !(the_case.absorber.clamp_mass > 0.0))
    throw WrongInput("a string without ends adds no inertia: give absorber.clamp_mass above 0 kg");
  const ImplementedLoop loop = implemented_loop_of(the_case, choice.switching);
  const Sampling<double>& sampling = loop.digital.sampling;
  ImplementedLoopOf<ControlledPlant> own{
      with_law_of(the_case, choice.controlled,
                  [&](const auto& law) { return with_controller(modal_plant_of(the_case), law); }),
      loop.digital, loop.backlash, choice.switching};
  own.digital.sampling = within_sample(sampling);
  own.digital.gains = {0.0, 0.0};
  own.digital.limits = {};
  if (!choice.controlled) own.backlash = {ContactLaw::none};
  return own;
}

Vector<double, Eigen::Dynamic> modal_state_of(const Case& the_case, const Vector<double, 4>& seen) {
  const bool own = has_own_plant(the_case);
  const Vector<double, Eigen::Dynamic> conductor =
      own ? the_case.own->state : modal_state(conductor_modes_of(the_case).modes, seen);
  const double read =
      own ? the_case.own->plant->connections.measured_displacement.dot(conductor) : seen[0];
  const Eigen::Index commands =
      with_law_of(the_case, true, [](const auto& law) { return detail::memory_size(law); });
  const detail::HardwarePoles lags(hardware_of(the_case));
  const auto drive = static_cast<Eigen::Index>(lags.drive.size());
  const auto filter = static_cast<Eigen::Index>(lags.filter.size());
  Vector<double, Eigen::Dynamic> state =
      Vector<double, Eigen::Dynamic>::Zero(conductor.size() + drive + filter + commands);
  state.head(conductor.size()) = conductor;
  state.segment(conductor.size() + drive, filter).setConstant(read);
  return state;
}

}  // namespace holdfast::program
