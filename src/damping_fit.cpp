#include "damping_fit.hpp"

#include <algorithm>

#include "cable_decay.hpp"
#include "cable_of_case.hpp"
#include "errors.hpp"

#ifdef HOLDFAST_HAS_CERES
#include "holdfast/ceres/decay_fit.hpp"
#endif

namespace holdfast::program {

#ifdef HOLDFAST_HAS_CERES

void require_ceres() {}

fit::DecayFit fit_record(const DecayRecord& record, const TwoDof<double>& plant,
                         const fit::DecayQuestion& question) {
  fit::DecayFit found = fit::fit_decay(record, plant, question);
  if (found.outcome == fit::FitOutcome::no_minimum)
    throw NoAnswer("the fit found no minimum: the record does not determine what is asked for");
  return found;
}

#else

void require_ceres() {
  throw NoAnswer(
      "a fit needs Ceres Solver, which this program was built without: install the package "
      "libceres-dev and build again");
}

fit::DecayFit fit_record(const DecayRecord&, const TwoDof<double>&, const fit::DecayQuestion&) {
  require_ceres();
  return {};
}

#endif

DecayRecord record_for_fit(const Case& the_case) {
  constexpr int periods = 6, samples_per_period = 250;
  const double period = 1.0 / the_case.reduction.first_frequency;
  const double weight = the_case.absorber.mass * the_case.conductor.gravity;
  CableDecayQuestion question{};
  question.force = std::max(0.2, weight / 8.0);
  question.duration = periods * period;
  question.interval = period / samples_per_period;
  question.elements = 60;
  return cable_decay(the_case, question).record;
}

fit::DecayFit fit_absorber_damping(const Case& the_case, const TwoDof<double>& plant) {
  require_ceres();
  const DecayRecord record = record_for_fit(the_case);
  fit::DecayQuestion question;
  question.fit_initial_displacement = false;
  question.target = fit::DecayTarget::first_peak_and_period;
  try {
    return fit_record(record, plant, question);
  } catch (const NoAnswer&) {
    question.target = fit::DecayTarget::time_history;
    return fit_record(record, plant, question);
  }
}

void settle_plant(Case& the_case) {
  if (the_case.plant_given || !the_case.conductor_given) return;
  const TwoDof<double> reduced = plant_without_absorber_damping(the_case);
  auto& plant = the_case.plant;
  plant.conductor_mass = reduced.conductor_mass;
  plant.conductor_stiffness = reduced.conductor_stiffness;
  plant.conductor_damping = reduced.conductor_damping;
  plant.absorber_mass = reduced.absorber_mass;
  plant.absorber_stiffness = reduced.absorber_stiffness;
  plant.absorber_damping =
      fit_absorber_damping(the_case, reduced).minima.front().plant.absorber_damping;
}

}  // namespace holdfast::program
