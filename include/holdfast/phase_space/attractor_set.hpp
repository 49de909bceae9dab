#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "holdfast/orbit/periodic_orbit.hpp"
#include "holdfast/orbit/region_of_attraction.hpp"

namespace holdfast {

namespace detail {

/// Whether `other`, begun `shift` samples later and its states multiplied by `sign`, is `orbit`.
template <class Orbit>
bool same_course(const Orbit& orbit, const Orbit& other, std::size_t shift, double sign,
                 const StateScale& extent) {
  const std::size_t samples = orbit.states.size();
  const auto step = static_cast<std::size_t>(orbit.ratio.denominator);
  for (std::size_t j = 0; j < samples; j += step) {
    const Vector<double, 4> apart = orbit.states[j].template head<4>() -
                                    sign * other.states[(j + shift) % samples].template head<4>();
    if (!(extent.share_of(apart) <= 1e-9)) return false;
  }
  return true;
}

}  // namespace detail

/// Whether two orbits of the same loop are one motion, begun at different stroboscopic
/// instants. Gaps in which the drive stays for ever may differ.
/// @tparam Orbit  PeriodicOrbit or EventOrbit
template <class Orbit>
bool is_phase_shifted_copy(const Orbit& orbit, const Orbit& other) {
  if (orbit.states.size() != other.states.size()) return false;
  const StateScale extent(orbit.states);
  const auto step = static_cast<std::size_t>(orbit.ratio.denominator);
  for (std::size_t shift = 0; shift < orbit.states.size(); shift += step) {
    if (detail::same_course(orbit, other, shift, 1.0, extent)) return true;
  }
  return false;
}

/// Whether one orbit is the other with all signs changed, half a forcing period later: the loop is
/// symmetric under that, which sampling keeps where q is even. Without excitation any shift will
/// do.
/// @tparam Orbit  PeriodicOrbit or EventOrbit
template <class Orbit>
bool is_mirror_image(const Orbit& orbit, const Orbit& other) {
  const auto step = static_cast<std::size_t>(orbit.ratio.denominator);
  const bool forced = orbit.ratio.numerator != 0;
  if (orbit.states.size() != other.states.size() || (forced && step % 2 != 0)) return false;
  const StateScale extent(orbit.states);
  for (std::size_t shift = forced ? step / 2 : 0; shift < orbit.states.size(); shift += step) {
    if (detail::same_course(orbit, other, shift, -1.0, extent)) return true;
  }
  return false;
}

/// The different orbits of one loop, and the neighbourhoods from which motions tend to them.
/// @tparam Loop  IdealLoop<double>
template <class Loop>
class AttractorSet {
 public:
  /// @param loop  of all orbits that will be added
  explicit AttractorSet(const Loop& loop) : loop_(loop), weights_(DeviationScale(loop).weights()) {}

  /// @return the orbit's number, that of an earlier one of which it is a copy
  int add(PeriodicOrbit orbit) {
    for (std::size_t k = 0; k < orbits_.size(); ++k)
      if (is_phase_shifted_copy(orbits_[k], orbit)) return static_cast<int>(k);
    const int number = static_cast<int>(orbits_.size());
    for (AttractionBall& point : attraction_balls(loop_, orbit)) {
      // A reach in z₁ alone is enough to sort by; inside a gap it is at most half the gap's width.
      const double reach = point.stays_inside ? point.radius * loop_.backlash_width : point.radius;
      largest_reach_ = std::max(largest_reach_, reach);
      entries_.push_back({number, std::move(point)});
    }
    std::sort(entries_.begin(), entries_.end(),
              [](const Entry& a, const Entry& b) { return a.point.state[0] < b.point.state[0]; });
    orbits_.push_back(std::move(orbit));
    return number;
  }

  /// The orbit that a motion surely tends to; −1 where none is known. Ask at a stroboscopic instant
  /// (sampling and forcing in phase), before the sample.
  template <class Memory>
  int attracted_by(const Memory& motion) const {
    const double position = motion.state[0];
    auto entry = std::lower_bound(
        entries_.begin(), entries_.end(), position - largest_reach_,
        [](const Entry& candidate, double value) { return candidate.point.state[0] < value; });
    for (; entry != entries_.end() && entry->point.state[0] <= position + largest_reach_; ++entry)
      if (attracts(entry->point, motion, weights_)) return entry->orbit;
    return -1;
  }

  /// Each at the index that is its number.
  const std::vector<PeriodicOrbit>& orbits() const { return orbits_; }

 private:
  struct Entry {
    int orbit;
    AttractionBall point;
  };

  Loop loop_;
  Vector<double, 6> weights_;
  std::vector<PeriodicOrbit> orbits_;
  std::vector<Entry> entries_;  // by z₁
  double largest_reach_ = 0.0;
};

}  // namespace holdfast
