#pragma once

#include <cstdint>
#include <numeric>
#include <optional>
#include <utility>

#include "holdfast/contact/contact_law.hpp"
#include "holdfast/contact/exact_backlash.hpp"
#include "holdfast/contact/exact_dead_zone.hpp"
#include "holdfast/contact/sampled_law.hpp"
#include "holdfast/core/rational.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/motion/event_motion.hpp"
#include "holdfast/motion/forced_loop.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast {

/// When the drive enters and leaves its backlash.
enum class Switching : std::uint8_t {
  sampled,  ///< at samples, by the law's rule for them
  exact,    ///< when it happens; `kollar`, `immediate` and `play` are one law then
};

/// A loop as it is built: any law of the backlash, switching at samples or when it happens, any
/// excitation, the limits of its sensors, drive and clock.
struct RealLoop {
  TwoDof<double> plant;                      ///< conductor and absorber
  DigitalLoop digital;                       ///< sampling, gains, limits, clock and excitation
  BacklashParameters backlash = {};          ///< the law; by itself `kollar` with r₀ = 0
  Switching switching = Switching::sampled;  ///< when the drive enters and leaves its backlash
};

/// @throws InvalidParameter where any part is not admissible
inline void validate(const RealLoop& loop) {
  validate(loop.plant);
  validate(loop.digital);
  validate(loop.backlash);
}

/// The loop of the paper's model as one that is built.
inline RealLoop real_loop(const ForcedLoop<double>& loop) {
  return {loop.plant,
          {loop.sampling, loop.gains, composed_force(loop.excitation), loop.hold},
          {ContactLaw::kollar, loop.backlash_width},
          Switching::sampled};
}

/// f τ = p/q of the first harmonic, with q the number of samples after which sampling and all
/// harmonics coincide; 0/1 without excitation.
/// @return nothing where they never do, or only after more than 10⁶ samples: incommensurate
///         frequencies, a recorded force, or samples that stray
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

/// Calls `visit` with the motion of the loop from [z₁, ż₁, z₂, ż₂], a HybridMotion whose contact is
/// of the type that the loop asks for.
///
///     with_motion(loop, Vector<double, 4>::Zero(), [](auto motion) { motion.sense(); … });
///
/// @return what `visit` returns, of one type for all of them
/// @throws InvalidParameter where the loop is not admissible
template <class Visit>
auto with_motion(const RealLoop& loop, const Vector<double, 4>& initial_state, Visit&& visit) {
  validate(loop);
  const BacklashParameters& backlash = loop.backlash;
  if (loop.switching == Switching::sampled) {
    const SampledContactMotion contact(loop.plant, backlash);
    return visit(HybridMotion<SampledContactMotion>(loop.digital, contact, initial_state));
  }
  if (backlash.law == ContactLaw::dead_zone) {
    const ExactDeadZone contact(loop.plant, backlash.width, backlash.contact_stiffness,
                                backlash.contact_damping, initial_state);
    return visit(HybridMotion<ExactDeadZone>(loop.digital, contact, initial_state));
  }
  const double width = backlash.law == ContactLaw::none ? 0.0 : backlash.width;
  return visit(
      HybridMotion<ExactBacklash>(loop.digital, ExactBacklash(loop.plant, width), initial_state));
}

}  // namespace holdfast
