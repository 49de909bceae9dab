#include "case/model/own/own_parts.hpp"

#include <cmath>
#include <complex>
#include <string>

#include "case/model/loop_of_case.hpp"
#include "holdfast/control/controlled_plant.hpp"
#include "holdfast/math/linalg/eigenbasis.hpp"
#include "process/errors.hpp"

namespace holdfast::program {
namespace {

void require_consistent_plant(const Case& the_case) {
  validate(*the_case.own->plant);
  if (the_case.control.proportional_gain_tuned)
    throw WrongInput(
        "control.proportional_gain = \"tuned\": Eq. 6 of Kollár 2022 needs an absorber's mass and "
        "stiffness, which a plant of your own does not give; give a number");
  for (const auto& [key, place] : the_case.places) require_counts(the_case, key, place + ": ");
}

void require_consistent_controller(const Case& the_case) {
  const auto& control = the_case.control;
  if (control.processing_delay > control.sampling_period)
    throw WrongInput(
        "control.processing_delay exceeds control.sampling_period: give a shorter "
        "control.processing_delay, and delay commands by whole samples in your controller");
  for (const char* key : {"control.displacement_quantum", "control.velocity_quantum",
                          "control.velocity", "control.largest_force"})
    if (const auto place = the_case.places.find(key); place != the_case.places.end())
      throw WrongInput(place->second + ": " + key +
                       ": remove this key, and program its effect in your controller");
}

}  // namespace

void require_counts(const Case& the_case, std::string_view key, const std::string& place) {
  if (!has_own_plant(the_case)) return;
  for (const char* table :
       {"plant.", "conductor.", "absorber.", "reduction.", "device.", "initial."})
    if (key.rfind(table, 0) == 0)
      throw WrongInput(
          place + std::string(key) +
          " has no effect on a plant of your own and its initial state; remove the key");
}

void require_consistent(const Case& the_case) {
  if (the_case.own == nullptr) return;
  if (the_case.own->plant) require_consistent_plant(the_case);
  if (the_case.own->controller) require_consistent_controller(the_case);
}

OwnLaw own_law_of(const Case& the_case, bool controlled) {
  const double period = the_case.control.jitter > 0.0 ? 0.0 : the_case.control.sampling_period;
  return {controlled ? the_case.own->controller : OwnForce{}, period};
}

std::vector<PlantPole> poles_of(const LinearPlant<double>& plant) {
  using Complex = std::complex<double>;
  const EigenBasis<double> basis(plant.state_matrix());
  if (!basis.is_sound())
    throw NoAnswer(
        "two poles of the plant nearly coincide and cannot be separated: change a number of the "
        "plant by a thousandth");
  const auto beta = basis.coordinates(plant.control_input());
  const auto of_z = basis.readings(plant.connections.measured_displacement);
  const auto of_v = basis.readings(plant.connections.measured_velocity);
  const auto values = basis.values();
  std::vector<PlantPole> poles;
  double apart = 0.0, size = 0.0;
  for (Eigen::Index k = 0; k < values.size(); ++k) {
    const Complex residue = of_z[k] * beta[k], rate = of_v[k] * beta[k];
    poles.push_back({values[k], residue});
    apart = std::max(apart, std::abs(rate - values[k] * residue));
    size = std::max({size, std::abs(rate), std::abs(values[k] * residue)});
  }
  if (apart > 1e-9 * size)
    throw NoAnswer(
        "margins and designs need a measured velocity that is the derivative of the measured "
        "displacement, unlike that of this plant: remove the plant's velocity output");
  return poles;
}

}  // namespace holdfast::program
