#pragma once

#include "holdfast/cable/taut_string.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/span/device/lumped_device.hpp"
#include "holdfast/span/life/clamp_bending.hpp"
#include "holdfast/span/wind/self_damping_law.hpp"

namespace holdfast {

/// ACSR Drake, 300 m, at a fifth of its rated strength.
inline TautString<double> drake_string() { return {28020.0, 1.628, 300.0, 0.0}; }
inline StrandedConductor drake_strand() { return {1.628, 0.02814, 140.1e3, 28020.0}; }
inline ClampBending drake_clamp() { return {28020.0, 44.35, 4.44e-3, 69e9}; }

/// To ground (N s/m).
inline LumpedDevice dashpot_of(double damping) { return {{{damping}}, 0.0}; }

inline double turn_of(double frequency) { return 2.0 * pi<double> * frequency; }

}  // namespace holdfast
