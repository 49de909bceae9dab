#include "case/model/decay/cable_decay.hpp"

#include <cmath>
#include <utility>

#include "case/needed.hpp"
#include "holdfast/plant/free_decay.hpp"
#include "process/errors.hpp"
#include "process/interrupt.hpp"
#include "text/text.hpp"

#ifdef HOLDFAST_HAS_SUNDIALS
#include "holdfast/cable/modes.hpp"
#include "holdfast/sundials/load_removal.hpp"
#endif

namespace holdfast::program {

CableElements elements_of(const Case& the_case, int elements, AbsorberReading reading) {
  const auto known_or_zero = [](double value) { return std::isnan(value) ? 0.0 : value; };
  const auto& plant = the_case.plant;
  if (reading == AbsorberReading::spring_mass)
    require_keys(the_case, {"plant.absorber_stiffness", "plant.absorber_damping"});
  const HangingAbsorber absorber{reading, known_or_zero(the_case.absorber.mass),
                                 known_or_zero(plant.absorber_stiffness),
                                 known_or_zero(plant.absorber_damping)};
  const Conductor<double> conductor = conductor_of(the_case);
  const auto& [first, second] = std::pair(needed(the_case, "reduction.first_frequency"),
                                          needed(the_case, "reduction.second_frequency"));
  return {conductor, needed(the_case, "absorber.position"), elements, absorber,
          rayleigh_damping(conductor.damping_ratio, first, second)};
}

CableDecayOptions usual_decay(const Case& the_case) {
  const double period = 1.0 / the_case.reduction.first_frequency;
  const double force = the_case.absorber.mass * the_case.conductor.gravity / 8.0;
  return {force, 6.0 * period, period / 250.0};
}

DecayRecord plant_decay(const TwoMass<double>& plant, double force, bool equal_displacement,
                        const CableDecay& cable) {
  const double start =
      equal_displacement ? cable.initial_displacement : force / plant.conductor_stiffness;
  return {cable.record.times, free_decay(plant, start, cable.record.times)};
}

#ifdef HOLDFAST_HAS_SUNDIALS

namespace {

/// Throws NoAnswer for a decay of too many periods of the cable, as when reduction.first_frequency
/// is far below its frequencies.
void require_followable(const Case& the_case, const CableDecayOptions& options) {
  constexpr double most_periods = 1e5;
  const double lowest = irvine_modes(conductor_of(the_case), 1).front().frequency;
  const double periods = options.duration * lowest;
  if (periods <= most_periods) return;
  throw NoAnswer("a decay over " + format_rounded(options.duration) + " s has " +
                 format_rounded(periods) + " periods of the cable's first mode (" +
                 format_rounded(lowest) +
                 " Hz), more than the limit of 100000: give a shorter --duration, or a higher "
                 "reduction.first_frequency");
}

CableDecay decay_of(const CableElements& cable, const CableDecayOptions& options) {
  const auto removal = cvode::load_removal(cable, options.force, options.duration, options.interval,
                                           {}, throw_if_interrupted);
  const std::string force = "a force of " + format_number(options.force) + " N";
  switch (removal.outcome) {
    case cvode::LoadRemovalOutcome::completed:
      break;
    case cvode::LoadRemovalOutcome::slack:
      throw WrongInput("after " + force + " is removed the cable goes slack within " +
                       format_rounded(removal.last_time) +
                       " s, which the model excludes: give a smaller force");
    case cvode::LoadRemovalOutcome::no_equilibrium:
      throw NoAnswer("no equilibrium was found under " + force + ": give a smaller force");
    case cvode::LoadRemovalOutcome::integration_failed:
      throw NoAnswer("the integrator CVODE failed at t = " + format_number(removal.last_time) +
                     " s of the decay (" + one_line(removal.words) + "): give a smaller force");
  }
  return {removal.initial_displacement, removal.record};
}

}  // namespace

bool has_sundials() { return true; }
void require_sundials() {}

CableDecay cable_decay(const Case& the_case, const CableDecayOptions& options) {
  require_keys(the_case, {"absorber.mass", "conductor.damping_ratio"});
  require_force_within_statics(the_case, options.force);
  require_followable(the_case, options);
  return decay_of(elements_of(the_case, options.elements, options.reading), options);
}

#else

bool has_sundials() { return false; }

void require_sundials() {
  throw NoAnswer(
      "the continuous cable needs SUNDIALS, which this program was built without: install the "
      "package libsundials-dev and build again");
}

CableDecay cable_decay(const Case&, const CableDecayOptions&) {
  require_sundials();
  return {};
}

#endif

}  // namespace holdfast::program
