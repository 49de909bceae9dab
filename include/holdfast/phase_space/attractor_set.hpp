#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "holdfast/core/types.hpp"
#include "holdfast/motion/ideal_loop.hpp"
#include "holdfast/orbit/periodic_orbit.hpp"
#include "holdfast/orbit/region_of_attraction.hpp"

namespace holdfast {

namespace detail {

/// Whether `orbit` is a copy of `other` with states multiplied by `sign`, started later by `shift`
/// samples plus any number of common periods (q samples each).
template <class Orbit>
bool is_same_course(const Orbit& orbit, const Orbit& other, std::size_t shift, double sign) {
  const std::size_t samples = orbit.states.size();
  if (other.states.size() != samples) return false;
  const StateScale extent(orbit.states);
  const auto step = static_cast<std::size_t>(orbit.ratio.denominator);
  for (; shift < samples; shift += step) {
    bool same = true;
    for (std::size_t j = 0; same && j < samples; j += step) {
      const Vector<double, 4> apart = orbit.states[j].template head<4>() -
                                      sign * other.states[(j + shift) % samples].template head<4>();
      same = extent.share_of(apart) <= 1e-9;
    }
    if (same) return true;
  }
  return false;
}

}  // namespace detail

/// Whether two orbits of one loop are the same motion started at different stroboscopic instants
/// (sampling and forcing in phase). The positions of the gap are not compared.
/// @tparam Orbit  PeriodicOrbit or EventOrbit
template <class Orbit>
bool is_phase_shifted_copy(const Orbit& orbit, const Orbit& other) {
  return detail::is_same_course(orbit, other, 0, 1.0);
}

/// Whether one orbit is the mirror image of another: all signs changed, shifted by half the common
/// period of sampling and forcing (q/2 samples; false for odd q). Without force any shift is valid.
/// @tparam Orbit  PeriodicOrbit or EventOrbit
template <class Orbit>
bool is_mirror_image(const Orbit& orbit, const Orbit& other) {
  const auto step = static_cast<std::size_t>(orbit.ratio.denominator);
  const bool forced = orbit.ratio.numerator != 0;
  if (forced && step % 2 != 0) return false;
  return detail::is_same_course(orbit, other, forced ? step / 2 : 0, -1.0);
}

namespace detail {

/// The neighbourhoods of a loop's orbits, with the members Orbit, Point, points_of(orbit),
/// reach(point) in z₁ (m) and holds(point, motion).
/// @tparam Loop  IdealLoop<double>; ImplementedLoopOf<Plant> in event_basins.hpp
template <class Loop>
struct Neighbourhoods;

/// Neighbourhoods of an IdealLoop's orbits, from which a motion surely tends to the orbit.
template <class Scalar>
struct Neighbourhoods<IdealLoop<Scalar>> {
  using Orbit = PeriodicOrbit;
  using Point = AttractionBall;

  IdealLoop<Scalar> loop;
  Vector<double, 6> weights = deviation_weights(loop);

  std::vector<Point> points_of(const Orbit& orbit) const { return attraction_balls(loop, orbit); }
  /// An upper bound of the reach of a neighbourhood in z₁ (m), for any position of the gap.
  double reach(const Point& point) const {
    return point.stays_inside ? point.radius * loop.backlash_width : point.radius;
  }
  template <class Memory>
  bool holds(const Point& point, const Memory& motion) const {
    return attracts(point, motion, weights);
  }
};

}  // namespace detail

/// The different orbits of one loop, with neighbourhoods of their points at stroboscopic instants.
/// In an IdealLoop or a ModalLoop every motion that enters a neighbourhood tends to the orbit. In
/// an ImplementedLoop this is not certain; a neighbourhood's radius is 10⁻⁶ of the orbit's extent.
/// @tparam Loop  IdealLoop<double>, ModalLoop or ImplementedLoopOf<Plant>
template <class Loop>
class AttractorSet {
  using Neighbourhoods = detail::Neighbourhoods<Loop>;

 public:
  /// The type of the orbits, PeriodicOrbit or EventOrbit.
  using Orbit = typename Neighbourhoods::Orbit;

  /// A point of an orbit with its neighbourhood.
  struct Entry {
    int orbit;                             ///< number of the orbit: index in orbits()
    typename Neighbourhoods::Point point;  ///< point of the orbit with its neighbourhood
  };

  /// @param loop  loop to which all added orbits belong
  explicit AttractorSet(const Loop& loop) : neighbourhoods_{loop} {}

  /// Adds an orbit. @return its number, or the number of an earlier orbit of which it is a copy
  int add(Orbit orbit) {
    for (std::size_t k = 0; k < orbits_.size(); ++k)
      if (is_phase_shifted_copy(orbits_[k], orbit)) return static_cast<int>(k);
    const int number = static_cast<int>(orbits_.size());
    for (auto& point : neighbourhoods_.points_of(orbit)) {
      largest_reach_ = std::max(largest_reach_, neighbourhoods_.reach(point));
      entries_.push_back({number, std::move(point)});
    }
    std::sort(entries_.begin(), entries_.end(),
              [](const Entry& a, const Entry& b) { return a.point.state[0] < b.point.state[0]; });
    orbits_.push_back(std::move(orbit));
    return number;
  }

  /// The orbit point whose neighbourhood contains the state of a motion; null if there is none. To
  /// be called at a stroboscopic instant (sampling and forcing in phase), before the sample.
  /// @param motion  a motion's memory(), or the point() of a RepeatingMotion
  template <class Memory>
  const Entry* near(const Memory& motion) const {
    const double position = motion.state[0];
    auto entry = std::lower_bound(
        entries_.begin(), entries_.end(), position - largest_reach_,
        [](const Entry& candidate, double value) { return candidate.point.state[0] < value; });
    for (; entry != entries_.end() && entry->point.state[0] <= position + largest_reach_; ++entry)
      if (neighbourhoods_.holds(entry->point, motion)) return &*entry;
    return nullptr;
  }

  /// The number of the orbit whose neighbourhood contains a motion's state, by near(); −1: none.
  template <class Memory>
  int attracted_by(const Memory& motion) const {
    const Entry* const entry = near(motion);
    return entry != nullptr ? entry->orbit : -1;
  }

  /// The orbits of the set; the index of each is its number.
  const std::vector<Orbit>& orbits() const { return orbits_; }

 private:
  Neighbourhoods neighbourhoods_;
  std::vector<Orbit> orbits_;
  std::vector<Entry> entries_;  // by z₁
  double largest_reach_ = 0.0;
};

}  // namespace holdfast
