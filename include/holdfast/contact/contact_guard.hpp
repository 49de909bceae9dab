#pragma once

#include <array>

#include "holdfast/core/types.hpp"

namespace holdfast {

/// State, command and excitation at an instant, on which a change of contact depends.
/// @tparam States  N, the order of the plant
template <int States>
struct ContactInstantOf {
  Vector<double, States> state;  ///< state x, N × 1; for two masses [z₁, ż₁, z₂, ż₂] (m, m/s, …)
  double command;                ///< command u that acts at the instant (N)
  double force;                  ///< excitation F (N)
};

/// A guard of a contact mode: a function g = state · x + command u + force F + constant that is
/// positive while the mode lasts. The mode ends when g reaches zero.
/// @tparam States  N, the order of the plant
template <int States>
struct GuardOf {
  Vector<double, States> state;  ///< coefficients of x, N × 1; the unit of g is m, m/s or m/s²
  double command = 0.0;          ///< coefficient of the command u, per newton
  double force = 0.0;            ///< coefficient of the excitation F, per newton
  double constant = 0.0;         ///< constant term, in the unit of g
  /// How many of g, ġ, g̈, …, in this order, are exactly 0 because the contact has just changed.
  int zeros = 0;
  /// Whether the sign of g is unknown; g is then multiplied by the sign of its first nonzero value.
  bool unsigned_yet = false;
};

/// The guards of a contact mode, at most two: functions whose zeros end the mode.
/// @tparam States  N, the order of the plant
template <int States>
struct GuardsOf {
  std::array<GuardOf<States>, 2> guard;  ///< guards; the first `count` are valid
  int count = 0;                         ///< number of guards; 0: the contact does not change
};

/// State, command and excitation at an instant, for the two masses.
using ContactInstant = ContactInstantOf<4>;
/// A guard of a contact mode of the two masses: a function that reaches zero when the mode ends.
using Guard = GuardOf<4>;
/// The guards of a contact mode of the two masses.
using Guards = GuardsOf<4>;

/// Coefficients, 4 × 1, of the state [z₁, ż₁, z₂, ż₂] in the relative displacement Δz = z₂ − z₁.
inline Vector<double, 4> displacement_row() { return {-1.0, 0.0, 1.0, 0.0}; }
/// Coefficients, 4 × 1, of the state [z₁, ż₁, z₂, ż₂] in the relative velocity Δż = ż₂ − ż₁.
inline Vector<double, 4> velocity_row() { return {0.0, -1.0, 0.0, 1.0}; }

}  // namespace holdfast
