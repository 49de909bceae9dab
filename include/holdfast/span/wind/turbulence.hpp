#pragma once

#include <cmath>

#include "holdfast/core/errors.hpp"

namespace holdfast {

/// The share of the wind's power that remains in turbulence, since shedding loses synchronisation
/// with the vibration:
///
///     P_wind(I)/P_wind(0) = 1/√(1 + (I/I_L)²),   I_L = 0.09
///
/// The share is the mean of a Gaussian lock-in curve, exp(−(u − U)²/(2 I_L² U²)), over normally
/// distributed speeds u about U with the deviation I U: the share of time and span in which the
/// vortices are synchronised, relative to steady wind.
///
/// Source: Foti & Martinelli, J. Wind Eng. Ind. Aerodyn. (2018), doi 10.1016/j.jweia.2018.09.005,
/// equations 4 and 5, as implemented in two open programs (the article itself was not seen). Such
/// laws are uncertain by tens of per cent. This law does not depend on the amplitude, although the
/// shedding stays synchronised with a larger vibration over a wider range of speeds.
/// @param intensity  turbulence intensity I, standard deviation of the speed over its mean, 0 … 1;
///                   up to about 0.3 in open country
/// @throws InvalidParameter outside this range
inline double turbulent_share(double intensity) {
  require_within("turbulence intensity", intensity, "", 0.0, 1.0);
  constexpr double lock_in = 0.09;
  return 1.0 / std::hypot(1.0, intensity / lock_in);
}

}  // namespace holdfast
