#pragma once

#include <cmath>

#include "holdfast/contact/contact_guard.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/excitation/force_over_samples.hpp"
#include "holdfast/plant/affine_dynamics.hpp"
#include "holdfast/plant/energy.hpp"

namespace holdfast {

/// Tells that a guard cannot come to zero within a length h, from its values at both ends.
///
/// Between them g lies above the chord less M h²/8, M ≥ |g̈|. From ż = A z + w, w = drift + b u + c
/// F,
///
///     g̈ = ℓᵀA² z + ℓᵀA w + ℓᵀ ẇ + m F̈     for g = ℓᵀz + m F + const,
///
/// and ‖z‖ in the norm of the energy (plant/energy.hpp), or another that A does not let grow
/// (plant/decaying_norm.hpp), grows by no more than ‖w‖ h. The bound
/// holds for every guard of a mode that has the same |ℓ| and |m|. In an infinite norm it holds of
/// nothing: the sag is infinite or no number.
/// @tparam Norm    EnergyNorm of the two masses, DecayingNorm of a plant of any order
/// @tparam States  N, the order of the plant
template <class Norm, int States>
class NoEventBoundOf {
 public:
  /// @param dynamics  A, b, c and the drift of a mode
  /// @param bounded   what the norm is made of: the two masses whose energy bounds the motion in
  /// that
  ///                  mode, or A
  /// @param guard     one of the mode's, of which ℓ and m count
  /// @param force     bounds of the excitation
  template <class Bounded>
  NoEventBoundOf(const AffineDynamicsOf<States>& dynamics, const Bounded& bounded,
                 const GuardOf<States>& guard, const ForceBounds& force)
      : energy_(bounded),
        command_growth_(energy_(dynamics.command)),
        other_growth_(energy_(dynamics.drift) + energy_(dynamics.force) * force.value) {
    const Vector<double, States> once = dynamics.state.transpose() * guard.state;
    by_state_ = energy_.dual(dynamics.state.transpose() * once);
    by_command_ = std::abs(once.dot(dynamics.command));
    by_force_ = std::abs(once.dot(dynamics.drift)) +
                std::abs(once.dot(dynamics.force)) * force.value +
                std::abs(guard.state.dot(dynamics.force)) * force.rate +
                std::abs(guard.force) * force.second_rate;
  }

  /// Parts of `drop_below_chord` over one length: by_norm ‖z‖ + by_command |u| + constant.
  struct Drop {
    double by_norm;     ///< of the norm of the state at the begin
    double by_command;  ///< per newton of |u|
    double constant;    ///< in the unit of the guard
  };
  /// Over a length (s), ≥ 0.
  Drop drop_over(double length) const {
    const double share = length * length / 8.0, by_size = share * by_state_;
    return {by_size, by_size * length * command_growth_ + share * by_command_,
            by_size * length * other_growth_ + share * by_force_};
  }

  /// How far below the chord of its ends a guard may come.
  double drop_below_chord(const Vector<double, States>& begin, double command,
                          double length) const {
    const Drop drop = drop_over(length);
    return drop.by_norm * energy_(begin) + drop.by_command * std::abs(command) + drop.constant;
  }

 private:
  Norm energy_;
  double command_growth_, other_growth_;
  double by_state_, by_command_, by_force_;
};

}  // namespace holdfast
