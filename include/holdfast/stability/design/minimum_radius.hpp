#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <vector>

#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/core/interval.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "holdfast/stability/margins/loop_form.hpp"
#include "holdfast/stability/polynomial/loop_polynomial.hpp"

namespace holdfast {

/// Outcomes of the search for the D of minimum spectral radius.
enum class MinimumRadiusOutcome {
  point,       ///< one D has the minimum radius
  plateau,     ///< a root that D does not move sets the radius over the whole `interval`
  idle,        ///< no D changes the radius; `interval` is the whole line and D is 0
  unresolved,  ///< P is so large that round-off hides the minimum radius: D is the start, `radius`
               ///< is that of the start and `lower_bound` is 0
};

/// The differential gain at which the sampled loop decays fastest, at a fixed P.
struct MinimumRadius {
  MinimumRadiusOutcome outcome;  ///< whether one D has the radius, many, all, or none is known to
  double differential_gain;      ///< D (N s/m), inside `interval`
  double radius;                 ///< the least ρ = max |λ|; stable ⇔ below 1
  double margin;                 ///< 1 − radius without cancellation
  double lower_bound;            ///< no D at all has a radius below this; ≤ radius
  Interval<double> interval;     ///< the D (N s/m) with that radius to 1e−12
};

namespace detail {

/// Calls `consider` with where a function whose level sets these are may be least: the middle of
/// each interval, and the vertex of the V where the secants of its two ends meet, between its level
/// and the one above in which it lies.
/// @param outer     intervals of a higher level
template <class Consider>
void consider_promising(const std::vector<Interval<double>>& intervals,
                        const std::vector<Interval<double>>& outer, const Consider& consider) {
  for (const Interval<double>& lower : intervals) {
    consider(lower.representative());
    for (const Interval<double>& higher : outer) {
      if (!(higher.lower < lower.lower && lower.upper < higher.upper)) continue;
      const double left = 1.0 / (lower.lower - higher.lower);
      const double right = 1.0 / (higher.upper - lower.upper);
      consider((left * lower.lower + right * lower.upper) / (left + right));
    }
  }
}

/// Narrows the least level r at which {D : ρ(P, D) < r} is not empty.
///
/// The set is a union of intervals known for every r, and it grows with r, so that each level
/// tested bounds the global minimum from above or from below. Levels to test come from ρ in the
/// middle of the intervals and where the secants of their two ends meet, which are exact in the
/// limit for a smooth minimum and for two branches that cross.
/// @tparam Loop  the loop's polynomial in `double`, as `LoopPolynomial`
template <class Loop>
class MinimumRadiusSearch {
 public:
  using Intervals = std::vector<Interval<double>>;

  /// @param accuracy  what the margin may err by as a share of itself; 0 for all digits
  MinimumRadiusSearch(const Loop& loop, double proportional_gain, double accuracy = 0.0)
      : loop_(loop), proportional_gain_(proportional_gain), accuracy_(accuracy) {}

  /// @param start  any D; the closer the quicker
  MinimumRadius from(double start) {
    if (!begin(loop_.radius_offset({proportional_gain_, start}))) {
      return {MinimumRadiusOutcome::unresolved, start, loop_.centre + upper_,
              (1.0 - loop_.centre) - upper_,    0.0,   {start, start}};
    }
    for (int round = 0; round < most_rounds_ && upper_ - lower_ > closing_step(); ++round) {
      const double trial = next_level();
      Intervals found = within(trial);
      if (found.empty()) {
        lower_ = trial;
        continue;
      }
      previous_ = std::move(intervals_);
      intervals_ = std::move(found);
      upper_ = trial;
    }
    return answer();
  }

 private:
  static constexpr int most_rounds_ = 300, most_raises_ = 40;

  Intervals within(double offset) const {
    return loop_.differential_gains_within(proportional_gain_, offset);
  }

  /// Below this, levels differ by round-off.
  double tolerance() const {
    const double round_off = 1e-14 * (loop_.centre == 0.0 ? std::abs(upper_) : loop_.scale());
    return round_off + accuracy_ * std::abs((1.0 - loop_.centre) - upper_) + 1e-18;
  }
  double closing_step() const { return 4.0 * tolerance(); }

  /// False where no level has gains, as when coefficients overflow.
  bool begin(double level) {
    lower_ = -loop_.centre;
    upper_ = level;
    // The start may be the minimum itself, whose own open level set is empty. It is no bound from
    // below: at its own level the start lies on the boundary, where round-off decides.
    double raise = tolerance();
    for (int k = 0; k < most_raises_ && (intervals_ = within(upper_)).empty(); ++k, raise *= 4.0)
      upper_ += raise;
    probe_ = closing_step();
    return !intervals_.empty();
  }

