#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "holdfast/attractor/contact_maps.hpp"
#include "holdfast/attractor/multipliers.hpp"
#include "holdfast/attractor/periodic_solution.hpp"
#include "holdfast/attractor/switching_borders.hpp"
#include "holdfast/core/rational.hpp"
#include "holdfast/motion/forced_loop.hpp"

namespace holdfast {

/// A periodic motion of the sampled loop with backlash, solved exactly for its sequence of contacts
/// and found to reproduce it: the certificate of a periodic motion.
struct PeriodicOrbit {
  Rational ratio;          ///< f τ = p/q
  double sampling_period;  ///< τ (s)
  Contacts contacts;       ///< of one period, N samples; the first one at phase 0 of the forcing
  std::vector<Vector<double, 5>> states;  ///< z̃_j = [z_j; u_{j−1}], N of them
  BacklashMemory<double> memory;          ///< of the drive before the first sample
  std::vector<Multiplier> multipliers;    ///< of one period, five, largest first
  double closure_error;                   ///< ‖z_N − z₀‖, SI numbers of m and m/s
  Borders borders;                        ///< the switching surfaces that it comes nearest to

  /// N.
  std::int64_t period_samples() const { return static_cast<std::int64_t>(contacts.size()); }
  /// N τ (s).
  double period() const { return static_cast<double>(period_samples()) * sampling_period; }
  /// N p/q, a whole number; 0 without excitation.
  std::int64_t forcing_periods() const {
    return period_samples() / ratio.denominator * ratio.numerator;
  }
  /// max |λ|; 0 where that is below the smallest number.
  double largest_multiplier() const { return std::exp(multipliers.front().log_modulus); }
  /// Every neighbour that keeps to the sequence of contacts comes nearer, in the long run; not so
  /// where the largest modulus is told from 1 by rounding alone.
  bool is_attracting() const {
    const double rounding = 64.0 * std::numeric_limits<double>::epsilon();
    return multipliers.front().log_modulus < -rounding * static_cast<double>(contacts.size());
  }
  /// Share of the samples at which the drive transmits.
  double engaged_fraction() const {
    const auto engaged = std::count(contacts.begin(), contacts.end(), std::uint8_t{1});
    return static_cast<double>(engaged) / static_cast<double>(contacts.size());
  }
  /// Largest |z₁| (m) of the samples.
  double amplitude() const {
    double largest = 0.0;
    for (const auto& state : states) largest = std::max(largest, std::abs(state[0]));
    return largest;
  }
};

/// Whether a sequence of contacts belongs to an orbit.
enum class CandidateOutcome {
  verified,        ///< the periodic solution reproduces its own sequence
  singular,        ///< 1 is a multiplier: no periodic solution, or many
  other_contacts,  ///< the solution would switch otherwise: the sequence has no orbit
  on_surface,      ///< it touches a switching surface, so that rounding decides its contacts
};

/// A sequence of contacts with its solution, verified or not.
struct OrbitCandidate {
  CandidateOutcome outcome;
  std::optional<PeriodicOrbit> orbit;  ///< none where the sequence is singular
};

namespace detail {

/// Distances below this many units of rounding of what they are measured on count as none.
inline constexpr double surface_rounding = 256.0;

/// Whether the orbit comes so near to a surface that rounding may decide.
/// @param state_error  of the states, from their closure
inline bool touches_surface(const PeriodicOrbit& orbit, double state_error) {
  double displacement = 0.0, velocity = 0.0;
  for (const auto& state : orbit.states) {
    displacement = std::max({displacement, std::abs(state[0]), std::abs(state[2])});
    velocity = std::max({velocity, std::abs(state[1]), std::abs(state[3])});
  }
  const double rounding = surface_rounding * std::numeric_limits<double>::epsilon();
  const double error = 64.0 * state_error;
  return std::abs(orbit.borders.displacement.distance) <= rounding * displacement + error ||
         std::abs(orbit.borders.velocity.distance) <= rounding * velocity + error;
}

template <class Scalar>
std::vector<Matrix<Scalar, 5>> maps_of(const std::vector<AffineMap<Scalar>>& blocks) {
  std::vector<Matrix<Scalar, 5>> maps;
  maps.reserve(blocks.size());
  for (const auto& block : blocks) maps.push_back(block.map);
  return maps;
}

}  // namespace detail

/// Solves for the orbit of a sequence of contacts and verifies it.
///
/// @param loop      the loop with its excitation
/// @param ratio     of forcing_ratio(loop)
/// @param contacts  N samples, N ≥ 1 a multiple of q, the first one at phase 0 of the forcing
/// @param law       the backlash before the first sample, as the motion that led here left it
/// Work: about 500 multiply-adds a sample; memory about 70 bytes a sample.
/// @tparam Scalar  `double`; a template so that only who calls it compiles it
template <class Scalar>
OrbitCandidate orbit_of_contacts(const ForcedLoop<Scalar>& loop, const Rational& ratio,
                                 const ContactMaps<Scalar>& maps, const Contacts& contacts,
                                 const Backlash<Scalar>& law) {
  const std::vector<AffineMap<Scalar>> blocks = affine_blocks(maps, contacts);
  auto solution = periodic_solution(maps, contacts, relation_of_ends(blocks));
  if (!solution) return {CandidateOutcome::singular, std::nullopt};
  const SwitchingPattern pattern = switching_pattern(solution->states, law);
  PeriodicOrbit orbit{ratio,
                      loop.sampling.period,
                      contacts,
                      std::move(solution->states),
                      pattern.memory,
                      multipliers_of_product(detail::maps_of(blocks)),
                      solution->closure_error,
                      {}};
  orbit.borders = borders_of(pattern, orbit.states, loop.backlash_width);
  const auto outcome = detail::touches_surface(orbit, solution->state_error)
                           ? CandidateOutcome::on_surface
                       : has_contacts(pattern, contacts) ? CandidateOutcome::verified
                                                         : CandidateOutcome::other_contacts;
  return {outcome, std::move(orbit)};
}

}  // namespace holdfast
