#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "holdfast/core/compiler.hpp"

namespace holdfast {

/// Outcome of a test on a stretch |x − centre| ≤ radius.
enum class Stretch {
  holds,  ///< the condition is shown to hold all over it
  fails,  ///< it fails at the centre
  open,   ///< neither: a shorter stretch may tell
};

/// How a walk ended.
enum class WalkOutcome {
  clear,    ///< the condition is shown to hold to the end
  exit,     ///< it fails at `first_outside`, the end of what is shown but for `smallest`
  open,     ///< from `last_inside` on neither can be told: round-off decides, or the work is done
  blocked,  ///< it fails at the start
};

/// Where a walk ended.
struct FirstCrossing {
  WalkOutcome outcome;   ///< how; `first_outside` is a number for `exit` alone
  double last_inside;    ///< the condition is shown to hold from the start to here
  double first_outside;  ///< the nearest argument at which it fails; NaN without an exit
  int evaluations;       ///< stretches that were examined, ≥ 1
};

/// How finely and how long a walk goes on.
struct WalkLimits {
  double smallest;  ///< > 0; what of the argument may stay unknown before an exit, as a share of
                    ///< |argument| or, if that is larger, of the first step
  int most_evaluations;  ///< ≥ 1; stretches that are examined at the most
};

/// The first argument on the way from `from` to `to` (which may lie below) at which a condition
/// fails, stretch by stretch, each of them proved: no exit can be passed over.
///
/// A stretch that joins what is known is examined; where it is shown the next is twice as long,
/// else half as long. Once an argument is known at which the condition fails, the stretches
/// approach the edge that lies before it, each leaving about a tenth of the way.
/// @param examine  centre, radius ≥ 0 → Stretch
/// @param edge     shown, failing → where between the two the condition begins to fail
/// @param from     argument at which the walk begins
/// @param to       argument at which it ends, at the latest
/// @param first    length of the first step, > 0
/// @param limits   how finely and how long
template <class Examine, class Edge>
FirstCrossing first_crossing(const Examine& examine, const Edge& edge, double from, double to,
                             double first, const WalkLimits& limits) {
  const double direction = to < from ? -1.0 : 1.0;
  FirstCrossing walk{WalkOutcome::open, from, std::numeric_limits<double>::quiet_NaN(), 1};
  if (examine(from, 0.0) == Stretch::fails) walk.outcome = WalkOutcome::blocked;
  double radius = 0.5 * first, goal = to;
  bool bounded = false;
  while (walk.outcome != WalkOutcome::blocked && walk.evaluations < limits.most_evaluations) {
    const double left = direction * (goal - walk.last_inside);
    const double smallest = limits.smallest * std::max(std::abs(walk.last_inside), first);
    if (!(left > (bounded ? smallest : 0.0))) {
      walk.outcome = bounded ? WalkOutcome::exit : WalkOutcome::clear;
      if (bounded) walk.first_outside = goal;
      return walk;
    }
    const bool last = !bounded && 2.0 * radius >= left;
    const double next = last ? 0.5 * left : std::min(radius, 0.45 * left);
    if (next < 0.1 * smallest && !last) return walk;
    const double centre = walk.last_inside + direction * next;
    const Stretch found = examine(centre, next);
    ++walk.evaluations;
    if (found == Stretch::holds) {
      walk.last_inside = last ? goal : centre + direction * next;
      radius = 2.0 * next;
    } else if (found == Stretch::fails) {
      goal = edge(walk.last_inside, centre);
      bounded = true;
    } else {
      if (next < 0.1 * smallest) return walk;
      radius = 0.5 * next;
    }
  }
  return walk;
}

}  // namespace holdfast
