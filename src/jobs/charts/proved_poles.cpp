#include "jobs/charts/proved_poles.hpp"

#include "case/model/loop_of_case.hpp"
#include "case/model/modal/modal_plant_of_case.hpp"
#include "case/model/own/own_parts.hpp"
#include "case/model/plant_of_case.hpp"
#include "process/errors.hpp"

namespace holdfast::program {
namespace {

std::vector<EnclosedPole> possible_poles_of(const Case& the_case) {
  if (is_two_masses(the_case)) return enclosed_poles(plant_of(the_case), hardware_of(the_case));
  return enclosed_poles(conductor_with_absorber_of(the_case));
}

}  // namespace

void refuse_to_prove(const Case& the_case) {
  refuse_for_own_plant(the_case, true, "--prove");
  if (the_case.own != nullptr)
    throw WrongInput("--prove is of the gains P and D, without a controller of one's own");
  if (!has_ideal_computer(the_case))
    throw WrongInput(
        "--prove is of an ideal computer: leave control.velocity at \"measured\", and quanta, "
        "largest force and jitter at 0");
  if (is_infinite(the_case))
    throw WrongInput("--prove: a string without ends drifts, which no gain damps");
  if (!the_case.devices.empty())
    throw WrongInput("--prove is of a conductor with the absorber alone, without [[devices]]");
}

std::vector<EnclosedPole> proved_poles_of(const Case& the_case) {
  std::vector<EnclosedPole> poles = possible_poles_of(the_case);
  if (poles.empty())
    throw NoAnswer(
        "two natural motions of conductor, absorber and hardware are too close to be proved apart: "
        "change plant.absorber_damping or absorber.position by a thousandth");
  for (const EnclosedPole& pole : poles)
    if (!pole.s.real().is_negative())
      throw NoAnswer(
          "of a natural motion of conductor and absorber it cannot be proved that it decays: give "
          "conductor.damping_ratio a value above 0");
  return poles;
}

}  // namespace holdfast::program
