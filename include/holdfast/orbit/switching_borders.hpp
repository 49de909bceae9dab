#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "holdfast/contact/hysteresis.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/orbit/itinerary_maps.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast {

/// The surfaces on which the drive changes its contact; Δz = z₂ − z₁ is the relative displacement.
enum class SwitchingSurface {
  reversal,   ///< Δż = 0 while the drive transmits: the drive enters the gap of its backlash
  gap_lower,  ///< Δz at the lower end of the gap: the drive leaves the gap
  gap_upper,  ///< Δz at the upper end of the gap: the drive leaves the gap
};

/// The switching surface nearest to a motion, and the sample at which the motion is nearest to it.
struct Border {
  double distance = std::numeric_limits<double>::infinity();  ///< least distance (m; reversal: m/s)
  SwitchingSurface surface = SwitchingSurface::reversal;      ///< no meaning if `sample` is −1
  std::int64_t sample = -1;  ///< index of the nearest sample, from 0; −1: no surface is relevant
};

/// The backlash law's decision at one sample: whether the drive transmits, and why.
struct ContactDecision {
  bool was_inside;  ///< whether the drive is in its gap before the sample
  bool engaged;     ///< whether the drive transmits (is engaged) after the sample
  /// The sign of Δż (1 for Δż = 0) if the contact at this or the next sample depends on that sign;
  /// 0 if the drive stays inside its gap, and without backlash.
  std::int8_t velocity_sign;
  /// Exit from the gap at this sample: −1 by its lower end, 1 by its upper end, 0 none.
  std::int8_t exit_side;
};

/// The contact decisions of one period and the memory of the backlash law before the first sample.
struct SwitchingPattern {
  std::vector<ContactDecision> decisions;               ///< decisions, one for each sample
  BacklashMemory<double> memory{false, 0.0, 0.0, 0.0};  ///< memory before the first sample
  bool repeats = false;  ///< whether contact and gap position after the period equal those before

  /// Whether the drive never leaves its gap.
  bool stays_inside() const {
    return std::all_of(decisions.begin(), decisions.end(), [](const ContactDecision& decision) {
      return decision.was_inside && !decision.engaged;
    });
  }
};

namespace detail {

template <class Scalar>
ContactDecision decide(Backlash<Scalar>& law, const Vector<Scalar, 5>& state) {
  const Scalar displacement = relative_displacement(state), velocity = relative_velocity(state);
  ContactDecision decision{law.inside(), false, 0, 0};
  const Scalar lower = law.lower();
  decision.engaged = law.step(displacement, velocity);
  const bool velocity_counts = decision.engaged || !decision.was_inside;
  if (velocity_counts && law.width() > Scalar(0))
    decision.velocity_sign = velocity < Scalar(0) ? std::int8_t{-1} : std::int8_t{1};
  if (decision.was_inside && decision.engaged)
    decision.exit_side = displacement < lower ? std::int8_t{-1} : std::int8_t{1};
  return decision;
}

/// Calls visit(sample, surface, distance) for every surface on which the contact decision at a
/// sample depends, with the distances of borders_of().
template <class Scalar, class Visit>
void for_each_border(const SwitchingPattern& pattern, const std::vector<Vector<Scalar, 5>>& states,
                     double width, const Visit& visit) {
  double lower = pattern.memory.lower, upper = pattern.memory.upper;
  const std::size_t samples = states.size();
  // The first turn finds the gap in which the motion begins.
  for (std::size_t k = 0; k < 2 * samples; ++k) {
    const std::size_t j = k % samples;
    const ContactDecision& decision = pattern.decisions[j];
    const double displacement = relative_displacement(states[j]);
    if (!decision.was_inside && !decision.engaged) {
      const bool from_positive = pattern.decisions[(j + samples - 1) % samples].velocity_sign > 0;
      lower = from_positive ? displacement - width : displacement;
      upper = lower + width;
    }
    if (k < samples) continue;
    if (decision.velocity_sign != 0)
      visit(j, SwitchingSurface::reversal, decision.velocity_sign * relative_velocity(states[j]));
    if (!decision.was_inside) continue;
    const double inward = decision.engaged ? -1.0 : 1.0;
    if (decision.exit_side <= 0)
      visit(j, SwitchingSurface::gap_lower, inward * (displacement - lower));
    if (decision.exit_side > 0 || !decision.engaged)
      visit(j, SwitchingSurface::gap_upper, inward * (upper - displacement));
  }
}

}  // namespace detail

/// Applies the backlash law along an orbit for two to four periods, until contact and gap position
/// repeat after a period. @return the contact decisions of the last period
/// @param states  states [z₁, ż₁, z₂, ż₂; u_{j−1}] at the samples of one period
/// @param law     backlash law with its memory before the first sample
template <class Scalar>
SwitchingPattern switching_pattern(const std::vector<Vector<Scalar, 5>>& states,
                                   Backlash<Scalar> law) {
  SwitchingPattern pattern;
  pattern.decisions.reserve(states.size());
  for (int turn = 0; turn < 4 && !pattern.repeats; ++turn) {
    const BacklashMemory<Scalar> before = law.memory();
    pattern.decisions.clear();
    for (const auto& state : states) pattern.decisions.push_back(detail::decide(law, state));
    const bool same_gap =
        before.inside == law.inside() && (!before.inside || before.lower == law.lower());
    pattern.repeats = turn > 0 && same_gap;
    pattern.memory = {before.inside, static_cast<double>(before.lower),
                      static_cast<double>(before.upper),
                      static_cast<double>(before.previous_velocity)};
  }
  return pattern;
}

/// Whether a pattern repeats (SwitchingPattern::repeats) and has the contacts of an itinerary.
inline bool has_itinerary(const SwitchingPattern& pattern, const Itinerary& itinerary) {
  return pattern.repeats &&
         std::equal(pattern.decisions.begin(), pattern.decisions.end(), itinerary.begin(),
                    itinerary.end(), [](const ContactDecision& decision, std::uint8_t contact) {
                      return decision.engaged == (contact != 0);
                    });
}

/// The switching surfaces nearest to a motion: one for Δz, one for Δż.
struct Borders {
  Border displacement;  ///< nearest end of a gap (m)
  Border velocity;      ///< nearest reversal, Δż = 0 (m/s)
};

/// The least distances of a motion's states from the switching surfaces on which a contact decision
/// of a pattern would change; negative where a state already contradicts the pattern.
///
/// At a sample inside the gap, the distance of Δz from the nearer end counts. At a sample where the
/// drive leaves the gap, |Δż| and the excess of Δz beyond the end count. Elsewhere |Δż| counts.
/// @param pattern  pattern of this motion, or of another motion with which it is compared
/// @param states   z̃_j = [z_j; u_{j−1}] of one period of the motion, one for each decision
/// @param width    width r₀ of the backlash (m)
template <class Scalar>
Borders borders_of(const SwitchingPattern& pattern, const std::vector<Vector<Scalar, 5>>& states,
                   double width) {
  Borders nearest;
  detail::for_each_border(pattern, states, width,
                          [&](std::size_t j, SwitchingSurface surface, double distance) {
                            const bool reverses = surface == SwitchingSurface::reversal;
                            Border& best = reverses ? nearest.velocity : nearest.displacement;
                            if (distance < best.distance)
                              best = {distance, surface, static_cast<std::int64_t>(j)};
                          });
  return nearest;
}

}  // namespace holdfast
