#include "jobs/orbit/neighbours.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "holdfast/phase_space/attractor_set.hpp"
#include "process/interrupt.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

/// Time shift of a state relative to the orbit's first sample, in steps of the common period, by
/// the nearest point of the orbit.
std::size_t nearest_stroboscopic_instant(const PeriodicOrbit& orbit,
                                         const Vector<double, 4>& state) {
  const auto step = static_cast<std::size_t>(orbit.ratio.denominator);
  std::size_t nearest = 0;
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t j = 0; j < orbit.states.size(); j += step) {
    const double distance = (orbit.states[j].head<4>() - state).cwiseAbs().maxCoeff();
    if (distance < smallest) nearest = j / step;
    smallest = std::min(smallest, distance);
  }
  return nearest;
}

SettledMotion settled(const IdealLoop<double>& loop, const Vector<double, 4>& state) {
  OrbitLimits limits;
  limits.watch = throw_if_interrupted;
  return {state, find_periodic_orbit(loop, state, limits)};
}

}  // namespace

std::string meeting_text(const IdealLoop<double>& loop, const SettledMotion& reference,
                         const SettledMotion& other) {
  const PeriodicOrbit *first = reference.orbit(), *second = other.orbit();
  if (first == nullptr || second == nullptr) return "unknown: an orbit is not certified";
  if (!is_phase_shifted_copy(*first, *second)) return "different orbits";
  const std::int64_t period = first->period_samples();
  // Long enough for either motion to be far nearer to its own phase than to the next one.
  const std::int64_t settled = std::max(reference.search.samples, other.search.samples);
  const std::int64_t samples = (settled / period + 8) * period;
  const auto phase = [&](const SettledMotion& motion) {
    auto moving = periodically_forced_motion(loop, first->ratio, motion.initial_state);
    for (std::int64_t j = 0; j < samples; ++j) {
      moving.sense();
      moving.advance();
    }
    return nearest_stroboscopic_instant(*first, moving.state());
  };
  const auto copies = first->states.size() / static_cast<std::size_t>(first->ratio.denominator);
  const std::size_t later = (phase(reference) + copies - phase(other)) % copies;
  if (later == 0) return "meet: the same orbit in the same phase";
  return "stay apart: the same orbit, shifted in time by " + std::to_string(later) + " of its " +
         std::to_string(copies) + " coincidences of sampling and forcing";
}

std::string apart_text(const IdealLoop<double>& loop, const Vector<double, 4>& reference,
                       const Vector<double, 4>& other) {
  const SettledMotion one = settled(loop, reference), two = settled(loop, other);
  const PeriodicOrbit *first = one.orbit(), *second = two.orbit();
  if (first == nullptr || second == nullptr)
    return "no certified orbit was found for " +
           std::string(first == second ? "either motion" : "one of the two motions") +
           ", so the reason is unknown";
  const std::string period = std::to_string(first->period_samples()) + " samples";
  if (!is_phase_shifted_copy(*first, *second))
    return "the motions settle on two different certified orbits, of " + period + " and of " +
           std::to_string(second->period_samples());
  const std::string meeting = meeting_text(loop, one, two);
  const std::string orbit = "both motions settle on one certified orbit of " + period;
  if (meeting.rfind("meet", 0) != 0) return orbit + ", but in different phases, and " + meeting;
  return orbit + " in the same phase, so they will meet: the orbit's largest multiplier is " +
         format_rounded(first->largest_multiplier()) + " per period";
}

}  // namespace holdfast::program
