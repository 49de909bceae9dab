#pragma once

#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"

namespace holdfast {

/// The excitation F(t) = F_m cos(2π f t) of the conductor. Source: Kollár 2022, Eq. (4).
template <class Scalar>
struct HarmonicExcitation {
  Scalar amplitude;  ///< amplitude F_m (N), ≥ 0
  Scalar frequency;  ///< frequency f (Hz), > 0

  /// The angular frequency ω = 2π f (rad/s).
  Scalar angular_frequency() const { return Scalar(2) * pi<Scalar> * frequency; }
};

/// The phasor of a harmonic excitation at a sample j. A unit phasor has F_m = 1 without unit.
template <class Scalar>
struct ExcitationSample {
  Scalar cosine;  ///< F_m cos ω t_j (N)
  Scalar sine;    ///< F_m sin ω t_j (N)
};

/// Validates an excitation. @throws InvalidParameter unless F_m ≥ 0 and f > 0, both finite
inline void validate(const HarmonicExcitation<double>& excitation) {
  require_non_negative("excitation amplitude", excitation.amplitude, "N");
  require_positive("excitation frequency", excitation.frequency, "Hz");
}

}  // namespace holdfast
