#pragma once

#include "holdfast/core/types.hpp"
#include "holdfast/excitation/harmonic_excitation.hpp"
#include "support/testing.hpp"

namespace holdfast {

/// F_m cos(ω j τ) and F_m sin(ω j τ); whole cycles are removed first, so that j may be large.
template <class Scalar>
ExcitationSample<Scalar> sample_excitation(const HarmonicExcitation<Scalar>& excitation,
                                           const Scalar& sampling_period, std::int64_t index) {
  using std::cos;
  using std::floor;
  using std::sin;
  const Scalar cycles =
      Scalar(static_cast<double>(index)) * (excitation.frequency * sampling_period);
  const Scalar phase = Scalar(2) * pi<Scalar> * (cycles - floor(cycles));
  return {excitation.amplitude * cos(phase), excitation.amplitude * sin(phase)};
}

}  // namespace holdfast
