#pragma once

#include <cmath>

#include "holdfast/core/errors.hpp"

namespace holdfast {

/// The ratio of the wind power supplied to a vibrating conductor in turbulent and in steady wind.
/// In turbulent wind the vortex shedding locks in to the vibration for only a part of the time:
///
///     P_wind(I)/P_wind(0) = 1/√(1 + (I/I_L)²),   I_L = 0.09
///
/// The ratio is the mean of the Gaussian lock-in curve exp(−(u − U)²/(2 I_L² U²)) of relative width
/// I_L. The wind speed u is normally distributed with mean U and standard deviation I U.
///
/// Source: Foti & Martinelli, J. Wind Eng. Ind. Aerodyn. (2018), doi 10.1016/j.jweia.2018.09.005,
/// equations 4 and 5, as implemented in two open programs (the article itself was not seen). The
/// ratio is uncertain by tens of per cent. The wider lock-in at larger amplitudes is neglected.
/// @param intensity  turbulence intensity I, standard deviation of the wind speed over its mean,
///                   0 … 1; up to about 0.3 in open country
/// @throws InvalidParameter unless 0 ≤ I ≤ 1
inline double turbulent_share(double intensity) {
  require_within("turbulence intensity", intensity, "", 0.0, 1.0);
  constexpr double lock_in = 0.09;
  return 1.0 / std::hypot(1.0, intensity / lock_in);
}

}  // namespace holdfast
