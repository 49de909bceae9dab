#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "holdfast/core/types.hpp"
#include "holdfast/math/stats/share_error.hpp"
#include "holdfast/orbit/state_scale.hpp"
#include "holdfast/phase_space/basins.hpp"

namespace holdfast {

/// The distance of two orbits of neighbouring loops: the Hausdorff distance of their states at the
/// stroboscopic instants (sampling and forcing in phase), as a share of the extent of both orbits
/// together. Shifted copies of one orbit are at distance 0.
/// @tparam Orbit  PeriodicOrbit or EventOrbit
template <class Orbit>
double orbit_distance(const Orbit& one, const Orbit& other) {
  StateScale extent(one.states);
  for (const auto& state : other.states) extent.include(state);
  const auto farthest = [&](const Orbit& from, const Orbit& to) {
    double most = 0.0;
    for (std::size_t j = 0; j < from.states.size();
         j += static_cast<std::size_t>(from.ratio.denominator)) {
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t k = 0; k < to.states.size();
           k += static_cast<std::size_t>(to.ratio.denominator)) {
        const Vector<double, 4> apart =
            from.states[j].template head<4>() - to.states[k].template head<4>();
        least = std::min(least, extent.share_of(apart));
      }
      most = std::max(most, least);
    }
    return most;
  };
  return std::max(farthest(one, other), farthest(other, one));
}

/// The numbering of the attractors of successive loops: matching attractors have the same number.
///
/// A match pairs an attractor with one of the previous loop. The closest pair is matched first,
/// then the closest of the remaining pairs, up to a largest distance. An unmatched attractor gets a
/// new number; the number of a vanished attractor is not used again.
/// Source: G. Datseris, K. Luiz Rossi, A. Wagemakers, Framework for global stability analysis of
/// dynamical systems, Chaos 33 (2023).
/// @tparam Orbit  PeriodicOrbit or EventOrbit
template <class Orbit>
class AttractorMatching {
 public:
  /// @param largest_distance  largest orbit_distance() of a match, > 0
  explicit AttractorMatching(double largest_distance) : largest_distance_(largest_distance) {}

  /// Matches the attractors of the next loop with the last ones. @return their numbers, ≥ 0
  std::vector<int> match(std::vector<Orbit> orbits) {
    struct Pair {
      double distance;
      std::size_t known, next;
    };
    std::vector<Pair> pairs;
    for (std::size_t k = 0; k < known_.size(); ++k)
      for (std::size_t n = 0; n < orbits.size(); ++n)
        pairs.push_back({orbit_distance(known_[k], orbits[n]), k, n});
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const Pair& a, const Pair& b) { return a.distance < b.distance; });
    std::vector<int> numbers(orbits.size(), -1);
    std::vector<bool> taken(known_.size(), false);
    for (const Pair& pair : pairs) {
      if (pair.distance > largest_distance_ || taken[pair.known] || numbers[pair.next] >= 0)
        continue;
      taken[pair.known] = true;
      numbers[pair.next] = numbers_[pair.known];
    }
    for (int& number : numbers)
      if (number < 0) number = count_++;
    known_ = std::move(orbits);
    numbers_ = numbers;
    return numbers;
  }

  /// The orbits of the last matched loop.
  const std::vector<Orbit>& orbits() const { return known_; }
  /// The count of all numbers given so far.
  int count() const { return count_; }

 private:
  double largest_distance_;
  std::vector<Orbit> known_;
  std::vector<int> numbers_;
  int count_ = 0;
};

/// An attractor of one loop, with its number along the parameter.
template <class Orbit>
struct FollowedAttractor {
  int number;             ///< number ≥ 0, the same as in the previous loop if matched
  Orbit orbit;            ///< certified orbit
  std::size_t states;     ///< number of initial states that come to it; 0 if only a seed does
  double fraction;        ///< share of the initial states that come to it
  double standard_error;  ///< standard error of the share, by share_error()
};

/// The attractors of one loop, and the counts of the initial states without one.
template <class Orbit>
struct FollowedBasins {
  std::vector<FollowedAttractor<Orbit>> attractors;  ///< attractors, in the order of their numbers
  std::size_t diverging = 0;                         ///< count of initial states that diverge
  std::size_t unknown = 0;                           ///< count of initial states without an orbit
};

/// The continuation of all attractors of a loop along a parameter, with the share of the initial
/// states that come to each.
///
/// Every loop is searched from the same initial states and from one state of each attractor of the
/// previous loop, a seed. Thus an attractor is not lost because its basin has become small. Seeds
/// are not counted among the states.
/// @tparam Orbit  PeriodicOrbit or EventOrbit
template <class Orbit>
class AttractorContinuation {
 public:
  /// @param initial_states    [z₁, ż₁, z₂, ż₂] (m, m/s), at least one
  /// @param largest_distance  largest orbit_distance() at which two attractors are matched
  AttractorContinuation(std::vector<Vector<double, 4>> initial_states, double largest_distance)
      : states_(std::move(initial_states)), matching_(largest_distance) {}

  /// Finds the attractors of the next loop. @param find  states ↦ BasinsOf<Orbit> of that loop
  template <class Find>
  FollowedBasins<Orbit> next(const Find& find) {
    std::vector<Vector<double, 4>> starts = states_;
    for (const Orbit& orbit : matching_.orbits())
      starts.push_back(orbit.states.front().template head<4>());
    const BasinsOf<Orbit> basins = find(starts);
    std::vector<Orbit> orbits;
    for (const auto& attractor : basins.attractors) orbits.push_back(attractor.orbit);
    const std::vector<int> numbers = matching_.match(orbits);
    FollowedBasins<Orbit> followed;
    for (std::size_t k = 0; k < orbits.size(); ++k)
      followed.attractors.push_back({numbers[k], std::move(orbits[k]), 0, 0.0, 0.0});
    for (std::size_t k = 0; k < states_.size(); ++k) {
      const BasinLabel& label = basins.labels[k];
      if (label.attractor >= 0)
        ++followed.attractors[static_cast<std::size_t>(label.attractor)].states;
      else
        ++(label.outcome == OrbitOutcome::diverges ? followed.diverging : followed.unknown);
    }
    const auto all = static_cast<double>(states_.size());
    for (auto& attractor : followed.attractors) {
      attractor.fraction = static_cast<double>(attractor.states) / all;
      attractor.standard_error = share_error(attractor.states, states_.size());
    }
    std::sort(followed.attractors.begin(), followed.attractors.end(),
              [](const auto& a, const auto& b) { return a.number < b.number; });
    return followed;
  }

 private:
  std::vector<Vector<double, 4>> states_;
  AttractorMatching<Orbit> matching_;
};

}  // namespace holdfast
