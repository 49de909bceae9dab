#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "holdfast/cable/elements.hpp"
#include "holdfast/math/signal/decay_measures.hpp"
#include "holdfast/motion/trajectory.hpp"
#include "holdfast/sundials/cvode.hpp"

namespace holdfast::cvode {

/// Outcome of the simulation of a load removal.
enum class LoadRemovalOutcome {
  completed,           ///< the record covers the whole duration
  no_equilibrium,      ///< Newton's method found no equilibrium of the cable
  slack,               ///< a bar lost its tension, which the model of the cable excludes
  integration_failed,  ///< CVODE failed; its message is in the result
};

/// The vibration at the absorber's place after a force is removed at t = 0.
struct LoadRemoval {
  LoadRemovalOutcome outcome;  ///< whether the record is complete, or why not
  std::string words;           ///< name of CVODE's return flag and its message if CVODE failed
  double last_time;  ///< instant (s) at which the integration ended: completed, slack or failed
  double initial_displacement;  ///< drop (m) caused by the force, from the equilibrium without it
  DecayRecord record;           ///< displacements (m) at t = 0, interval, 2 interval, …
  IntegrationCost cost;         ///< numbers of steps and evaluations; 0 without an equilibrium
};

/// Simulates the free vibration of a cable after the sudden removal of a static force at t = 0.
/// @param cable       `CableElements`, or an object of a type with the same members
/// @param force       removed force (N) at the absorber's place, downward positive
/// @param duration    duration (s), > 0; the record ends at the last whole multiple of the interval
/// @param interval    time (s) between the record's instants, > 0
/// @param tolerances  tolerances of the local error per step, and the limit of steps per interval
/// @param at_each     called before each instant of the record; may throw to stop the simulation
/// @throws InvalidParameter outside these ranges, and for more than 9·10¹⁵ intervals
template <class Cable>
LoadRemoval load_removal(const Cable& cable, double force, double duration, double interval,
                         const Tolerances& tolerances = {},
                         const std::function<void()>& at_each = {}) {
  require_finite("force", force, "N");
  require_positive("interval", interval, "s");
  require_positive("duration", duration, "s");
  LoadRemoval result{LoadRemovalOutcome::completed, "", 0.0, 0.0, {}, {}};
  const auto start = cable.held_by(force);
  if (start.outcome != EquilibriumOutcome::converged) {
    result.outcome = LoadRemovalOutcome::no_equilibrium;
    return result;
  }
  const std::int64_t intervals = samples_within(duration, interval) - 1;
  Integrator<Cable> integrator(cable, start.state, tolerances);
  result.initial_displacement = cable.displacement(start.state);
  for (std::int64_t k = 0; k <= intervals; ++k) {
    if (at_each) at_each();
    const double time = static_cast<double>(k) * interval;
    if (k > 0) integrator.advance_to(time);
    result.last_time = integrator.time();
    if (integrator.outcome() == IntegrationOutcome::model_ended) {
      result.outcome = LoadRemovalOutcome::slack;
      break;
    }
    if (integrator.outcome() != IntegrationOutcome::completed) {
      result.outcome = LoadRemovalOutcome::integration_failed;
      result.words = integrator.words();
      break;
    }
    result.record.times.push_back(time);
    result.record.displacements.push_back(cable.displacement(integrator.state()));
  }
  result.cost = integrator.cost();
  return result;
}

}  // namespace holdfast::cvode
