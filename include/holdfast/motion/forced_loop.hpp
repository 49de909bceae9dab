#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include "holdfast/contact/hysteresis.hpp"
#include "holdfast/control/gains.hpp"
#include "holdfast/control/loop_input.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/core/rational.hpp"
#include "holdfast/excitation/forcing.hpp"
#include "holdfast/excitation/harmonic_excitation.hpp"
#include "holdfast/motion/sampled_motion.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast {

/// The sampled loop with its excitation and its backlash: all that a motion depends on beside its
/// initial state.
template <class Scalar>
struct ForcedLoop {
  TwoDof<Scalar> plant;                   ///< conductor and absorber
  Sampling<Scalar> sampling;              ///< τ and δ
  PdGains<Scalar> gains;                  ///< P and D
  HarmonicExcitation<Scalar> excitation;  ///< F_m and f
  Scalar backlash_width = Scalar(0);      ///< r₀ (m), ≥ 0
  ForceHold hold = ForceHold::sampled;    ///< how the harmonic force is taken over a sample
};

/// @throws InvalidParameter where any part is not admissible
inline void validate(const ForcedLoop<double>& loop) {
  validate(loop.plant);
  validate(loop.sampling);
  validate(loop.gains);
  validate(loop.excitation);
  validate_backlash_width(loop.backlash_width);
}

/// The same numbers in another number type, for instance `long double`.
template <class To, class From>
ForcedLoop<To> converted(const ForcedLoop<From>& loop) {
  return {converted<To>(loop.plant),
          {To(loop.sampling.period), To(loop.sampling.processing_delay)},
          {To(loop.gains.proportional), To(loop.gains.differential)},
          {To(loop.excitation.amplitude), To(loop.excitation.frequency)},
          To(loop.backlash_width),
          loop.hold};
}

/// f τ = p/q in lowest terms: sampling and excitation coincide every q samples, p periods of the
/// excitation. Without excitation 0/1.
/// @param loop             of which f, τ and F_m are looked at
/// @param largest_samples  ≥ 1; beyond 10⁶ it counts as 10⁶, since to the precision of its digits
///                         every number is a fraction with a larger q
/// @return nothing where f τ is no fraction with q ≤ largest_samples: then the two count as
///         incommensurate
inline std::optional<Rational> forcing_ratio(const ForcedLoop<double>& loop,
                                             std::int64_t largest_samples = 1'000'000) {
  if (loop.excitation.amplitude == 0.0) return Rational{0, 1};
  const double ratio = loop.excitation.frequency * loop.sampling.period;
  if (!(ratio < 1e15)) return std::nullopt;
  return reconstruct_rational(ratio, std::min<std::int64_t>(largest_samples, 1'000'000));
}

namespace detail {

template <class Scalar>
void validate_motion(const ForcedLoop<Scalar>& loop, const Vector<Scalar, 4>& initial_state) {
  validate(converted<double>(loop));
  require_finite("initial state", static_cast<double>(initial_state.sum()), "");
}

}  // namespace detail

/// The motion of a sampled loop whose forcing repeats every q samples.
template <class Scalar>
using PeriodicallyForcedMotion = SampledMotion<Scalar, Backlash<Scalar>, PeriodicForcing<Scalar>>;

/// The motion from an initial state [z₁, ż₁, z₂, ż₂], the forcing being exactly periodic.
/// @param loop           the phases of the forcing come from `ratio`, not from its f
/// @param ratio          of forcing_ratio()
/// @param initial_state  z₀, 4 × 1 (m, m/s, m, m/s)
/// @throws InvalidParameter where the loop or the state is not admissible
template <class Scalar>
PeriodicallyForcedMotion<Scalar> periodically_forced_motion(
    const ForcedLoop<Scalar>& loop, const Rational& ratio, const Vector<Scalar, 4>& initial_state) {
  detail::validate_motion(loop, initial_state);
  const SampledLoop<Scalar> sampled = sampled_loop(loop.plant, loop.sampling);
  const HarmonicInput<Scalar> input =
      harmonic_input(loop.plant, sampled, loop.hold, loop.excitation.angular_frequency());
  return {sampled, loop.gains, PeriodicForcing<Scalar>(input, loop.excitation.amplitude, ratio),
          Backlash<Scalar>(loop.backlash_width), initial_state};
}

/// The motion from an initial state [z₁, ż₁, z₂, ż₂], whatever the ratio of the frequencies.
/// @throws InvalidParameter where the loop or the state is not admissible
template <class Scalar>
SampledMotion<Scalar> harmonically_forced_motion(const ForcedLoop<Scalar>& loop,
                                                 const Vector<Scalar, 4>& initial_state) {
  detail::validate_motion(loop, initial_state);
  const SampledLoop<Scalar> sampled = sampled_loop(loop.plant, loop.sampling);
  const HarmonicInput<Scalar> input =
      harmonic_input(loop.plant, sampled, loop.hold, loop.excitation.angular_frequency());
  return {sampled,      loop.gains, input, loop.excitation, Backlash<Scalar>(loop.backlash_width),
          initial_state};
}

}  // namespace holdfast
