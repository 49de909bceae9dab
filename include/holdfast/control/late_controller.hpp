#pragma once

#include <algorithm>
#include <utility>

#include "holdfast/control/controlled_plant.hpp"
#include "holdfast/control/controller.hpp"
#include "holdfast/control/loop_map.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"

namespace holdfast {

/// The proportional–differential law with a force delayed by M′ whole samples, as a user-defined
/// controller (`with_controller`):
///
///     u_j = c_{j−M′},   0 for the first M′ samples;   c_j is the command of `Controller`
///
/// Its states are the M′ delayed commands, the oldest first. Where the velocity is a difference,
/// two more follow: the last displacement reading and a flag, > 0 once there was a reading.
struct LateController {
  static constexpr int states = Eigen::Dynamic;             ///< number M, known at run time only
  using State = Vector<double, Eigen::Dynamic>;             ///< state, M × 1
  using Derivative = ControllerDerivative<Eigen::Dynamic>;  ///< Jacobian, (M + 1) × (M + 2)

  PdGains<double> gains;         ///< gains P and D
  ControllerLimits limits = {};  ///< limits of the readings and of the force
  Eigen::Index samples = 0;      ///< number M′ ≥ 0 of samples of delay

  /// The number M of states.
  Eigen::Index order() const { return samples + (differs() ? 2 : 0); }

  /// Command u_j (N) of a sample; replaces the state by the next state.
  double command(const ControlSample& sample, State& state) const {
    const auto [now, controller] = sensed(sample, state);
    if (differs()) state.tail(2) << controller.memory().previous_displacement, 1.0;
    if (samples == 0) return now;
    const double next = state[0];
    for (Eigen::Index k = 0; k + 1 < samples; ++k) state[k] = state[k + 1];
    state[samples - 1] = now;
    return next;
  }

  /// Jacobian of [u_j; next state] by readings and state; entries of quantised readings are 0.
  Derivative derivative(const ControlSample& sample, const State& state) const {
    const ControllerSlope slope = sensed(sample, state).second.slope();
    Derivative result = Derivative::Zero(order() + 1, order() + 2);
    // [u; the commands on their way] move up by one, and the new one comes in last.
    for (Eigen::Index k = 0; k < samples; ++k) result(k, k + 2) = 1.0;
    result(samples, 0) = slope.displacement;
    result(samples, 1) = slope.velocity;
    if (!differs()) return result;
    result(samples, samples + 2) = slope.previous_displacement;
    result(samples + 1, 0) = limits.displacement_quantum > 0.0 ? 0.0 : 1.0;
    return result;
  }

 private:
  bool differs() const { return limits.velocity == VelocitySensing::difference; }

  std::pair<double, Controller> sensed(const ControlSample& sample, const State& state) const {
    Controller controller(gains, limits);
    if (differs()) controller.restore({state[samples], state[samples + 1] > 0.0});
    const double now = controller.command(sample.displacement, sample.velocity, sample.elapsed);
    return {now, controller};
  }
};

/// The sampling with the period τ and the part δ − (k − 1) τ of the delay δ. This part, at most τ,
/// remains after k − 1 whole samples, k = held_commands(sampling) = max(1, ⌈δ/τ⌉).
/// @param sampling  τ (s) > 0, δ (s) ≥ 0
/// @throws InvalidParameter where the sampling is not admissible
inline Sampling<double> within_sample(const Sampling<double>& sampling) {
  const double whole = held_commands(sampling) - 1;
  const double late = sampling.processing_delay - whole * sampling.period;
  return {sampling.period, std::clamp(late, 0.0, sampling.period)};
}

/// The controller of a loop whose delay δ may exceed τ. It delays commands by k − 1 whole samples,
/// k = max(1, ⌈δ/τ⌉). Use it in a loop with the sampling of within_sample().
/// @param gains     gains P and D
/// @param limits    limits of readings and force
/// @param sampling  τ (s) > 0, δ (s) ≥ 0
/// @throws InvalidParameter where an argument is not admissible
inline LateController late_controller(const PdGains<double>& gains, const ControllerLimits& limits,
                                      const Sampling<double>& sampling) {
  validate(gains);
  validate(limits);
  return {gains, limits, held_commands(sampling) - 1};
}

}  // namespace holdfast
