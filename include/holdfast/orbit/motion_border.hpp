#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "holdfast/core/errors.hpp"
#include "holdfast/math/linalg/multipliers.hpp"
#include "holdfast/math/roots/region_border.hpp"
#include "holdfast/orbit/switching_borders.hpp"

namespace holdfast {

/// The causes that end a periodic motion at the border of its parameter region. Exact switching:
/// the contact may change between samples. Δz, Δż: the drive's relative displacement and velocity.
enum class BorderKind {
  fold,              ///< a multiplier reaches 1
  flip,              ///< a multiplier reaches −1 (period doubling)
  neimark_sacker,    ///< a complex pair of multipliers reaches the unit circle
  border_collision,  ///< switching at samples: Δz or Δż of a sample reaches a switching surface
  grazing,  ///< exact switching: Δz or Δż touches a switching surface without crossing it
  sliding,  ///< exact switching: the mode after a reversal changes from stick to gap or vice versa
  switch_at_sample,  ///< exact switching: a contact change coincides with a sample
  jump,              ///< the motion ceases to exist without any of the causes above
  window,            ///< edge of the searched window; beyond it the motion may still exist
};

/// The cause by which a motion ends at a border point of its parameter region. Adjacent points with
/// equal data, apart from the multiplier, form one piece of the border curve.
struct MotionBorder {
  BorderKind kind = BorderKind::window;  ///< cause that ends the motion
  /// Surface of a border collision, a grazing or a sliding border; no meaning for other kinds. With
  /// exact switching `gap_upper` means either end of the gap.
  SwitchingSurface surface = SwitchingSurface::reversal;
  /// Index of the sample at which a border collision occurs; for a symmetric motion, modulo half
  /// the period. −1 for other kinds of border and for a motion that stays in its gap.
  std::int64_t sample = -1;
  /// Subdivision of two kinds, else 0. `neimark_sacker`: 0 for multiplier angles |θ| < π/2, 1 up to
  /// 2π/3, else 2. `window`: 0 at the least x, 1 at the largest x, 2 least y, 3 largest y.
  int part = 0;
  Multiplier multiplier{};  ///< multiplier of largest modulus at the point; ignored by ==
};

/// Whether two points belong to the same piece of the border: equal kind, surface, sample and part.
inline bool operator==(const MotionBorder& a, const MotionBorder& b) {
  return a.kind == b.kind && a.surface == b.surface && a.sample == b.sample && a.part == b.part;
}

/// A point of the border curve of a motion's region in the plane of two parameters.
struct MotionBorderPoint {
  double x;             ///< the first parameter
  double y;             ///< the second parameter
  MotionBorder border;  ///< cause that ends the motion at this point
};

/// The region in a plane of two parameters where a motion exists and attracts: its border curve.
struct MotionRegion {
  /// Points of the border, counter-clockwise. Where the kind of border changes, two points lie
  /// close together, at a codimension-two point.
  std::vector<MotionBorderPoint> border;
  bool closed = false;  ///< whether the border is a closed curve; false if its tracing failed
  int solutions = 0;    ///< number of parameter points at which the motion was computed
};

/// The rectangle in the plane of two parameters x and y in which a border is searched.
struct ParameterWindow {
  double x_from;  ///< least x
  double x_to;    ///< largest x, above x_from
  double y_from;  ///< least y
  double y_to;    ///< largest y, above y_from

  /// The point (x, y) for coordinates relative to the window: 0 at the least x or y, 1 at the most.
  PlanePoint at(const PlanePoint& shares) const {
    return {x_from + shares.x * (x_to - x_from), y_from + shares.y * (y_to - y_from)};
  }
  /// The coordinates of a point (x, y) relative to the window, 0 … 1 inside; the inverse of at().
  PlanePoint shares_of(const PlanePoint& point) const {
    return {(point.x - x_from) / (x_to - x_from), (point.y - y_from) / (y_to - y_from)};
  }
};

/// The number k of the strong resonance 1:k at the point where two border pieces meet. At this
/// point two multipliers are at 1 (k = 1), −1 (k = 2), e^{±2πi/3} (k = 3) or ±i (k = 4).
/// @return nullopt where the point is not a strong resonance
inline std::optional<int> strong_resonance(const MotionBorder& a, const MotionBorder& b) {
  const auto pair = BorderKind::neimark_sacker;
  if (a.kind != pair && b.kind != pair) return std::nullopt;
  if (a.kind == BorderKind::fold || b.kind == BorderKind::fold) return 1;
  if (a.kind == BorderKind::flip || b.kind == BorderKind::flip) return 2;
  if (a.kind != b.kind) return std::nullopt;
  return std::min(a.part, b.part) == 0 ? 4 : 3;
}

namespace detail {

/// The border for a multiplier on the unit circle, by angle: fold, flip or Neimark–Sacker.
inline MotionBorder circle_border(const Multiplier& multiplier) {
  constexpr double pi = 3.14159265358979323846, real = 1e-7;
  const double angle = std::abs(multiplier.angle);
  MotionBorder border{BorderKind::neimark_sacker, {}, -1, 0, multiplier};
  if (angle < real) border.kind = BorderKind::fold;
  if (angle > pi - real) border.kind = BorderKind::flip;
  if (border.kind == BorderKind::neimark_sacker)
    border.part = angle < pi / 2.0 ? 0 : angle < 2.0 * pi / 3.0 ? 1 : 2;
  return border;
}

/// The side of the window nearest to a point, and the distance from it as a share of the window.
inline RegionLook<MotionBorder> look_at_window(const PlanePoint& shares) {
  const double sides[] = {shares.x, 1.0 - shares.x, shares.y, 1.0 - shares.y};
  const auto least = std::min_element(std::begin(sides), std::end(sides));
  return {*least, {BorderKind::window, {}, -1, static_cast<int>(least - std::begin(sides)), {}}};
}

/// Validates a window. @throws InvalidParameter if it is not finite or does not contain `at`
inline void validate(const ParameterWindow& window, const PlanePoint& at) {
  require_finite("window", window.x_from + window.x_to + window.y_from + window.y_to, "");
  require_within("first parameter", at.x, "", window.x_from, window.x_to);
  require_within("second parameter", at.y, "", window.y_from, window.y_to);
}

/// The region of a motion within a window, found by following its border from `start`.
/// @param look  (x, y) ↦ RegionLook<MotionBorder>: the nearest border and the margin from it
template <class Look>
MotionRegion motion_region_by(const Look& look, const ParameterWindow& window,
                              const PlanePoint& start, const BorderSteps& steps) {
  const auto in_window = [&](const PlanePoint& shares) {
    const RegionLook<MotionBorder> edge = look_at_window(shares);
    if (!(edge.margin > 0.0)) return edge;
    const PlanePoint at = window.at(shares);
    const RegionLook<MotionBorder> seen = look(at.x, at.y);
    return seen.margin < edge.margin
               ? seen
               : RegionLook<MotionBorder>{edge.margin,
                                          {edge.label.kind, edge.label.surface, edge.label.sample,
                                           edge.label.part, seen.label.multiplier}};
  };
  const auto found = region_border<MotionBorder>(in_window, window.shares_of(start), steps);
  MotionRegion region{{}, found.closed, found.looks};
  region.border.reserve(found.points.size());
  for (const auto& point : found.points) {
    const PlanePoint at = window.at(point.at);
    region.border.push_back({at.x, at.y, point.label});
  }
  return region;
}

}  // namespace detail
}  // namespace holdfast
