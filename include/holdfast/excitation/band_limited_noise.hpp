#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/excitation/harmonic.hpp"

namespace holdfast {

/// Parameters of a random force with a flat spectrum between two frequencies.
struct NoiseBand {
  double rms;              ///< root mean square σ (N) of the force, ≥ 0
  double lowest;           ///< lower end f_a (Hz) of the band, ≥ 0
  double highest;          ///< upper end f_b (Hz) of the band, > f_a
  int lines = 1000;        ///< number n of harmonics in the band, ≥ 1
  std::uint64_t seed = 1;  ///< seed of the random phases
};

/// Validates a noise band. @throws InvalidParameter unless σ ≥ 0, 0 ≤ f_a < f_b, n ≥ 1, all finite
inline void validate(const NoiseBand& band) {
  require_non_negative("noise rms", band.rms, "N");
  require_non_negative("noise lowest frequency", band.lowest, "Hz");
  if (!(std::isfinite(band.highest) && band.highest > band.lowest)) {
    throw InvalidParameter("noise highest frequency", band.highest, "Hz",
                           "finite and above the lowest frequency");
  }
  if (band.lines < 1) throw InvalidParameter("noise lines", band.lines, "", ">= 1");
}

/// Band-limited noise F(t) as a sum of n harmonics of equal amplitude and random phase. The
/// harmonics' frequencies are the midpoints of n equal parts of the band:
///
///     F(t) = Σ_{i=0}^{n−1} σ √(2/n) cos(2π f_i t + φ_i),
///     f_i = f_a + (i + ½) Δ,   Δ = (f_b − f_a)/n,   φ_i independent, uniform in [0, 2π)
///
/// The one-sided power spectral density of F, averaged over each of the n parts, is σ²/(f_b − f_a).
/// Outside the band it is zero. At every t, F(t) has mean 0 and variance σ² over all random phases,
/// and its distribution tends to a Gaussian one as n grows. With fixed phases, the mean square of F
/// over a long time is σ², and |F| ≤ √(2n) σ.
///
/// Repetition: the harmonics are Δ apart, so that the envelope of F repeats after T = 1/Δ. For
/// n ≥ 2, F itself repeats after q T, where f_a T + ½ = p/q in lowest terms, and never if f_a T is
/// irrational. To avoid repetition within a motion, take n ≥ (f_b − f_a) times its duration.
///
/// φ_i is 2π times the upper 53 bits of output i of `std::mt19937_64`, divided by 2⁵³. Equal seeds
/// give equal phases with every C++ standard library.
///
/// Source: Shinozuka and Deodatis 1991, Applied Mechanics Reviews 44, simulation of stochastic
/// processes by spectral representation.
/// @return n harmonics, the lowest frequency first
/// @throws InvalidParameter where the band is not admissible
inline std::vector<Harmonic> band_limited_noise(const NoiseBand& band) {
  validate(band);
  const double amplitude = std::sqrt(2.0 / band.lines) * band.rms;
  std::mt19937_64 engine(band.seed);
  std::vector<Harmonic> harmonics;
  harmonics.reserve(static_cast<std::size_t>(band.lines));
  for (int line = 0; line < band.lines; ++line) {
    const double share = (line + 0.5) / band.lines;
    const double cycles = static_cast<double>(engine() >> 11U) * 0x1.0p-53;
    harmonics.push_back(
        {amplitude, band.lowest + share * (band.highest - band.lowest), 2.0 * pi<double> * cycles});
  }
  return harmonics;
}

}  // namespace holdfast
