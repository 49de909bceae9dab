#pragma once

#include <cmath>
#include <vector>

#include "holdfast/core/errors.hpp"

namespace holdfast {

/// A wind speed and the hours per year during which the wind has about this speed.
struct WindHours {
  double speed;  ///< wind speed U (m/s), > 0
  double hours;  ///< hours per year, ≥ 0
};

/// Table of the hours per year at each wind speed U, by the Weibull distribution P(U > u) =
/// e^{−(u/A)^k}. The range from `lowest` to `highest` is divided into equal steps. Each entry has
/// the middle speed of a step and the hours with speeds in this step. A year has 8766 hours.
/// @param scale    scale A (m/s), > 0
/// @param shape    shape exponent k, > 0
/// @param lowest   lowest wind speed (m/s), ≥ 0
/// @param highest  highest wind speed (m/s), above the lowest
/// @param steps    number of steps, 1 … 10⁶
/// @throws InvalidParameter where an argument is outside its range
inline std::vector<WindHours> weibull_hours(double scale, double shape, double lowest,
                                            double highest, int steps) {
  require_positive("scale of the wind's Weibull distribution", scale, "m/s");
  require_positive("shape of the wind's Weibull distribution", shape, "");
  require_non_negative("lowest wind speed", lowest, "m/s");
  require_within("number of steps of the wind speed", steps, "", 1, 1e6);
  if (!(highest > lowest && std::isfinite(highest)))
    throw InvalidParameter("highest wind speed", highest, "m/s", "above the lowest wind speed");
  constexpr double hours_of_year = 8766.0;
  const auto beyond = [&](double speed) { return std::exp(-std::pow(speed / scale, shape)); };
  std::vector<WindHours> rows;
  for (int j = 0; j < steps; ++j) {
    const double below = lowest + (highest - lowest) * j / steps;
    const double above = lowest + (highest - lowest) * (j + 1) / steps;
    rows.push_back({0.5 * (below + above), hours_of_year * (beyond(below) - beyond(above))});
  }
  return rows;
}

/// A stress amplitude in a conductor and the number of stress cycles per year at this amplitude.
struct StressCycles {
  double stress;  ///< stress amplitude σ (Pa), zero to peak
  double cycles;  ///< number n of cycles per year; values ≤ 0 count as 0
};

/// The fatigue damage per year by Miner's rule: Σ n/N(σ) over the entries (σ, n) of `year`. The
/// inverse of the damage is the number of years to failure, that is, until the first wire breaks.
/// @tparam LifeLine  type of `line` with `cycles(stress)`: number N of cycles to failure at σ (Pa)
template <class LifeLine>
double miner_damage(const std::vector<StressCycles>& year, const LifeLine& line) {
  double damage = 0.0;
  for (const StressCycles& row : year)
    if (row.cycles > 0.0) damage += row.cycles / line.cycles(row.stress);
  return damage;
}

}  // namespace holdfast
