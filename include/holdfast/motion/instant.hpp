#pragma once

#include <cmath>

#include "holdfast/core/compiler.hpp"

namespace holdfast {

/// The relative tolerance within which the computed instant j τ of sample j counts as equal to a
/// given instant. Rounding may make j τ too small: in doubles 5 · 0.011 < 0.055.
inline constexpr double instant_round_off = 1e-12;

/// Whether a sample at `time` (s) is at or after `instant` (s), within `instant_round_off`.
inline bool not_before(double time, double instant) {
  return time >= instant - instant_round_off * std::abs(instant);
}

}  // namespace holdfast
