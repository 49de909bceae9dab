#include "case/model/resolved_plant.hpp"

#include <vector>

#include "case/case_keys.hpp"
#include "case/model/cable_of_case.hpp"
#include "case/model/conditioning.hpp"
#include "case/model/decay/damping_fit.hpp"
#include "case/model/modal/modal_plant_of_case.hpp"
#include "case/model/plant_of_case.hpp"
#include "case/model/reduction_of_case.hpp"
#include "process/errors.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

/// The keys of the two masses that the user gave.
std::vector<const CaseKey*> given_of_plant(const Case& the_case) {
  std::vector<const CaseKey*> given;
  for (const CaseKey& key : case_keys())
    if (key.table() == "plant" && !key.beyond_two_masses && the_case.places.count(key.name) > 0)
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

/// A plant of natural frequencies f1 and f2 says little of what the cable does far from them.
std::string distant_force_text(const Case& the_case) {
  const double frequency = effective_excitation(the_case).frequency;
  const double first = the_case.reduction.first_frequency;
  const double second = the_case.reduction.second_frequency;
  if (!(frequency < 0.5 * first || frequency > 2.0 * second)) return "";
  return "the excitation is at " + format_rounded(frequency) +
         " Hz, far from the natural frequencies of " + format_rounded(first) + " and " +
         format_rounded(second) +
         " Hz that the plant is reduced for: set reduction.first_frequency and "
         "reduction.second_frequency to two about it";
}

std::string joined_texts(const std::vector<std::string>& texts) {
  std::string all;
  for (const std::string& text : texts) all += (all.empty() || text.empty() ? "" : "; ") + text;
  return all;
}

/// Fits c2 where it is not given; what there is to say of the fit.
std::string settle_damping(Case& the_case) {
  if (the_case.places.count("plant.absorber_damping") > 0) return "";
  const AbsorberDampingFit found = fit_absorber_damping(the_case, plant_of(the_case));
  the_case.plant.absorber_damping = found.fit.minima.front().plant.absorber_damping;
  return misfit_warning(found);
}

}  // namespace

std::string settle_absorber(Case& the_case) {
  if (!plant_is_reduced(the_case) || has_own_plant(the_case)) return "";
  if (the_case.places.count("plant.absorber_mass") == 0)
    the_case.plant.absorber_mass = the_case.absorber.mass;
  if (!has_absorber(the_case) || the_case.stands_alone) return "";
  std::string names;
  for (const char* key : {"plant.absorber_stiffness", "plant.absorber_damping"})
    if (the_case.places.count(key) == 0) names += (names.empty() ? "" : ", ") + std::string(key);
  return names.empty() ? "" : names + " not given: the absorber's built-in value stands in";
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