  /// The best ρ in sight if it improves, else a step below the level, doubled while it finds gains.
  double next_level() {
    double best = upper_;
    consider_promising(intervals_, previous_, [&](double differential) {
      best = std::min(best, loop_.radius_offset({proportional_gain_, differential}));
    });
    best += tolerance();
    if (best < upper_ - closing_step() && best > lower_) return best;
    const double middle = lower_ + (upper_ - lower_) / 2.0;
    const double below = upper_ - probe_;
    probe_ *= 2.0;
    return std::max(below, middle);
  }

  /// The gains a trifle above the least level: where two roots meet, the radius answers to the
  /// square root of a change of D, and the very D of the minimum is a rounding error away from a
  /// much larger radius.
  MinimumRadius answer() const {
    const Intervals close = within(upper_ + 1e-12 * std::max(loop_.scale(), std::abs(upper_)));
    const Interval<double> interval = close.empty() ? intervals_.front() : close.front();
    const bool idle = !std::isfinite(interval.lower) || !std::isfinite(interval.upper);
    const double size = std::max(std::abs(interval.lower), std::abs(interval.upper));
    const bool plateau = interval.upper - interval.lower > 1e-3 * size;
    const auto outcome = idle      ? MinimumRadiusOutcome::idle
                         : plateau ? MinimumRadiusOutcome::plateau
                                   : MinimumRadiusOutcome::point;
    return {outcome,
            interval.representative(),
            loop_.centre + upper_,
            (1.0 - loop_.centre) - upper_,
            std::max(0.0, loop_.centre + lower_),
            interval};
  }

  Loop loop_;
  double proportional_gain_, accuracy_;
  double lower_ = 0.0, upper_ = 0.0, probe_ = 0.0;
  Intervals intervals_, previous_;
};

/// A loop of any order as `MinimumRadiusSearch` asks for it, radii counted from 1.
/// @tparam Loop  a `LoopMap<double>` or `ModalResponse<double>`
template <class Loop>
struct RadiusLevels {
  const Loop& loop;     ///< kept outside
  double centre = 1.0;  ///< from which radii are counted

  /// Number of which round-off of a root is a share: the commands on their way have entries of 1.
  double scale() const { return 1.0; }
  /// ρ(P, D) − 1.
  double radius_offset(const PdGains<double>& gains) const { return loop_excess(loop, gains); }
  /// The D with ρ(P, D) < 1 + offset.
  std::vector<Interval<double>> differential_gains_within(double proportional_gain,
                                                          double offset) const {
    if (!(1.0 + offset > 0.0)) return {};
    return differential_gains_within_radius(loop, proportional_gain, 1.0 + offset);
  }
};

}  // namespace detail

/// min over D of ρ(S(P, D)): the global minimum, not by scanning.
///
/// {D : ρ(P, D) < r} is a union of intervals in closed form, those in which the polynomial in λ/r
/// is stable (`stable_intervals`); of a loop of any order they come from the crossings of the
/// circle of radius r (`circle_crossings`). The minimum radius is the r at which the set becomes
/// empty; of a `LoopMap` to about 10⁻⁹, what round-off makes of two roots that meet. ρ grows
/// without bound as |D| does: the minimum exists unless no coefficient contains D.
/// @tparam Loop              any in `double` that has a `loop_polynomial`, or a `LoopMap`
/// @param loop               of `sampled_loop` or `loop_map`
/// @param proportional_gain  P (N/m), finite
/// @param start              a D (N s/m) to begin from, finite; any will do
/// @throws InvalidParameter for gains that are not finite
template <class Loop>
MinimumRadius minimum_radius(const Loop& loop, double proportional_gain, double start = 0.0) {
  require_finite("proportional gain P", proportional_gain, "N/m");
  require_finite("differential gain D", start, "N s/m");
  if constexpr (std::is_same_v<Loop, LoopMap<double>>) {
    const detail::RadiusLevels<Loop> levels{loop};
    return detail::MinimumRadiusSearch(levels, proportional_gain, 1e-9).from(start);
  } else {
    return detail::MinimumRadiusSearch(loop_polynomial(loop), proportional_gain).from(start);
  }
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template MinimumRadius minimum_radius(const LoopMap<double>&, double, double);
extern template MinimumRadius minimum_radius(const SampledLoop<double>&, double, double);
#endif

}  // namespace holdfast
