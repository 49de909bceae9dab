#pragma once

#include <cstddef>
#include <vector>

#include "holdfast/control/zero_order_hold.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/excitation/harmonic_excitation.hpp"
#include "holdfast/excitation/harmonic_input.hpp"
#include "holdfast/excitation/multi_harmonic_force.hpp"
#include "holdfast/motion/taylor_step.hpp"

namespace holdfast {

/// The exact map of the state z over a part of a sampling period, from t_j + begin to t_j + begin +
/// length, in one contact mode. The first equation is for an excitation held at its value F_j, the
/// second for a sum of harmonics, not held, with amplitudes F_l and frequencies ω_l (rad/s):
///
///     z ← transition z + command u + drift + held F_j
///     z ← transition z + command u + drift + Σ_l F_l (g_c cos ω_l t_j + g_s sin ω_l t_j)
///
/// @tparam States  N, the order of the plant
template <int States>
struct SubintervalStep {
  Matrix<double, States> transition;  ///< transition matrix e^{A length}, N × N
  Vector<double, States> command;     ///< response per newton of u, N × 1
  Vector<double, States> drift;       ///< contribution of the mode's constant drift, N × 1
  Vector<double, States> held;        ///< response per newton of a held excitation, N × 1
  std::vector<HarmonicInput<double, States>> lines;  ///< g_c and g_s of each harmonic, per newton

  /// @param dynamics   equations of motion in the mode
  /// @param harmonics  harmonics of the excitation, in the order of the phases passed to `state`
  /// @param begin      beginning of the part (s after the sample)
  /// @param length     length (s), ≥ 0
  SubintervalStep(const AffineDynamicsOf<States>& dynamics, const std::vector<Harmonic>& harmonics,
                  double begin, double length);

  /// The state (N × 1) at the end of the part, from the state at its beginning.
  /// @param before      state at the beginning, N × 1
  /// @param commanded   command u in force (N)
  /// @param held_force  held excitation F_j (N); used only if `phases` is empty
  /// @param phases      F_l cos ω_l t_j and F_l sin ω_l t_j (N) of all harmonics, or empty
  Vector<double, States> state(const Vector<double, States>& before, double commanded,
                               double held_force,
                               const std::vector<ExcitationSample<double>>& phases) const {
    Vector<double, States> after = transition * before + command * commanded + drift;
    if (phases.empty()) after += held * held_force;
    for (std::size_t l = 0; l < phases.size(); ++l)
      after += lines[l].cosine * phases[l].cosine + lines[l].sine * phases[l].sine;
    return after;
  }
};

template <int States>
SubintervalStep<States>::SubintervalStep(const AffineDynamicsOf<States>& dynamics,
                                         const std::vector<Harmonic>& harmonics, double begin,
                                         double length) {
  const Eigen::Index n = dynamics.state.rows();
  const Matrix<double, States> identity = Matrix<double, States>::Identity(n, n);
  const auto step = zero_order_hold<double, States, States>(dynamics.state, identity, length);
  transition = step.transition;
  command = step.input * dynamics.command;
  drift = step.input * dynamics.drift;
  held = step.input * dynamics.force;
  for (const Harmonic& line : harmonics) {
    const double angular = 2.0 * pi<double> * line.frequency;
    const auto input = exact_harmonic<double>(dynamics.state, dynamics.force, length, angular);
    lines.push_back(ahead_by(angular * begin + line.phase, input));
  }
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template SubintervalStep<4>::SubintervalStep(const AffineDynamicsOf<4>&,
                                                    const std::vector<Harmonic>&, double, double);
extern template SubintervalStep<Eigen::Dynamic>::SubintervalStep(
    const AffineDynamicsOf<Eigen::Dynamic>&, const std::vector<Harmonic>&, double, double);
#endif

}  // namespace holdfast
