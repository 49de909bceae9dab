#pragma once

#include <array>

#include "holdfast/core/types.hpp"

namespace holdfast {

/// The data that a change of contact depends on.
/// @tparam States  N, the order of the plant
template <int States>
struct ContactInstantOf {
  Vector<double, States> state;  ///< x, N × 1; for two masses z (m, m/s, m, m/s)
  double command;                ///< u, the command in force (N)
  double force;                  ///< F (N)
};

/// A guard g = state · x + command u + force F + constant, positive while the contact persists.
/// @tparam States  N, the order of the plant
template <int States>
struct GuardOf {
  Vector<double, States> state;  ///< N × 1; g in m, m/s or m/s², depending on the mode
  double command = 0.0;          ///< per newton of u
  double force = 0.0;            ///< per newton of F
  double constant = 0.0;         ///< in the unit of g
  /// How many of g, ġ, g̈, … vanish at this instant because the contact has just changed here.
  int zeros = 0;
  /// Whether the sign of g is still unknown; it is the first one that g takes.
  bool unsigned_yet = false;
};

/// The guards of a mode, at most two.
/// @tparam States  N, the order of the plant
template <int States>
struct GuardsOf {
  std::array<GuardOf<States>, 2> guard;  ///< the first `count` are valid
  int count = 0;                         ///< 0: the contact never changes
};

/// The instant of a change of contact of the two masses.
using ContactInstant = ContactInstantOf<4>;
/// A guard of the two masses.
using Guard = GuardOf<4>;
/// The guards of a mode of the two masses.
using Guards = GuardsOf<4>;

/// The functional Δz = z₂ − z₁ of the state, 4 × 1.
inline Vector<double, 4> displacement_row() { return {-1.0, 0.0, 1.0, 0.0}; }
/// The functional Δż = ż₂ − ż₁ of the state, 4 × 1.
inline Vector<double, 4> velocity_row() { return {0.0, -1.0, 0.0, 1.0}; }

}  // namespace holdfast
