#pragma once

#include <cmath>

#include "holdfast/contact/contact_guard.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/excitation/force_over_samples.hpp"
#include "holdfast/plant/affine_dynamics.hpp"
#include "holdfast/plant/energy.hpp"

namespace holdfast {

/// A bound that can prove that a guard g has no zero within a time h, from its values at both ends.
///
/// Between the ends g ≥ chord − M h²/8, the chord being the line between these values and M ≥ |g̈|.
/// From ż = A z + w, w = drift + b u + c F,
///
///     g̈ = ℓᵀA² z + ℓᵀA w + ℓᵀ ẇ + m F̈     for g = ℓᵀz + m F + const,
///
/// and ‖z‖ grows by at most ‖w‖ h in the norm of the energy (plant/energy.hpp), or in another norm
/// that no free motion ż = A z increases (plant/decaying_norm.hpp). The bound is valid for every
/// guard of a mode with the same |ℓ| and |m|. An infinite norm makes it infinite or NaN: it proves
/// nothing.
/// @tparam Norm    EnergyNorm of the two masses, DecayingNorm of a plant of any order
/// @tparam States  N, the order of the plant
template <class Norm, int States>
class NoEventBoundOf {
 public:
  /// @param dynamics  matrices A, b, c and the drift of a mode
  /// @param bounded   data of the norm: A, or the two masses whose energy bounds the motion
  /// @param guard     one guard of the mode, which gives ℓ and m
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

  /// The terms of drop_below_chord() for one length: by_norm ‖z‖ + by_command |u| + constant.
  struct Drop {
    double by_norm;     ///< factor of the norm ‖z‖ of the initial state
    double by_command;  ///< factor of |u|, per newton
    double constant;    ///< constant term, in the unit of the guard
  };
  /// The terms of drop_below_chord() over a length h (s), ≥ 0.
  Drop drop_over(double length) const {
    const double share = length * length / 8.0, by_size = share * by_state_;
    return {by_size, by_size * length * command_growth_ + share * by_command_,
            by_size * length * other_growth_ + share * by_force_};
  }

  /// The largest depth of g below its chord over a length (s), from a state under a command (N).
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
