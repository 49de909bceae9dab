#include "jobs/charts/proved_poles.hpp"

#include <algorithm>

#include "case/model/loop_of_case.hpp"
#include "case/model/modal/modal_plant_of_case.hpp"
#include "case/model/plant_of_case.hpp"
#include "process/errors.hpp"

namespace holdfast::program {
namespace {

std::vector<EnclosedPole> possible_poles_of(const Case& the_case) {
  if (is_two_masses(the_case)) return enclosed_poles(plant_of(the_case), hardware_of(the_case));
  return enclosed_poles(conductor_with_absorber_of(the_case));
}

bool all_decay(const std::vector<EnclosedPole>& poles) {
  return std::all_of(poles.begin(), poles.end(),
                     [](const EnclosedPole& pole) { return pole.s.real().is_negative(); });
}

}  // namespace

bool may_be_proved(const Case& the_case) {
  return the_case.own == nullptr && has_ideal_computer(the_case) && !is_infinite(the_case) &&
         the_case.devices.empty();
}

std::vector<EnclosedPole> proved_poles_of(const Case& the_case) {
  std::vector<EnclosedPole> poles = possible_poles_of(the_case);
  if (poles.empty())
    throw NoAnswer(
        "two poles of the conductor with absorber, filter and drive lag are too close to be proved "
        "distinct: change plant.absorber_damping or absorber.position by 0.1 %");
  if (!all_decay(poles))
    throw NoAnswer(
        "it cannot be proved that all poles of the conductor with absorber, without control, "
        "have a negative real part: give conductor.damping_ratio a value above 0");
  return poles;
}

std::vector<EnclosedPole> poles_if_proved(const Case& the_case) {
  if (!may_be_proved(the_case)) return {};
  std::vector<EnclosedPole> poles = possible_poles_of(the_case);
  return all_decay(poles) ? poles : std::vector<EnclosedPole>{};
}

}  // namespace holdfast::program
