#include "case/model/cable_of_case.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "case/case_keys.hpp"
#include "holdfast/cable/modes.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "io/text/text.hpp"
#include "process/errors.hpp"

namespace holdfast::program {
namespace {

NoAnswer no_plant(const Case& the_case, const FrequencyReduction<double>& asked,
                  const ReductionResult& result) {
  const bool computed = the_case.first_frequency_computed || the_case.second_frequency_computed;
  const std::string remedy =
      computed ? "; the frequencies are computed from the conductor where "
                 "reduction.first_frequency and reduction.second_frequency are not given"
               : "";
  return NoAnswer(
      "no two-mass plant has the natural frequencies " + format_rounded(asked.first_frequency) +
      " and " + format_rounded(asked.second_frequency) +
      " Hz with k1 = " + format_rounded(asked.conductor_stiffness) + " N/m and an absorber of " +
      format_rounded(asked.absorber_mass) + " kg: with this k1 the absorber may weigh " +
      format_rounded(result.largest_absorber_mass) + " kg at most, or k1 must be " +
      format_rounded(result.smallest_conductor_stiffness) + " N/m at least" + remedy);
}

}  // namespace

bool plant_is_reduced(const Case& the_case) {
  const auto& keys = case_keys();
  return the_case.conductor_given && std::any_of(keys.begin(), keys.end(), [&](const CaseKey& key) {
           return key.table() == "plant" && the_case.places.count(key.name) == 0;
         });
}

Conductor<double> conductor_of(const Case& the_case) {
  const auto& c = the_case.conductor;
  return {c.mass_per_length, c.span, c.sag, c.area, c.youngs_modulus, c.damping_ratio, c.gravity};
}

StaticsFromRest<IrvinePointLoad<double>> irvine_statics_of(const Case& the_case) {
  return irvine_statics(conductor_of(the_case), the_case.absorber.position, the_case.absorber.mass);
}

StaticsFromRest<CatenaryPointLoad<double>> exact_statics_of(const Case& the_case) {
  return exact_statics(conductor_of(the_case), the_case.absorber.position, the_case.absorber.mass);
}

StiffnessReading stiffness_reading_of(const Case& the_case) {
  const std::string& reading = the_case.reduction.stiffness_reading;
  if (reading == "tangent") return StiffnessReading::tangent;
  return reading == "secant" ? StiffnessReading::secant : StiffnessReading::least_squares;
}

ReadingRange reading_range_of(const Case& the_case) {
  return {the_case.reduction.reading_below, the_case.reduction.reading_above};
}

void require_reading_range(const Case& the_case) {
  const ReadingRange range = reading_range_of(the_case);
  const auto irvine = irvine_statics_of(the_case);
  const double highest = irvine.displacement(irvine.lowest_force() * (1.0 - 1e-6));
  if (!(-range.above > highest))
    throw WrongInput("reduction.reading_above = " + format_number(range.above) +
                     " m: the absorber's place cannot be lifted so far before the statics end; "
                     "admissible is less than " +
                     format_rounded(-highest) + " m");
  if (!(range.below <= the_case.conductor.sag))
    throw WrongInput("reduction.reading_below = " + format_number(range.below) +
                     " m: admissible is at most the sag, " + format_number(the_case.conductor.sag) +
                     " m");
}

double conductor_stiffness_of(const Case& the_case) {
  if (stiffness_reading_of(the_case) != StiffnessReading::tangent) require_reading_range(the_case);
  return conductor_stiffness(irvine_statics_of(the_case), stiffness_reading_of(the_case),
                             reading_range_of(the_case));
}

FrequencyReduction<double> reduction_question_of(const Case& the_case) {
  return {conductor_stiffness_of(the_case), the_case.absorber.mass,
          the_case.reduction.first_frequency, the_case.reduction.second_frequency};
}

ReductionResult reduction_of(const Case& the_case) {
  return reduce_to_frequencies(reduction_question_of(the_case));
}

TwoDof<double> plant_without_absorber_damping(const Case& the_case) {
  const FrequencyReduction<double> asked = reduction_question_of(the_case);
  const ReductionResult result = reduce_to_frequencies(asked);
  if (result.outcome == ReductionOutcome::no_solution) throw no_plant(the_case, asked, result);
  const ReducedMasses& smaller = result.solutions.front();
  return {smaller.conductor_mass,
          asked.conductor_stiffness,
          conductor_damping(smaller.conductor_mass, asked.conductor_stiffness,
                            the_case.conductor.damping_ratio),
          asked.absorber_mass,
          smaller.absorber_stiffness,
          0.0};
}

RayleighDamping rayleigh_damping_of(const Case& the_case) {
  return rayleigh_damping(the_case.conductor.damping_ratio, the_case.reduction.first_frequency,
                          the_case.reduction.second_frequency);
}

CableElements elements_of(const Case& the_case, int elements, AbsorberReading reading) {
  const HangingAbsorber absorber{reading, the_case.absorber.mass, the_case.plant.absorber_stiffness,
                                 the_case.plant.absorber_damping};
  return {conductor_of(the_case), the_case.absorber.position, elements, absorber,
          rayleigh_damping_of(the_case)};
}

std::pair<double, double> default_frequencies(const Case& the_case) {
  constexpr std::size_t wanted = 6;
  const double place = the_case.absorber.position / the_case.conductor.span;
  std::vector<double> moving;
  // A place near a support is moved by high modes only; the first of all stands in for the first.
  const auto modes = irvine_modes(conductor_of(the_case), 200);
  for (const CableMode& mode : modes) {
    if (std::abs(mode.shape(place)) >= 0.1) moving.push_back(mode.frequency);
  }
  if (moving.size() < wanted) return {modes[0].frequency, modes[wanted - 1].frequency};
  return {moving.front(), moving[wanted - 1]};
}

std::string borrowed_cable_warning(const Case& the_case) {
  if (!the_case.plant_given || the_case.conductor_given) return "";
  return "the case gives [plant] and no [conductor]: the cable is that of the built-in case";
}

std::string deep_cable_warning(const Case& the_case) {
  const double ratio = the_case.conductor.sag / the_case.conductor.span;
  if (ratio <= 0.125) return "";
  return "conductor.sag is " + format_rounded(ratio) +
         " of conductor.span: Eq. 1 and Irvine's modes are those of shallow cables, up to 0.125; "
         "the "
         "exact statics and the finite elements hold";
}

void require_force_within_statics(const Case& the_case, double force) {
  const double lowest = irvine_statics_of(the_case).lowest_force();
  if (force > lowest) return;
  throw WrongInput("a force of " + format_number(force) +
                   " N lifts the cable by half of its own weight or more, where its statics end: "
                   "admissible is greater than " +
                   format_rounded(lowest) + " N");
}

}  // namespace holdfast::program
