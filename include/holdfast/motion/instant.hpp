#pragma once

#include <cmath>

#include "holdfast/core/compiler.hpp"

namespace holdfast {

/// The relative round-off within which the instant j τ of a sample equals a given instant. In
/// doubles, for example, 5 · 0.011 is less than 0.055.
inline constexpr double instant_round_off = 1e-12;

/// Whether a sample at `time` (s) is at or after `instant` (s), up to round-off.
inline bool not_before(double time, double instant) {
  return time >= instant - instant_round_off * std::abs(instant);
}

}  // namespace holdfast
