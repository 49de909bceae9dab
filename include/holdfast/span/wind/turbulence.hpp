#pragma once

#include <cmath>

#include "holdfast/core/errors.hpp"

namespace holdfast {

/// The share of its power that a wind keeps where it is turbulent: shedding loses its step with the
/// vibration,
///
///     P_wind(I)/P_wind(0) = 1/√(1 + (I/0.09)²)
///
/// (Foti & Martinelli, J. Sound Vib. 419 (2018), to measurements on lines). It is one law of
/// several, and like all of them uncertain by tens of per cent.
/// @param intensity  I, standard deviation of the speed over its mean, 0 … 1
/// @throws InvalidParameter outside this range
inline double turbulent_share(double intensity) {
  require_within("turbulence intensity", intensity, "", 0.0, 1.0);
  constexpr double halving = 0.09;
  return 1.0 / std::hypot(1.0, intensity / halving);
}

}  // namespace holdfast
