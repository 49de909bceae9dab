#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>

#include "holdfast/core/compiler.hpp"

namespace holdfast {

/// Power a length (W/m) that a steady wind gives a cylinder vibrating across it at the frequency at
/// which it sheds vortices, measured in a wind tunnel:
///
///     P_wind = f³ d⁴ F(y/d),   F(x) = x Σ a_k x^k,   k = 0 … 7
///
/// f (Hz) is the frequency, d (m) the diameter and y (m) the amplitude, half the peak-to-peak.
struct WindPowerLaw {
  std::string_view name;               ///< of those who measured it
  std::array<double, 8> coefficients;  ///< a_k (W s³/m⁵)
  double lowest;                       ///< x from which the fit holds
  double highest;                      ///< and to which

  /// F at x = y/d; NaN outside what the fit holds for.
  double at(double x) const {
    if (!(x >= lowest && x <= highest)) return std::nan("");
    double sum = 0.0;
    for (std::size_t k = coefficients.size(); k-- > 0;) sum = sum * x + coefficients[k];
    return x * sum;
  }

  /// P_wind (W/m); an amplitude that is an end of the fit but for round-off is that end.
  double power(double frequency, double diameter, double amplitude) const {
    double x = amplitude / diameter;
    for (const double end : {lowest, highest})
      if (std::abs(x - end) <= 1e-14 * end) x = end;
    return frequency * frequency * frequency * diameter * diameter * diameter * diameter * at(x);
  }
};

/// Two measured laws, which differ by a factor: rigid cylinders in laminar flow (Diana & Falco,
/// Meccanica 6 (1971)), and one in a turbulence below 0.5 % whose ends were free (Brika &
/// Laneville, J. Fluid Mech. 250 (1993)), as fits of the printed curves.
inline constexpr std::array<WindPowerLaw, 2> wind_power_laws = {
    WindPowerLaw{
        "diana_falco",
        {3.12858, 208.972, -1048.68829, 3894.56424, -8396.67235, 9919.9573, -6137.30905, 1573.9704},
        0.01,
        0.85},
    WindPowerLaw{"brika_laneville",
                 {1.79838, 118.93429, -432.36754, 2188.63016, -11857.16738, 39612.62833,
                  -68607.57765, 45073.019},
                 0.01,
                 0.4}};

}  // namespace holdfast
