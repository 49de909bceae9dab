#pragma once

#include <cmath>

#include "holdfast/span/wind/wind_power_law.hpp"

namespace holdfast {

/// Relation of the balanced amplitude to the range of the wind's law.
enum class BalanceRange {
  within,  ///< within the law's range
  below,   ///< below the law's smallest amplitude, which is returned
  above    ///< above the law's largest amplitude, which is returned
};

/// The amplitude at which the wind's power equals the power losses.
struct BalancedAmplitude {
  double amplitude;    ///< amplitude y (m), half the peak-to-peak, at the antinodes
  BalanceRange range;  ///< whether y is the balanced amplitude or only a bound
};

/// The amplitude of aeolian vibration at one frequency by the energy balance: the largest amplitude
/// at which the wind's power is not less than the losses,
///
///     f³ d⁴ F(y/d) = p(y)
///
/// At larger amplitudes the losses exceed the wind's power, so that this vibration is stable. Its
/// amplitude is found by bisection between the points of a grid, to a relative 10⁻¹².
/// @param law        law of the wind's power
/// @param frequency  frequency f (Hz), > 0
/// @param diameter   conductor's diameter d (m), > 0
/// @param loss       function p from an amplitude (m) to the total loss per length (W/m), mean over
///                   the span; NaN makes the result NaN
/// @throws the exceptions of `loss`
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
