#pragma once

#include <array>

#include "holdfast/core/types.hpp"

namespace holdfast {

/// All that a change of contact depends on.
/// @tparam States  N, the order of the plant
template <int States>
struct ContactInstantOf {
  Vector<double, States> state;  ///< x, N × 1; of the two masses z (m, m/s, m, m/s)
  double command;                ///< u, the command in force (N)
  double force;                  ///< F (N)
};

/// g = state · x + command u + force F + constant, positive while the contact stays as it is.
/// @tparam States  N, the order of the plant
template <int States>
struct GuardOf {
  Vector<double, States> state;  ///< N × 1; g is in m, m/s or m/s², as the mode has it
  double command = 0.0;          ///< per newton of u
  double force = 0.0;            ///< per newton of F
  double constant = 0.0;         ///< in the unit of g
  /// How many of g, ġ, g̈, … are zero at this instant because the contact has just changed here.
  int zeros = 0;
  /// The sign of g is not known yet: it is that which g takes first.
  bool unsigned_yet = false;
};

/// The guards of a mode, two at most.
/// @tparam States  N, the order of the plant
template <int States>
struct GuardsOf {
  std::array<GuardOf<States>, 2> guard;  ///< the first `count` of them mean something
  int count = 0;                         ///< 0: the contact stays as it is, for any motion
};

/// Instant of the two masses.
using ContactInstant = ContactInstantOf<4>;
/// Guard of the two masses.
using Guard = GuardOf<4>;
/// Guards of the two masses.
using Guards = GuardsOf<4>;

/// Δz = z₂ − z₁ as a functional of the state, 4 × 1.
inline Vector<double, 4> displacement_row() { return {-1.0, 0.0, 1.0, 0.0}; }
/// Δż = ż₂ − ż₁ as a functional of the state, 4 × 1.
inline Vector<double, 4> velocity_row() { return {0.0, -1.0, 0.0, 1.0}; }

}  // namespace holdfast
