#pragma once

#include <array>

#include "holdfast/core/types.hpp"

namespace holdfast {

/// State, command and excitation at an instant, on which a change of contact depends.
/// @tparam States  N, the order of the plant
template <int States>
struct ContactInstantOf {
  Vector<double, States> state;  ///< state x, N × 1; for two masses z (m, m/s, m, m/s)
  double command;                ///< command u that acts at the instant (N)
  double force;                  ///< excitation F (N)
};

/// A guard: the function g = state · x + command u + force F + constant, > 0 while a mode lasts.
/// @tparam States  N, the order of the plant
template <int States>
struct GuardOf {
  Vector<double, States> state;  ///< coefficients of x, N × 1; the unit of g is m, m/s or m/s²
  double command = 0.0;          ///< coefficient of the command u, per newton
  double force = 0.0;            ///< coefficient of the excitation F, per newton
  double constant = 0.0;         ///< constant term, in the unit of g
  /// Number of leading terms of g, ġ, g̈, … that are 0 because the contact has just changed.
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
/// A guard of the two masses: a linear function of state, command and excitation.
using Guard = GuardOf<4>;
/// The guards of a mode of the two masses.
using Guards = GuardsOf<4>;

/// Coefficients of the relative displacement Δz = z₂ − z₁ with respect to the state, 4 × 1.
inline Vector<double, 4> displacement_row() { return {-1.0, 0.0, 1.0, 0.0}; }
/// Coefficients of the relative velocity Δż = ż₂ − ż₁ with respect to the state, 4 × 1.
inline Vector<double, 4> velocity_row() { return {0.0, -1.0, 0.0, 1.0}; }

}  // namespace holdfast
