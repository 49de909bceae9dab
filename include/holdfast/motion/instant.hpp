#pragma once

#include <cmath>

#include "holdfast/core/compiler.hpp"

namespace holdfast {

/// Relative round-off by which a sample j τ may miss the instant that it was meant to be: 5 · 0.011
/// is less than 0.055.
inline constexpr double instant_round_off = 1e-12;

/// Whether a sample at `time` (s) comes at or after `instant` (s), round-off apart: an instant
/// meant as a sample is one.
inline bool not_before(double time, double instant) {
  return time >= instant - instant_round_off * std::abs(instant);
}

}  // namespace holdfast
