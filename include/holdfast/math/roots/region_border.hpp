#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "holdfast/core/types.hpp"
#include "holdfast/math/roots/bracketing_root.hpp"

namespace holdfast {

/// A point of the plane in which a region is traced.
struct PlanePoint {
  double x = 0.0;  ///< coordinate x, to the right
  double y = 0.0;  ///< coordinate y, upward
};

/// The result of examining a point of the plane. A region is defined by one or more conditions; the
/// point is inside if all of them are satisfied.
/// @tparam Label  type that identifies a condition; compared by ==
template <class Label>
struct RegionLook {
  double margin = -1.0;  ///< > 0 inside the region, ≤ 0 outside; tracing is fast if continuous
  Label label{};         ///< condition that is nearest to failing, or fails, at the point
};

/// A point on the border of a region, just inside the region.
template <class Label>
struct BorderPoint {
  PlanePoint at;  ///< position
  Label label{};  ///< condition that fails just outside the region here
};

/// The border of a region, traced with the region on the left of the direction of travel.
template <class Label>
struct RegionBorder {
  std::vector<BorderPoint<Label>> points;  ///< border points; if closed, the last equals the first
  bool closed = false;  ///< whether the trace returned to its start; if not, the trace lost the
                        ///< border, changed to a touching part of the region or reached the limit
  int looks = 0;        ///< number of points examined; ≥ `most_looks` if the trace was given up
};

/// The step lengths, accuracies and limits of region_border(); x and y need a common unit.
struct BorderSteps {
  double longest = 0.02;       ///< longest step, > 0, in the unit of x and y
  double shortest = 1e-9;      ///< shortest step and accuracy of a corner, in the unit of x and y
  double tolerance = 1e-13;    ///< accuracy of a border point, in the unit of x and y
  double jump = 1e-4;          ///< a border point of larger margin is taken as a jump of the margin
  int most_looks = 1'000'000;  ///< limit of the number of points examined, ≥ 1
};

namespace detail {

/// Traces a border by circles. The next border point is the first exit from the region on a circle
/// about the last point, searched clockwise from the direction of the point before the last.
template <class Label, class Look>
class BorderWalk {
 public:
  BorderWalk(const Look& look, const BorderSteps& steps) : look_(look), steps_(steps) {}

  RegionBorder<Label> run(const PlanePoint& start) {
    if (!(seen(start).margin > 0.0)) return border_;
    const double reach = reach_from(start);
    const auto first = ray(start, 0.0);
    if (!first) return border_;
    longest_ = std::min(steps_.longest, reach / 4.0);
    border_.points.push_back(*first);
    // The search from the start arrived from inside.
    backward_ = pi<double>;
    fresh_ = true;
    for (double step = longest_; border_.looks < steps_.most_looks && !border_.closed;)
      step = go_on(step);
    return border_;
  }

 private:
  static constexpr double ahead = 0.35;  // half of the angle (rad) in which the border is expected
  static constexpr double sweep = 0.2;   // largest step of the angle (rad)

  struct Corner {
    PlanePoint at;
    Label before, after;
    std::ptrdiff_t number;  // index of the border point after it
  };

  RegionLook<Label> seen(const PlanePoint& at) {
    ++border_.looks;
    return look_(at);
  }

  static PlanePoint moved(const PlanePoint& from, double distance, double angle) {
    return {from.x + distance * std::cos(angle), from.y + distance * std::sin(angle)};
  }
  static double distance(const PlanePoint& a, const PlanePoint& b) {
    return std::hypot(a.x - b.x, a.y - b.y);
  }
  static double turned(double angle) { return std::remainder(angle, 2.0 * pi<double>); }

  /// The last point inside the region on the path place(parameter), from parameter `in` (inside) to
  /// `out` (outside); none if rounding moves either end of the path across the border.
  template <class Place>
  std::optional<BorderPoint<Label>> last_inside(double in, double out, double tolerance,
                                                const Place& place) {
    PlanePoint last = place(in);
    RegionLook<Label> inner, outer;
    double nearest = std::numeric_limits<double>::infinity(), farthest = nearest;
    const auto margin = [&](double value) {
      const PlanePoint at = place(value);
      const RegionLook<Label> look = seen(at);
      const bool is_inside = look.margin >= 0.0;  // where it is zero the search ends
      if (is_inside && std::abs(value - out) <= nearest) {
        nearest = std::abs(value - out);
        last = at;
        inner = look;
      } else if (!is_inside && std::abs(value - in) <= farthest) {
        farthest = std::abs(value - in);
        outer = look;
      }
      return look.margin;
    };
    const double at_in = margin(in), at_out = margin(out);
    if (!(at_in > 0.0) || at_out > 0.0) return std::nullopt;
    const SignChange<double> bracket{std::min(in, out), std::max(in, out),
                                     in < out ? at_in : at_out, in < out ? at_out : at_in};
    bracketing_root(margin, bracket, tolerance);
    return BorderPoint<Label>{last, inner.margin > steps_.jump ? outer.label : inner.label};
  }

  /// The first border point on a ray from an inner point; none if the limit of points is reached.
  std::optional<BorderPoint<Label>> ray(const PlanePoint& from, double angle) {
    for (double near = 0.0; border_.looks < steps_.most_looks;) {
      const double far = near + steps_.longest;
      if (!(seen(moved(from, far, angle)).margin > 0.0))
        return last_inside(near, far, steps_.tolerance,
                           [&](double value) { return moved(from, value, angle); });
      near = far;
    }
    return std::nullopt;
  }

