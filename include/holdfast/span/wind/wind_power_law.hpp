#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>

#include "holdfast/core/compiler.hpp"

namespace holdfast {

/// A law, from wind-tunnel tests, of the power per length (W/m) that a steady wind supplies to a
/// cylinder. The cylinder vibrates across the wind at the frequency of the vortex shedding:
///
///     P_wind = f³ d⁴ F(y/d),   F(x) = x Σ a_k x^k,   k = 0 … 7
///
/// f (Hz) is the frequency, d (m) the diameter and y (m) the amplitude, zero to peak.
struct WindPowerLaw {
  std::string_view name;               ///< name of the law's authors
  std::array<double, 8> coefficients;  ///< coefficients a_k (W s³/m⁵) of F
  double lowest;                       ///< smallest relative amplitude x = y/d of the fit
  double highest;                      ///< largest relative amplitude x = y/d of the fit

  /// The function F (W s³/m⁵) at the relative amplitude x = y/d; NaN outside the range of the fit.
  double at(double x) const {
    if (!(x >= lowest && x <= highest)) return std::nan("");
    double sum = 0.0;
    for (std::size_t k = coefficients.size(); k-- > 0;) sum = sum * x + coefficients[k];
    return x * sum;
  }

  /// The power P_wind (W/m) at a frequency f (Hz), diameter d (m) and amplitude y (m). NaN where
  /// y/d is outside the range of the fit by more than round-off (relative 10⁻¹⁴).
  double power(double frequency, double diameter, double amplitude) const {
    double x = amplitude / diameter;
    for (const double end : {lowest, highest})
      if (std::abs(x - end) <= 1e-14 * end) x = end;
    return frequency * frequency * frequency * diameter * diameter * diameter * diameter * at(x);
  }
};

/// Two wind power laws, fitted to printed curves of measurements; their powers differ by factors of
/// 1.5 … 2.1. Diana & Falco, Meccanica 6 (1971): rigid cylinders in laminar flow. Brika &
/// Laneville, J. Fluid Mech. 250 (1993): a cylinder with free ends, turbulence below 0.5 %.
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
