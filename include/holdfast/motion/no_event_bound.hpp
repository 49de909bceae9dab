#pragma once

#include <cmath>

#include "holdfast/contact/contact_guard.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/excitation/force_over_samples.hpp"
#include "holdfast/plant/affine_dynamics.hpp"
#include "holdfast/plant/energy.hpp"

namespace holdfast {

/// A bound that may prove that a guard g (GuardOf) has no zero in a time interval of length h.
///
/// The chord is the straight line between the values of g at the ends of the interval. If |g̈| ≤ G,
/// g lies at most G h²/8 below the chord. For g = ℓᵀz + m F + const (F: excitation) and the
/// equations of motion ż = A z + w, w = drift + b u + c F,
///
///     g̈ = ℓᵀA² z + ℓᵀA w + ℓᵀ ẇ + m F̈ .
///
/// The norm ‖z‖ must not increase in any free motion ż = A z. In the time h the input w then adds
/// at most h max ‖w‖ to ‖z‖. The bound is valid for all guards of the mode with the same ℓ and m up
/// to sign. If ‖z‖ is infinite, the bound is infinite or NaN and proves nothing.
/// @tparam Norm    EnergyNorm (plant/energy.hpp) for two masses, else DecayingNorm
/// @tparam States  N, the order of the plant
template <class Norm, int States>
class NoEventBoundOf {
 public:
  /// @param dynamics  matrices A, b, c and the drift of a mode
  /// @param bounded   constructor argument of Norm: the two masses for EnergyNorm, else A
  /// @param guard     one guard of the mode, which defines ℓ and m
  /// @param force     bounds of |F|, |Ḟ| and |F̈|
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

  /// Coefficients of drop_below_chord() = by_norm ‖z‖ + by_command |u| + constant for a time h (s).
  struct Drop {
    double by_norm;     ///< factor of the norm ‖z‖ of the initial state
    double by_command;  ///< factor of |u|, per newton
    double constant;    ///< constant term, in the unit of the guard
  };
  /// The coefficients of drop_below_chord() over a time h (s), ≥ 0.
  Drop drop_over(double length) const {
    const double share = length * length / 8.0, by_size = share * by_state_;
    return {by_size, by_size * length * command_growth_ + share * by_command_,
            by_size * length * other_growth_ + share * by_force_};
  }

  /// The bound of the depth of g below its chord over a time `length` (s), from a state `begin`,
  /// N × 1, under a constant command (N). If g exceeds this bound at both ends, g has no zero.
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
