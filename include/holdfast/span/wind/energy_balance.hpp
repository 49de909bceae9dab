#pragma once

#include <cmath>

#include "holdfast/span/wind/wind_power_law.hpp"

namespace holdfast {

/// Position of the balanced amplitude relative to the amplitude range of the wind power law.
enum class BalanceRange {
  within,  ///< within the range of the law
  below,   ///< below the smallest amplitude of the law, which is returned
  above    ///< above the largest amplitude of the law, which is returned
};

/// The amplitude at which the power of the wind equals the power losses of the span.
struct BalancedAmplitude {
  double amplitude;    ///< amplitude y (m), zero to peak, at the antinodes
  BalanceRange range;  ///< whether y is the balanced amplitude or only a bound
};

/// The amplitude y of aeolian vibration at one frequency, where wind power and losses p are equal:
///
///     f³ d⁴ F(y/d) = p(y)
///
/// The largest solution is returned. At larger amplitudes the losses exceed the wind's power, so
/// that this vibration is stable. A grid of 61 amplitudes brackets y, and bisection finds it to a
/// relative 10⁻¹². Two solutions between neighbouring points of the grid are missed.
/// @param law        wind power law with the function F and its range
/// @param frequency  frequency f (Hz), > 0
/// @param diameter   conductor's diameter d (m), > 0
/// @param loss       function p of the amplitude (m): the total loss per length (W/m), mean over
///                   the span. If p is NaN at the largest amplitude of the law, the result is NaN
/// @throws whatever `loss` throws
template <class Loss>
BalancedAmplitude balanced_amplitude(const WindPowerLaw& law, double frequency, double diameter,
                                     const Loss& loss) {
  const auto excess = [&](double x) {
    return law.power(frequency, diameter, x * diameter) - loss(x * diameter);
  };
  if (std::isnan(excess(law.highest))) return {std::nan(""), BalanceRange::within};
  if (excess(law.highest) >= 0.0) return {law.highest * diameter, BalanceRange::above};
  constexpr int points = 60;
  const double ratio = std::pow(law.lowest / law.highest, 1.0 / points);
  double lost = law.highest;
  for (int k = 1; k <= points; ++k) {
    const double x = k < points ? law.highest * std::pow(ratio, k) : law.lowest;
    if (!(excess(x) >= 0.0)) {
      lost = x;
      continue;
    }
    double given = x;
    while (lost - given > 1e-12 * lost) {
      const double middle = 0.5 * (given + lost);
      if (middle <= given || middle >= lost) break;
      (excess(middle) >= 0.0 ? given : lost) = middle;
    }
    return {given * diameter, BalanceRange::within};
  }
  return {law.lowest * diameter, BalanceRange::below};
}

}  // namespace holdfast