  /// The largest distance from a point to the border along the directions ±x and ±y.
  double reach_from(const PlanePoint& start) {
    double reach = 0.0;
    for (const double angle : {0.0, pi<double> / 2.0, pi<double>, -pi<double> / 2.0})
      if (const auto end = ray(start, angle)) reach = std::max(reach, distance(start, end->at));
    return reach;
  }

  bool inside(const PlanePoint& at) { return seen(at).margin > 0.0; }

  std::optional<BorderPoint<Label>> between(double step, double in, double out) {
    const PlanePoint here = border_.points.back().at;
    return last_inside(in, out, steps_.tolerance / step,
                       [&](double angle) { return moved(here, step, angle); });
  }

  /// The next border point, on a circle of radius `step` about the last; none without an exit.
  std::optional<BorderPoint<Label>> next(double step) {
    const PlanePoint here = border_.points.back().at;
    const auto is_inside = [&](double angle) { return inside(moved(here, step, angle)); };
    const double forward = backward_ - pi<double>;
    if (!fresh_ && is_inside(forward + ahead) && !is_inside(forward - ahead))
      return between(step, forward + ahead, forward - ahead);
    for (double width = sweep; width > 2e-3; width /= 4.0) {
      std::optional<double> in;
      const double last = backward_ - 2.0 * pi<double>;
      for (double angle = backward_ - width; angle > last; angle -= width) {
        const bool is_in = is_inside(angle);
        if (in && !is_in) return between(step, *in, angle);
        in = is_in ? std::optional<double>(angle) : std::nullopt;
      }
    }
    return std::nullopt;
  }

  /// Tries one step. @return length of the next step
  double go_on(double step) {
    const auto shorter = [&](double share) { return std::max(share * step, steps_.shortest); };
    const bool least = step <= steps_.shortest;
    const BorderPoint<Label> here = border_.points.back();
    const auto found = next(step);
    if (!found && least) border_.looks = steps_.most_looks;  // lost
    if (!found) return shorter(0.25);
    const double direction = std::atan2(found->at.y - here.at.y, found->at.x - here.at.x);
    const bool corner = !(found->label == here.label);
    if (corner && !least) return shorter(0.5);
    if (corner && meets_again(here, *found)) {
      border_.looks = steps_.most_looks;
      return step;
    }
    const bool bent = !fresh_ && std::abs(turned(direction - backward_ + pi<double>)) > 0.3;
    if (bent && !least) return shorter(0.5);
    border_.points.push_back(*found);
    // After a corner the direction of the previous piece is kept.
    if (!least) backward_ = direction + pi<double>;
    if (border_.points.size() == 2) first_direction_ = direction;
    fresh_ = least;
    close(step, direction);
    return least ? longest_ : std::min(2.0 * step, longest_);
  }

  /// Whether the trace has come back to a corner after leaving it. Where parts of a region touch,
  /// the trace may have changed to another part, which it would circle for ever.
  bool meets_again(const BorderPoint<Label>& before, const BorderPoint<Label>& after) {
    const auto is_left = [&](const BorderPoint<Label>& point) {
      return distance(point.at, after.at) > 100.0 * steps_.shortest;
    };
    const auto& points = border_.points;
    const bool again = std::any_of(corners_.begin(), corners_.end(), [&](const Corner& known) {
      return known.before == before.label && known.after == after.label &&
             distance(known.at, after.at) <= 10.0 * steps_.shortest &&
             std::any_of(points.begin() + known.number, points.end(), is_left);
    });
    corners_.push_back(
        {after.at, before.label, after.label, static_cast<std::ptrdiff_t>(points.size())});
    return again;
  }

  void close(double step, double direction) {
    const auto& points = border_.points;
    const bool there = points.size() > 4 && distance(points.back().at, points.front().at) <= step &&
                       std::abs(turned(direction - first_direction_)) < 1.0;
    if (!there) return;
    border_.closed = true;
    border_.points.push_back(border_.points.front());
  }

  const Look& look_;
  BorderSteps steps_;
  RegionBorder<Label> border_;
  std::vector<Corner> corners_;
  double longest_ = 0.0;
  double backward_ = 0.0;         // angle towards the previous border point
  double first_direction_ = 0.0;  // angle of the first step
  bool fresh_ = true;             // at the first point or after a corner: search in all directions
};

}  // namespace detail

/// Traces the border of the region {margin > 0} of a plane, around an inner point, until the border
/// closes.
///
/// Each border point is a root of the margin on a circle about the previous border point. At a
/// corner, where the label changes, the circles shrink to the radius `shortest`. Holes of the
/// region, and parts of the region narrower than a step, may be missed.
///
///     const auto border = region_border<int>(look, {0.5, 0.5});
/// @tparam Label  type that identifies the conditions defining the region
/// @param look   function PlanePoint → RegionLook<Label>; the region must be bounded
/// @param start  point inside the region; if it is outside, the result has no points
/// @param steps  step lengths, accuracies and limits
template <class Label, class Look>
RegionBorder<Label> region_border(const Look& look, const PlanePoint& start,
                                  const BorderSteps& steps = {}) {
  return detail::BorderWalk<Label, Look>(look, steps).run(start);
}

}  // namespace holdfast
