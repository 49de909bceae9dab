#include "jobs/charts/proved_stability.hpp"

#include <vector>

#include "case/model/loop_of_case.hpp"
#include "case/model/modal/modal_plant_of_case.hpp"
#include "case/model/own/own_parts.hpp"
#include "case/model/plant_of_case.hpp"
#include "holdfast/plant/enclosed_poles.hpp"
#include "holdfast/stability/chart/proved_modal_chart.hpp"
#include "holdfast/stability/response/enclosed_response.hpp"
#include "process/errors.hpp"
#include "process/interrupt.hpp"

namespace holdfast::program {
namespace {

template <class Proof>
ProvedChart chart_by(const Proof& proof, const GainGrid& grid, double undecided) {
  const auto decide = [&](const GainBox& box) {
    throw_if_interrupted();
    return proof(box);
  };
  return proved_chart(decide, grid, undecided);
}

/// What is not the law u = P z + D ż of a measured velocity: of that the proof is.
void refuse_other_computers(const Case& the_case) {
  refuse_for_own_plant(the_case, true, "--prove");
  if (the_case.own != nullptr)
    throw WrongInput("--prove is of the gains P and D, without a controller of one's own");
  if (!has_ideal_computer(the_case))
    throw WrongInput(
        "--prove is of an ideal computer: leave control.velocity at \"measured\", and quanta, "
        "largest force and jitter at 0");
}

/// What is not a conductor by its modes, whose poles can be proved.
void refuse_other_plants(const Case& the_case) {
  if (is_infinite(the_case))
    throw WrongInput("--prove: a string without ends drifts, which no gain damps");
  if (!the_case.devices.empty())
    throw WrongInput("--prove is of a conductor with the absorber alone, without [[devices]]");
}

std::vector<EnclosedPole> poles_of_case(const Case& the_case) {
  refuse_other_plants(the_case);
  if (is_two_masses(the_case)) return enclosed_poles(plant_of(the_case), hardware_of(the_case));
  return enclosed_poles(conductor_with_absorber_of(the_case));
}

ProvedChart modal_chart_of(const Case& the_case, const GainGrid& grid, double undecided) {
  const auto poles = poles_of_case(the_case);
  if (poles.empty())
    throw NoAnswer(
        "two natural motions of conductor, absorber and hardware are too close to be proved apart: "
        "change plant.absorber_damping or absorber.position by a thousandth");
  const EnclosedResponse response(poles, sampling_of(the_case));
  if (!response.poles_outside(1.0))
    throw NoAnswer(
        "of a natural motion of conductor and absorber it cannot be proved that it decays: give "
        "conductor.damping_ratio a value above 0");
  return proved_chart(response, grid, undecided, [] { throw_if_interrupted(); });
}

}  // namespace

ProvedChart proved_stability_of(const Case& the_case, const GainGrid& grid, bool continuous,
                                double undecided) {
  refuse_other_computers(the_case);
  if (is_modal(the_case)) return modal_chart_of(the_case, grid, undecided);
  const TwoMass<double> plant = plant_of(the_case);
  if (continuous) return chart_by(gain_box_proof(plant), grid, undecided);
  return chart_by(gain_box_proof(plant, sampling_of(the_case)), grid, undecided);
}

}  // namespace holdfast::program
