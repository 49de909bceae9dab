#pragma once

#include <array>

#include "holdfast/core/types.hpp"

namespace holdfast {

/// All that a change of contact depends on.
struct ContactInstant {
  Vector<double, 4> state;  ///< z (m, m/s, m, m/s)
  double command;           ///< u, the command in force (N)
  double force;             ///< F (N)
};

/// g = state · z + command u + force F + constant, positive while the contact stays as it is.
struct Guard {
  Vector<double, 4> state;
  double command = 0.0;
  double force = 0.0;
  double constant = 0.0;
  /// How many of g, ġ, g̈, … are zero at this instant because the contact has just changed here.
  int zeros = 0;
  /// The sign of g is not known yet: it is that which g takes first.
  bool unsigned_yet = false;
};

/// The guards of a mode, two at most.
struct Guards {
  std::array<Guard, 2> guard;
  int count = 0;
};

/// Δz = z₂ − z₁ and Δż = ż₂ − ż₁ as functionals of the state.
inline Vector<double, 4> displacement_row() { return {-1.0, 0.0, 1.0, 0.0}; }
inline Vector<double, 4> velocity_row() { return {0.0, -1.0, 0.0, 1.0}; }

}  // namespace holdfast
