#pragma once

#include <cstdint>
#include <numeric>
#include <optional>

#include "holdfast/control/controller.hpp"
#include "holdfast/control/gains.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/control/sampling_clock.hpp"
#include "holdfast/core/rational.hpp"
#include "holdfast/excitation/harmonic.hpp"
#include "holdfast/excitation/harmonic_input.hpp"
#include "holdfast/excitation/multi_harmonic_force.hpp"

namespace holdfast {

/// The parameters of a digital control loop without its plant: sampling, gains, limits, excitation.
/// With the plant, its contact and the initial state they determine a motion.
struct DigitalLoop {
  Sampling<double> sampling;            ///< sampling period τ and processing delay δ
  PdGains<double> gains;                ///< gains P and D
  MultiHarmonicForce force;             ///< excitation F(t) of the conductor
  ForceHold hold = ForceHold::sampled;  ///< whether F(t), record included, is held between samples
  ControllerLimits limits = {};         ///< limits of the sensors and the drive
  Jitter jitter = {};  ///< jitter of the clock; half width J with 2 J + δ ≤ τ and J < τ/2
};

/// Validates a loop. @throws InvalidParameter where any part is not admissible
inline void validate(const DigitalLoop& loop) {
  validate(loop.sampling, loop.jitter);
  validate(loop.gains);
  validate(loop.force);
  validate(loop.limits);
}

/// The ratio f τ = p/q of the frequency f (Hz) of the first harmonic with nonzero amplitude and the
/// sampling period τ (s). After q samples, the least possible number, all harmonics have the same
/// phases again; p/q need not be in lowest terms. Without such a harmonic it is 0/1. @return
/// nullopt (incommensurate) for a recorded force, jittering samples, q > 10⁶ or f τ ≥ 10¹⁵
inline std::optional<Rational> forcing_ratio(const DigitalLoop& loop) {
  constexpr std::int64_t most_samples = 1'000'000;
  if (loop.force.record != nullptr || loop.jitter.half_width > 0.0) return std::nullopt;
  std::optional<Rational> first;
  std::int64_t together = 1;
  for (const Harmonic& line : loop.force.harmonics) {
    if (line.amplitude == 0.0) continue;
    const double ratio = line.frequency * loop.sampling.period;
    if (!(ratio < 1e15)) return std::nullopt;
    const auto rational = reconstruct_rational(ratio, most_samples);
    if (!rational) return std::nullopt;
    together = std::lcm(together, rational->denominator);
    if (together > most_samples) return std::nullopt;
    if (!first) first = rational;
  }
  if (!first) return Rational{0, 1};
  return Rational{first->numerator * (together / first->denominator), together};
}

}  // namespace holdfast
