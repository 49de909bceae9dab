#pragma once

#include <cmath>

#include "holdfast/span/wind/wind_power_law.hpp"

namespace holdfast {

/// Position of the `BalancedAmplitude` relative to the amplitude range of the wind power law.
enum class BalanceRange {
  within,  ///< inside the range: the returned amplitude is the balanced amplitude
  below,   ///< below the range: the smallest amplitude of the law is returned as an upper bound
  above    ///< above the range: the largest amplitude of the law is returned as a lower bound
};

/// The balanced amplitude: wind power and power loss of the span are equal at this amplitude.
struct BalancedAmplitude {
  double amplitude;    ///< amplitude y (m), zero to peak, at the antinodes
  BalanceRange range;  ///< whether y is the balanced amplitude or only a bound
};

/// The amplitude y of aeolian vibration at which the wind power equals the power loss p:
///
///     f³ d⁴ F(y/d) = p(y)
///
/// The largest solution y is returned. This vibration is stable, because the loss exceeds the wind
/// power at larger amplitudes. y is bracketed on a grid of 61 amplitudes and refined by bisection
/// to a relative error of 10⁻¹². Two solutions between neighbouring grid points are missed.
/// @param law        wind power law; defines F and the range of y/d
/// @param frequency  frequency f (Hz) of the vibration, > 0
/// @param diameter   diameter d (m) of the conductor, > 0
/// @param loss       function p(y) of the amplitude y (m): power loss per length (W/m), averaged
///                   over the span. If p is NaN at the largest y of the law, the result is NaN
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
