#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <utility>
#include <vector>

namespace holdfast {

/// A point of the complex plane that moves with a real argument, and where it is expected to be a
/// step further on: on a straight line, or on the spiral value · exp(rate · step + bend · step²).
struct TrackedPoint {
  using Complex = std::complex<double>;  ///< a place in the plane, or a rate of it

  Complex value;              ///< where the point is now
  Complex rate;               ///< of the value; of its logarithm on a spiral
  Complex bend = Complex(0);  ///< of a spiral: half the second derivative of the logarithm
  bool spiral = false;        ///< true: on the spiral; false: on the straight line
  double excess = std::abs(value) - 1.0;  ///< |value| − 1, where it is known without cancellation

  /// Where the point is expected once the argument has grown by `step`, which may be negative.
  Complex expected(double step) const {
    return spiral ? value * std::exp(step * (rate + step * bend)) : value + step * rate;
  }
};

/// Points of one kind, in no particular order.
using TrackedPoints = std::vector<TrackedPoint>;

/// The sets of points that are tracked, at one argument; always the same sets in the same order.
using TrackedPointSets = std::vector<TrackedPoints>;

/// True where every point lies inside the unit circle; a NaN does not.
inline bool all_inside(const TrackedPointSets& sets) {
  for (const TrackedPoints& points : sets) {
    for (const TrackedPoint& point : points) {
      if (!(point.excess < 0.0)) return false;
    }
  }
  return true;
}

/// How a walk ended.
enum class WalkOutcome {
  clear,    ///< all points stayed inside to the end
  exit,     ///< one left the unit circle between `last_inside` and `first_outside`
  blocked,  ///< one is not inside at the start
};

/// Where a walk ended.
struct FirstCrossing {
  WalkOutcome outcome;   ///< how; `first_outside` is a number for `exit` alone
  double last_inside;    ///< the last argument at which all points were inside; the start if none
  double first_outside;  ///< the first one seen at which they were not; NaN without an exit
  int evaluations;       ///< arguments at which the points were asked for, ≥ 1
};

namespace detail {

/// How badly the points here foretell those a step further on, as a share of what a safe step may
/// show: half the distance from the unit circle; or half the way, for a point that leaves.
inline double surprise(const TrackedPoints& here, const TrackedPoints& there, double step) {
  double worst = 0.0;
  for (const TrackedPoint& point : here) {
    const std::complex<double> expected = point.expected(step);
    double error = std::numeric_limits<double>::infinity(), excess = 0.0;
    for (const TrackedPoint& other : there) {
      const double distance = std::abs(other.value - expected);
      if (distance < error) {
        error = distance;
        excess = other.excess;
      }
    }
    const bool both_inside = point.excess < 0.0 && excess < 0.0;
    const double room =
        both_inside ? std::min(-point.excess, -excess) : std::abs(excess - point.excess);
    worst = std::max(worst, 2.0 * error / room);
  }
  return worst;
}

/// The same from both ends; above 1 something may have happened in between.
inline double contradiction(const TrackedPointSets& here, const TrackedPointSets& there,
                            double step) {
  double worst = 0.0;
  for (std::size_t k = 0; k < here.size(); ++k) {
    worst =
        std::max({worst, surprise(here[k], there[k], step), surprise(there[k], here[k], -step)});
  }
  return std::isfinite(worst) ? worst : std::numeric_limits<double>::infinity();
}

}  // namespace detail

/// The first argument on the way from `from` to `to` (which may lie below) at which one of the
/// tracked points leaves the unit circle, as a bracket.
///
/// A step is taken only if what the points' speeds foretell at either end is what is found at the
/// other, up to half of each point's distance from the circle; otherwise it is shortened. Both ends
/// inside, the expected paths are inside too, and a smooth motion leaves them in the middle of the
/// step by about a quarter of what it misses at its ends. Steps are thus long where the points move
/// steadily and shrink as one nears the circle, but never below `smallest` times the argument: an
/// excursion narrower than that may be passed over, and so may one that is over within a step and
/// of which neither end shows anything.
/// @param evaluate  argument → TrackedPointSets
/// @param from      argument at which the walk begins
/// @param to        argument at which it ends, at the latest
/// @param first     length of the first step, > 0
/// @param smallest  shortest step as a share of |argument| or, if that is larger, of `first`, > 0
template <class Evaluate>
FirstCrossing first_crossing(const Evaluate& evaluate, double from, double to, double first,
                             double smallest) {
  const double direction = to < from ? -1.0 : 1.0;
  TrackedPointSets here = evaluate(from);
  FirstCrossing result{WalkOutcome::blocked, from, std::numeric_limits<double>::quiet_NaN(), 1};
  if (!all_inside(here)) return result;
  double length = first, longest_growth = 3.0;
  while (direction * (to - result.last_inside) > 0.0) {
    const double floor = smallest * std::max(std::abs(result.last_inside), first);
    const bool shortest = !(length > floor);
    double next = result.last_inside + direction * (shortest ? floor : length);
    if (direction * (to - next) <= 0.0) next = to;
    if (next == result.last_inside) break;
    const double step = next - result.last_inside;
    TrackedPointSets there = evaluate(next);
    ++result.evaluations;
    const double share = detail::contradiction(here, there, step);
    // What is missed grows with the square of the step, or faster where roots meet.
    length = std::abs(step) * std::clamp(0.9 / std::sqrt(share), 0.1, longest_growth);
    longest_growth = share > 1.0 ? 1.3 : 3.0;
    if (share > 1.0 && !shortest) continue;
    if (!all_inside(there)) {
      result.outcome = WalkOutcome::exit;
      result.first_outside = next;
      return result;
    }
    result.last_inside = next;
    here = std::move(there);
  }
  result.outcome = WalkOutcome::clear;
  return result;
}

}  // namespace holdfast
