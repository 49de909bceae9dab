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

/// Outcome of the search for the differential gain D of minimum spectral radius.
enum class MinimumRadiusOutcome {
  point,       ///< one D has the minimum radius
  plateau,     ///< all D of `interval` have the minimum radius, that of a root independent of D
  idle,        ///< the radius does not depend on D; `interval` contains every D, the result is 0
  unresolved,  ///< P is so large that round-off hides the minimum: the result is the initial D and
               ///< its radius, and `lower_bound` is 0
};

/// The differential gain D with which the sampled loop decays fastest, for a given gain P.
struct MinimumRadius {
  MinimumRadiusOutcome outcome;  ///< kind of minimum: one D, an interval, every D, or unresolved
  double differential_gain;      ///< gain D (N s/m) of minimum radius, inside `interval`
  double radius;                 ///< least spectral radius ρ = max |λ|; stable if ρ < 1
  double margin;                 ///< margin 1 − `radius`, computed without cancellation
  double lower_bound;            ///< lower bound of the spectral radius over all D; ≤ `radius`
  Interval<double> interval;     ///< interval of D (N s/m) with a radius up to `radius` + 1e−12
};

namespace detail {

/// Calls `consider` with probable minima of a function: the middle of each interval, and the
/// intersection of the two secants that join its ends to the ends of the outer interval around it.
/// @param intervals  intervals on which the function is below a level
/// @param outer      intervals on which the function is below a higher level
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

/// Search for the least r for which the set {D : ρ(P, D) < r} is not empty; r is called a level.
///
/// The set is a union of intervals known for every r, and grows with r, so that each tested level
/// bounds the global minimum from above or from below. The next level is ρ at a probable minimum
/// (`consider_promising`), exact in the limit for a smooth minimum or two crossing branches.
/// @tparam Loop  polynomial of the loop in `double`, see `LoopPolynomial`
template <class Loop>
class MinimumRadiusSearch {
 public:
  using Intervals = std::vector<Interval<double>>;

  /// @param accuracy  admissible relative error of the margin; 0 for full precision
  MinimumRadiusSearch(const Loop& loop, double proportional_gain, double accuracy = 0.0)
      : loop_(loop), proportional_gain_(proportional_gain), accuracy_(accuracy) {}

  /// Runs the search. @param start  initial D (N s/m), arbitrary; a D near the minimum is faster
  MinimumRadius from(double start) {
    const double at_start = loop_.radius_offset({proportional_gain_, start});
    if (!begin(at_start))
      return {MinimumRadiusOutcome::unresolved, start, loop_.centre + at_start,
              (1.0 - loop_.centre) - at_start,  0.0,   {start, start}};
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

  /// The difference below which two levels count as equal.
  double tolerance() const {
    const double round_off = 1e-14 * (loop_.centre == 0.0 ? std::abs(upper_) : loop_.scale());
    return round_off + accuracy_ * std::abs((1.0 - loop_.centre) - upper_) + 1e-18;
  }
  double closing_step() const { return 4.0 * tolerance(); }

  /// Raises a level until some D has a smaller radius; false if that fails (overflow).
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

  /// The next level: ρ at a probable minimum if lower, else a step down whose length doubles.
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

  /// The result, for a D with a radius slightly above the least level. Where two roots coincide,
  /// the radius grows like √|D − D_min| and is much larger at the rounded D_min.
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

/// Adapter of a loop of any order for `MinimumRadiusSearch`; a radius ρ is given as offset ρ − 1.
/// @tparam Loop  a `LoopMap<double>` or `ModalResponse<double>`
template <class Loop>
struct RadiusLevels {
  const Loop& loop;     ///< the loop, which is not copied
  double centre = 1.0;  ///< radius that is subtracted from all radii

  /// The scale of the roots' round-off: 1, the size of the map's entries for delayed commands.
  double scale() const { return 1.0; }
  /// The offset ρ(P, D) − 1 of the spectral radius.
  double radius_offset(const PdGains<double>& gains) const { return loop_excess(loop, gains); }
  /// The intervals of D with ρ(P, D) < 1 + offset.
  std::vector<Interval<double>> differential_gains_within(double proportional_gain,
                                                          double offset) const {
    if (!(1.0 + offset > 0.0)) return {};
    return differential_gains_within_radius(loop, proportional_gain, 1.0 + offset);
  }
};

}  // namespace detail

/// The D of minimum spectral radius ρ(P, D) for a given P: a global minimum, found without a grid.
///
/// For any radius r the set {D : ρ(P, D) < r} is a union of intervals. They are computed in closed
/// form for two masses (`stable_intervals`), and from the roots on the circle |λ| = r for a loop of
/// any order (`circle_crossings`). The minimum radius is the r at which the set becomes empty. For
/// a `LoopMap` it is accurate to about 10⁻⁹, since round-off separates coinciding roots. A minimum
/// exists: ρ grows without bound with |D|, or no root depends on D.
/// @tparam Loop              `SampledLoop<double>` or `LoopMap<double>`
/// @param loop               loop from `sampled_loop` or `loop_map`
/// @param proportional_gain  P (N/m), finite
/// @param start              initial D (N s/m), finite and arbitrary
/// @throws InvalidParameter where a gain is not finite
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
