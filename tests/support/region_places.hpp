#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "holdfast/orbit/motion_border.hpp"

namespace holdfast::test {

/// Whether a point lies inside the polygon of a border: by how often a ray to the right crosses it.
inline bool encloses(const MotionRegion& region, double x, double y) {
  bool inside = false;
  for (std::size_t k = 0; k + 1 < region.border.size(); ++k) {
    const auto &a = region.border[k], &b = region.border[k + 1];
    if ((a.y > y) != (b.y > y) && x < a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
  }
  return inside;
}

/// How far a point lies from the polygon of a border, in shares of the window.
inline double distance_to_border(const MotionRegion& region, const ParameterWindow& window,
                                 const PlanePoint& point) {
  const PlanePoint at = window.shares_of(point);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k + 1 < region.border.size(); ++k) {
    const PlanePoint a = window.shares_of({region.border[k].x, region.border[k].y});
    const PlanePoint b = window.shares_of({region.border[k + 1].x, region.border[k + 1].y});
    const double x = b.x - a.x, y = b.y - a.y, square = x * x + y * y;
    const double along = ((at.x - a.x) * x + (at.y - a.y) * y) / square;
    const double share = square > 0.0 ? std::clamp(along, 0.0, 1.0) : 0.0;
    least = std::min(least, std::hypot(a.x + share * x - at.x, a.y + share * y - at.y));
  }
  return least;
}

}  // namespace holdfast::test
