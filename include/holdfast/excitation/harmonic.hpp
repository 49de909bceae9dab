#pragma once

#include <cmath>

#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"

namespace holdfast {

/// One harmonic of an excitation, F cos(2π f t + φ).
struct Harmonic {
  double amplitude;    ///< amplitude F (N), ≥ 0
  double frequency;    ///< frequency f (Hz), > 0
  double phase = 0.0;  ///< phase φ (rad)

  /// The angular frequency ω = 2π f (rad/s).
  double angular_frequency() const { return 2.0 * pi<double> * frequency; }

  /// The angle 2π f t + φ (rad) at a time t (s), reduced by the whole cycles in f t. Its error is a
  /// few round-offs of 2π + |φ|, however large t is.
  double angle(double time) const {
    const double cycles = frequency * time;
    const double rounded_off = std::fma(frequency, time, -cycles);
    return 2.0 * pi<double> * ((cycles - std::floor(cycles)) + rounded_off) + phase;
  }

  /// The force F cos(2π f t + φ) (N) at a time t (s).
  double at(double time) const { return amplitude * std::cos(angle(time)); }
};

/// Validates a harmonic. @throws InvalidParameter unless F ≥ 0 and f > 0, and F, f, φ are finite
inline void validate(const Harmonic& harmonic) {
  require_non_negative("harmonic amplitude", harmonic.amplitude, "N");
  require_positive("harmonic frequency", harmonic.frequency, "Hz");
  require_finite("harmonic phase", harmonic.phase, "rad");
}

}  // namespace holdfast
