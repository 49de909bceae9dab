#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "holdfast/core/compiler.hpp"

namespace holdfast {

/// The outcome of a test on an interval |x − centre| ≤ radius.
enum class Stretch {
  holds,  ///< the condition is proved on the whole interval
  fails,  ///< the condition fails at the centre
  open,   ///< undecided: a shorter interval may be decided
};

/// The outcome of the walk of first_crossing().
enum class WalkOutcome {
  clear,    ///< the condition is proved up to the end
  exit,     ///< it fails at `first_outside`, within `smallest` of the proved range
  open,     ///< from `last_inside` on it is undecided, by round-off or by the limit of work
  blocked,  ///< it fails at the start
};

/// The end of the walk of first_crossing().
struct FirstCrossing {
  WalkOutcome outcome;   ///< outcome; `first_outside` is a number for `exit` only
  double last_inside;    ///< the condition is proved from the start to here
  double first_outside;  ///< the nearest argument where it fails; NaN without an exit
  int evaluations;       ///< number of intervals examined, ≥ 1
};

/// The resolution and the work of the walk of first_crossing().
struct WalkLimits {
  double smallest;  ///< > 0; largest unproved range before an exit, as a share of |argument| or, if
                    ///< larger, of the first step
  int most_evaluations;  ///< ≥ 1; most intervals to be examined
};

/// The first argument on the way from `from` to `to` (which may be smaller) at which a condition
/// fails, found by proofs on successive intervals: no exit is passed over.
///
/// Each interval adjoins the proved range. After a proof the next interval is twice as long, else
/// half as long. Once a failing argument is known, the intervals approach the edge before it, each
/// leaving about a tenth of the distance.
/// @param examine  (centre, radius ≥ 0) → Stretch
/// @param edge     (proved, failing) → estimate of the argument where the condition begins to fail
/// @param from     argument at the start
/// @param to       argument at the end
/// @param first    length of the first step, > 0
/// @param limits   resolution and work
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
