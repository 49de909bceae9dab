#pragma once

#include <cmath>

#include "holdfast/span/wind/wind_power_law.hpp"

namespace holdfast {

/// Where an amplitude by the energy balance lies.
enum class BalanceRange {
  within,  ///< where the law of the wind holds
  below,   ///< smaller than the smallest amplitude of the law, which stands for it
  above    ///< larger than the largest one, which stands for it
};

/// The amplitude at which a wind gives a conductor what it loses.
struct BalancedAmplitude {
  double amplitude;    ///< y (m), half the peak-to-peak, at the antinodes
  BalanceRange range;  ///< whether that is it, or a bound
};

/// The amplitude of aeolian vibration at one frequency by the energy balance: the largest one at
/// which the wind gives no less than is lost,
///
///     f³ d⁴ F(y/d) = p(y)
///
/// Above it more is lost than given, so that a vibration that got there stays. Found by halving
/// between the points of a grid, to 10⁻¹² of itself.
/// @param law        of the wind
/// @param frequency  f (Hz), > 0
/// @param diameter   d (m), > 0
/// @param loss       p: an amplitude (m) to a power a length (W/m), of everything that takes any,
///                   over the span; NaN makes the answer NaN
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
