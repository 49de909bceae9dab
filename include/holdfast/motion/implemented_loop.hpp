#pragma once

#include <cstdint>
#include <numeric>
#include <optional>

#include "holdfast/contact/contact.hpp"
#include "holdfast/contact/contact_law.hpp"
#include "holdfast/core/rational.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/motion/event_motion.hpp"
#include "holdfast/motion/ideal_loop.hpp"
#include "holdfast/plant/ports.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast {

/// A loop with the effects of its implementation: any law of the backlash, switching at samples or
/// when it happens, any excitation, the limits of its sensors, drive and clock.
/// @tparam Plant  TwoMass<double> or a LinearPlant<double, N>
template <class Plant>
struct ImplementedLoopOf {
  Plant plant;                               ///< conductor, absorber and what else has states
  DigitalLoop digital;                       ///< sampling, gains, limits, clock and excitation
  BacklashParameters backlash = {};          ///< the law; by itself `kollar` with r₀ = 0
  Switching switching = Switching::sampled;  ///< when the drive enters and leaves its backlash
};

/// That of the two masses.
using ImplementedLoop = ImplementedLoopOf<TwoMass<double>>;

/// @throws InvalidParameter where any part is not admissible
template <class Plant>
void validate(const ImplementedLoopOf<Plant>& loop) {
  validate(loop.plant);
  validate(loop.digital);
  validate(loop.backlash);
}

/// The loop of the paper's model as one that is built.
template <class Plant>
ImplementedLoopOf<Plant> implemented_loop(const IdealLoop<double, Plant>& loop) {
  return {loop.plant,
          {loop.sampling, loop.gains, multi_harmonic_force(loop.excitation), loop.hold},
          {ContactLaw::kollar, loop.backlash_width},
          Switching::sampled};
}

/// f τ = p/q of the first harmonic, with q the number of samples after which sampling and all
/// harmonics coincide; 0/1 without excitation.
/// @return nothing where they never do, or only after more than 10⁶ samples: incommensurate
///         frequencies, a recorded force, or samples that jitter
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

/// The motion of the loop from [z₁, ż₁, z₂, ż₂].
/// @throws InvalidParameter where the loop is not admissible
template <class Plant>
EventMotion<DriveContact<Plant>> event_motion(const ImplementedLoopOf<Plant>& loop,
                                              const StateOf<Plant>& initial_state) {
  validate(loop);
  return {loop.digital,
          DriveContact<Plant>(loop.plant, loop.backlash, loop.switching, initial_state),
          initial_state};
}

/// Calls `visit` with event_motion(loop, initial_state). @return what it returns
/// @throws InvalidParameter where the loop is not admissible
template <class Plant, class Visit>
auto with_motion(const ImplementedLoopOf<Plant>& loop, const StateOf<Plant>& initial_state,
                 Visit&& visit) {
  return visit(event_motion(loop, initial_state));
}

}  // namespace holdfast
