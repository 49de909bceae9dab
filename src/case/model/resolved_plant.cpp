#include "case/model/resolved_plant.hpp"

#include <vector>

#include "case/case_keys.hpp"
#include "case/model/cable_of_case.hpp"
#include "case/model/conditioning.hpp"
#include "case/model/decay/damping_fit.hpp"
#include "case/model/modal/modal_plant_of_case.hpp"
#include "case/model/plant_of_case.hpp"
#include "case/needed.hpp"
#include "process/errors.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

NoAnswer no_plant(const Case& the_case, const FrequencyReduction<double>& asked,
                  const ReductionResult& result) {
  const bool computed = the_case.first_frequency_computed || the_case.second_frequency_computed;
  const std::string remedy = computed
                                 ? "; or give reduction.first_frequency and "
                                   "reduction.second_frequency, now computed from the conductor"
                                 : "";
  return NoAnswer("no two-mass plant has the natural frequencies " +
                  format_rounded(asked.first_frequency) + " and " +
                  format_rounded(asked.second_frequency) +
                  " Hz with the stiffness k1 = " + format_rounded(asked.conductor_stiffness) +
                  " N/m and an absorber of " + format_rounded(asked.absorber_mass) +
                  " kg: set absorber.mass to " + format_rounded(result.largest_absorber_mass) +
                  " kg at most, or change the conductor so that k1 is " +
                  format_rounded(result.smallest_conductor_stiffness) + " N/m at least" + remedy);
}

/// The keys of the two masses that the user gave.
std::vector<const CaseKey*> given_of_plant(const Case& the_case) {
  std::vector<const CaseKey*> given;
  for (const CaseKey& key : case_keys())
    if (key.table() == "plant" && !key.beyond_two_masses && the_case.is_given(key.name))
      given.push_back(&key);
  return given;
}

void take_plant(Case& the_case, const TwoMass<double>& reduced) {
  the_case.plant = {reduced.conductor_mass, reduced.conductor_stiffness, reduced.conductor_damping,
                    reduced.absorber_mass,  reduced.absorber_stiffness,  reduced.absorber_damping,
                    the_case.plant.model,   the_case.plant.modes};
}

std::string partial_plant_text(const std::vector<const CaseKey*>& given) {
  if (given.empty()) return "";
  std::string names;
  for (const CaseKey* key : given) names += (names.empty() ? "" : ", ") + key->name;
  return names + " given; the rest of the plant is reduced from the conductor";
}

/// A remark on an excitation far from the natural frequencies, where the plant is not valid.
std::string distant_force_text(const Case& the_case) {
  const double frequency = effective_excitation(the_case).frequency;
  const double first = the_case.reduction.first_frequency;
  const double second = the_case.reduction.second_frequency;
  if (!(frequency < 0.5 * first || frequency > 2.0 * second)) return "";
  return "the excitation is at " + format_rounded(frequency) +
         " Hz, far from the natural frequencies of " + format_rounded(first) + " and " +
         format_rounded(second) +
         " Hz of the reduced plant: set reduction.second_frequency near the excitation frequency, "
         "and reduction.first_frequency near the natural frequency of the absorber on its spring";
}

std::string joined_texts(const std::vector<std::string>& texts) {
  std::string all;
  for (const std::string& text : texts) all += (all.empty() || text.empty() ? "" : "; ") + text;
  return all;
}

/// Fits c2 unless it is given. Returns a warning of a poor fit, or "".
std::string settle_damping(Case& the_case) {
  if (the_case.is_given("plant.absorber_damping")) return "";
  const AbsorberDampingFit found = fit_absorber_damping(the_case, plant_of(the_case));
  the_case.plant.absorber_damping = found.fit.minima.front().plant.absorber_damping;
  return misfit_warning(found);
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

std::string settle_absorber(Case& the_case) {
  if (!plant_is_reduced(the_case) || has_own_plant(the_case)) return "";
  if (!the_case.is_given("plant.absorber_mass"))
    the_case.plant.absorber_mass = the_case.absorber.mass;
  if (!has_absorber(the_case) || the_case.stands_alone) return "";
  std::string names;
  for (const char* key : {"plant.absorber_stiffness", "plant.absorber_damping"})
    if (!the_case.is_given(key)) names += (names.empty() ? "" : ", ") + std::string(key);
  return names.empty() ? "" : names + " not given: the built-in absorber's value is used";
}

std::string settle_plant(Case& the_case) {
  if (!plant_is_reduced(the_case) || has_own_plant(the_case)) return "";
  if (!is_two_masses(the_case)) return settle_absorber(the_case);
  const std::vector<const CaseKey*> given = given_of_plant(the_case);
  Case as_given = the_case;
  take_plant(the_case, plant_without_absorber_damping(the_case));
  for (const CaseKey* key : given) *key->number(the_case) = *key->number(as_given);
  const std::string misfit = settle_damping(the_case);
  return joined_texts({partial_plant_text(given), misfit, sensitive_reduction_warning(the_case),
                       distant_force_text(the_case)});
}

}  // namespace holdfast::program
