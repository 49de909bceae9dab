#include "case/model/reduction_of_case.hpp"

#include <string>

#include "case/model/cable_of_case.hpp"
#include "case/needed.hpp"
#include "process/errors.hpp"
#include "text/text.hpp"

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

FrequencyReduction<double> reduction_options_of(const Case& the_case) {
  require_keys(the_case, {"absorber.mass", "absorber.position", "conductor.damping_ratio"});
  const double stiffness = conductor_stiffness_of(the_case);
  require_keys(the_case, {"reduction.first_frequency", "reduction.second_frequency"});
  return {stiffness, the_case.absorber.mass, the_case.reduction.first_frequency,
          the_case.reduction.second_frequency};
}

ReductionResult reduction_of(const Case& the_case) {
  return reduce_to_frequencies(reduction_options_of(the_case));
}

TwoMass<double> plant_without_absorber_damping(const Case& the_case) {
  const FrequencyReduction<double> asked = reduction_options_of(the_case);
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

}  // namespace holdfast::program
