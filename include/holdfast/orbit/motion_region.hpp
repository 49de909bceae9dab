#pragma once

#include <cstddef>
#include <cstdint>

#include "holdfast/orbit/motion_border.hpp"
#include "holdfast/orbit/orbit_continuation.hpp"
#include "holdfast/orbit/state_scale.hpp"

namespace holdfast {

namespace detail {

/// Whether an orbit is symmetric: half a period later the state has the opposite sign. Such an
/// orbit reaches a switching surface and the opposite one at the same parameters.
inline bool mirrors_itself(const PeriodicOrbit& orbit) {
  const std::size_t samples = orbit.states.size(), half = samples / 2;
  if (samples % 2 != 0) return false;
  const StateScale extent(orbit.states);
  for (std::size_t j = 0; j < half; ++j) {
    const Vector<double, 4> sum =
        orbit.states[j].template head<4>() + orbit.states[j + half].template head<4>();
    if (orbit.itinerary[j] != orbit.itinerary[j + half] || extent.share_of(sum) > 1e-9)
      return false;
  }
  return true;
}

/// The nearest border of an orbit's solution, and the margin of the solution from that border.
/// @param half  half the period (samples) of a symmetric orbit, else 0
inline RegionLook<MotionBorder> look_of(const BranchPoint& point, std::int64_t half) {
  if (point.by_multiplier == point.margin())
    return {point.margin(), circle_border(point.multiplier)};
  const bool velocity = point.by_velocity <= point.by_displacement;
  const Border& nearest = velocity ? point.borders.velocity : point.borders.displacement;
  MotionBorder border{BorderKind::border_collision, nearest.surface, nearest.sample, 0,
                      point.multiplier};
  if (half > 0 && border.sample >= half) {
    border.sample -= half;
    if (border.surface != SwitchingSurface::reversal)
      border.surface = border.surface == SwitchingSurface::gap_lower ? SwitchingSurface::gap_upper
                                                                     : SwitchingSurface::gap_lower;
  }
  return {point.margin(), border};
}

}  // namespace detail

/// Computes the border of the region of two parameters in which a periodic motion with switching at
/// samples exists and attracts. Inside, a periodic solution with the orbit's contacts exists, no
/// sample reaches a switching surface, and all multipliers lie inside the unit circle.
///
/// For given contacts the map over a period is affine. As a multiplier tends to 1, the periodic
/// solution grows without bound and thus reaches a switching surface earlier. A `fold` therefore
/// occurs only where a symmetric motion loses its symmetry.
///
///     const auto family = [&](double width, double gain) { … return other; };
///     const MotionRegion region = motion_region(family, orbit, window, {0.002, -13.0});
///
/// @param family  function (x, y) ↦ IdealLoop<double>; forcing frequency × sampling period f τ must
///                not depend on x and y
/// @param orbit   certified orbit of family(at.x, at.y)
/// @param window  range of the parameters that is searched; contains `at`
/// @param at      parameters (x, y) of the orbit
/// @param steps   step lengths and accuracies along the border, as shares of the window's sides
/// @throws InvalidParameter where f τ changes, the backlash width becomes zero or nonzero, or the
/// window is not finite, is empty or does not contain `at`
template <class Family>
MotionRegion motion_region(const Family& family, const PeriodicOrbit& orbit,
                           const ParameterWindow& window, const PlanePoint& at,
                           const BorderSteps& steps = {}) {
  detail::validate(window, at);
  detail::OrbitContinuation<Family> continuation(family, orbit, family(at.x, at.y).backlash_width);
  const std::int64_t half = detail::mirrors_itself(orbit) ? orbit.period_samples() / 2 : 0;
  const bool stays = orbit.engaged_fraction() == 0.0;
  const auto look = [&](double x, double y) {
    auto seen = detail::look_of(continuation.at(x, y), half);
    // For a motion that stays in its gap the sample does not distinguish borders.
    if (stays && seen.label.kind == BorderKind::border_collision) seen.label.sample = -1;
    return seen;
  };
  MotionRegion region = detail::motion_region_by(look, window, at, steps);
  region.solutions = continuation.solutions();
  return region;
}

}  // namespace holdfast
