#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "holdfast/core/compiler.hpp"

namespace holdfast {

/// The outcome of an attempt to prove a condition for all x in an interval |x − centre| ≤ radius.
enum class Stretch {
  holds,  ///< the condition is proved on the whole interval
  fails,  ///< the condition fails at the centre
  open,   ///< neither; the attempt may succeed on a shorter interval
};

/// The outcome of first_crossing(), which seeks the first failure of a condition on an interval.
enum class WalkOutcome {
  clear,    ///< no failure: the condition is proved up to the end of the interval
  exit,     ///< the condition fails at `first_outside` and is proved almost up to this argument
  open,     ///< undecided beyond `last_inside`, because of round-off or the limit of evaluations
  blocked,  ///< the condition fails at the start of the interval
};

/// The result of first_crossing().
struct FirstCrossing {
  WalkOutcome outcome;   ///< outcome of the search
  double last_inside;    ///< argument up to which the condition is proved
  double first_outside;  ///< argument of the first failure, as estimated; NaN unless `exit`
  int evaluations;       ///< number of intervals examined, ≥ 1
};

/// The resolution of first_crossing() and its limit of evaluations.
struct WalkLimits {
  double smallest;  ///< resolution, > 0: largest distance from `last_inside` to `first_outside`,
                    ///< relative to the larger of |last_inside| and the first step
  int most_evaluations;  ///< limit of the number of intervals examined, ≥ 1
};

/// Finds the first argument, on the way from `from` to `to`, at which a condition fails. To miss no
/// failure, the condition is proved on successive intervals, each adjoining the one before.
///
/// After a proof the next interval is twice as long, after an undecided attempt half as long. Once
/// the condition has failed, the goal is the border of the failure as estimated by `edge`. Each
/// interval then covers at most nine tenths of the distance to this goal.
/// @param examine  function (centre, radius ≥ 0) → Stretch that attempts the proof on an interval
/// @param edge     function (argument proved, argument of a failure) → estimated border in between
/// @param from     argument at the start
/// @param to       argument at the end, above or below `from`
/// @param first    length of the first interval, > 0
/// @param limits   resolution and limit of evaluations
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
