#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "holdfast/control/gains.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/core/interval.hpp"
#include "holdfast/stability/boundary/boundary_features.hpp"
#include "holdfast/stability/boundary/boundary_point.hpp"
#include "holdfast/stability/design/minimum_radius.hpp"
#include "holdfast/stability/polynomial/loop_polynomial.hpp"

namespace holdfast {

/// The outcome of the search for the pair of gains of minimum spectral radius.
enum class MinimumRadiusGainsOutcome {
  found,  ///< `radius` and `lower_bound` agree to 1e−6 of the roots' distance from λ = 1
  open,   ///< they do not agree: better gains may exist, but none with a radius below `lower_bound`
  idle,  ///< some combination of the gains does not move the roots: P is 0 and D the best for P = 0
};

/// The pair of gains with which the sampled loop decays fastest.
struct MinimumRadiusGains {
  MinimumRadiusGainsOutcome outcome;  ///< whether `radius` is proved to be the least
  PdGains<double> gains;              ///< P (N/m), D (N s/m)
  double radius;                      ///< spectral radius ρ = max |λ| with these gains
  double margin;                      ///< 1 − radius, computed without cancellation
  double lower_bound;                 ///< every pair of gains has at least this radius; ≤ radius
};

namespace detail {

constexpr int binomial(int n, int k) { return k == 0 ? 1 : binomial(n - 1, k - 1) * n / k; }

/// Intersects a range with the interval between two values.
inline void narrow(Interval<double>& range, double low, double high) {
  range.lower = std::max(range.lower, std::min(low, high));
  range.upper = std::min(range.upper, std::max(low, high));
}

/// A rectangle that contains all gains for which the roots λ′ = 1 + μ all have |λ′| < 1. Then the
/// coefficient of λ′^k, an affine function b_k + P p_k + D d_k of the gains, is within ± C(5, k):
/// these are five strips, any two of which bound a parallelogram. Infinite where all are parallel.
template <class Scalar>
GainWindow window_of_unit_radius(const AffinePolynomial<Scalar, 5>& in_powers_of_mu) {
  const auto q = in_powers_of_mu.template transformed<PolynomialVariable::about_centre>(
      [](const Polynomial<Scalar, 5>& p) { return shifted(p, Scalar(-1)); });
  GainWindow window{};  // without ends
  for (int i = 0; i < 5; ++i) {
    for (int j = 0; j < i; ++j) {
      const Scalar pi = q.proportional[i], pj = q.proportional[j];
      const Scalar di = q.differential[i], dj = q.differential[j];
      const Scalar determinant = pi * dj - pj * di;
      // Cramer's rule with ± half-widths: the centre and the largest deviation from it.
      const Scalar wi = std::abs(q.base[5]) * binomial(5, i);
      const Scalar wj = std::abs(q.base[5]) * binomial(5, j);
      const Scalar p = (q.base[j] * di - q.base[i] * dj) / determinant;
      const Scalar d = (q.base[i] * pj - q.base[j] * pi) / determinant;
      const Scalar p_reach = (wi * std::abs(dj) + wj * std::abs(di)) / std::abs(determinant);
      const Scalar d_reach = (wj * std::abs(pi) + wi * std::abs(pj)) / std::abs(determinant);
      if (!std::isfinite(p_reach + d_reach + p + d)) continue;
      narrow(window.proportional, p - p_reach, p + p_reach);
      narrow(window.differential, d - d_reach, d + d_reach);
    }
  }
  return window;
}

/// The search for the least level r for which {(P, D) : ρ < r} is not empty.
///
/// The shape of that set over P changes only at the special points of its boundary
/// (`boundary_features`); between neighbouring ones a single P decides whether the set has gains
/// (`stable_intervals`). So each tested level bounds the global minimum from above or from below.
/// Levels are taken from min ρ over D (`MinimumRadiusSearch`) at P where it is probably least
/// (`consider_promising`).
/// @tparam Loop  polynomial of the loop in `double`, see `LoopPolynomial`
template <class Loop>
class MinimumRadiusGainsSearch {
 public:
  using Intervals = std::vector<Interval<double>>;

  explicit MinimumRadiusGainsSearch(const Loop& loop) : loop_(loop) {}

  MinimumRadiusGains run() {
    upper_ = loop_.radius_offset(best_);
    const GainWindow all = window_of_unit_radius(loop_.at_radius(upper_));
    if (!std::isfinite(all.width()) || !std::isfinite(all.height())) return answer_without_pair();
    lower_ = -loop_.centre;
    intervals_ = within(upper_);
    probe_ = closing_step();
    for (int idle_rounds = 0; upper_ - lower_ > closing_step() && idle_rounds < 10;) {
      const double gap = upper_ - lower_;
      refine();
      idle_rounds = upper_ - lower_ < gap ? 0 : idle_rounds + 1;
    }
    const bool closed = upper_ - lower_ <= 1000.0 * closing_step();
    return {closed ? MinimumRadiusGainsOutcome::found : MinimumRadiusGainsOutcome::open, best_,
            loop_.centre + upper_, (1.0 - loop_.centre) - upper_,
            std::max(0.0, loop_.centre + lower_)};
  }

 private:
  double closing_step() const {
    return 1e-9 * std::max(loop_.scale(), std::min(1.0, std::abs(upper_)));
  }

  MinimumRadiusGains answer_without_pair() const {
    const auto least = MinimumRadiusSearch(loop_, 0.0).from(0.0);
    return {MinimumRadiusGainsOutcome::idle,
            {0.0, least.differential_gain},
            least.radius,
            least.margin,
            least.lower_bound};
  }

  /// Lowers the upper bound or, where that no longer helps, tests a level below it.
  void refine() {
    const double found = descend();
    const double drop = upper_ - found, margin = std::abs((1.0 - loop_.centre) - found);
    accuracy_ = std::clamp(0.02 * drop / margin, 1e-13, accuracy_);
    const bool helps = drop > closing_step();
    upper_ = found;
    if (helps) {
      previous_ = std::exchange(intervals_, within(found));
      return;
    }
    const double trial = std::max(upper_ - probe_, lower_ + (upper_ - lower_) / 2.0);
    probe_ *= 4.0;
    Intervals below = within(trial);
    if (below.empty()) {
      lower_ = trial;
    } else {
      intervals_ = std::move(below);
    }
  }

  /// The intervals of P in which some D has a radius below the level.
  Intervals within(double offset) const {
    if (!(loop_.centre + offset > 0.0)) return {};
    const auto polynomial = loop_.at_radius(offset);
    const GainWindow window = window_of_unit_radius(polynomial);
    if (!(window.width() > 0.0) || !(window.height() > 0.0)) return {};
    std::vector<double> cuts{window.proportional.lower, window.proportional.upper};
    for (const auto& feature : boundary_features(polynomial, window)) {
      cuts.push_back(feature.gains.proportional);
    }
    std::sort(cuts.begin(), cuts.end());
    Intervals result;
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
      const Interval<double> gap{cuts[k], cuts[k + 1]};
      if (!(gap.lower < gap.upper)) continue;
      if (differential_intervals(polynomial, gap.representative()).empty()) continue;
      if (!result.empty() && result.back().upper == gap.lower) {
        result.back().upper = gap.upper;
      } else {
        result.push_back(gap);
      }
    }
    return result;
  }

  /// The least radius over D at a P where it is probably least; the best gains so far are stored.
  double descend() {
    double best = upper_;
    consider_promising(intervals_, previous_, [&](double proportional) {
      const auto least =
          MinimumRadiusSearch(loop_, proportional, accuracy_).from(best_.differential);
      const PdGains<double> gains{proportional, least.differential_gain};
      const double offset = loop_.radius_offset(gains);
      if (!(offset < best)) return;
      best = offset;
      best_ = gains;
    });
    return best;
  }

  Loop loop_;
  PdGains<double> best_{0.0, 0.0};
  double lower_ = 0.0, upper_ = 0.0, probe_ = 0.0;
  double accuracy_ = 1e-3;  // of the minima over D, a share of the margin
  Intervals intervals_, previous_;
};

}  // namespace detail

/// The pair of gains of minimum spectral radius, min over P and D of ρ(S(P, D)): a global minimum.
///
/// Whether {(P, D) : ρ < r} is empty is decided in closed form for every r: the special points of
/// its boundary divide the P axis into ranges in each of which one P is representative. The minimum
/// radius is the r at which the set becomes empty. There two pairs often coincide; the roots then
/// depend on the gains like a square root, and gains in `double` give the radius to about 1e−8. If
/// all roots of the plant decay to 1e−6 within a sample the outcome may be `open`.
/// @tparam Loop  any in `double` that has a `loop_polynomial`
/// @param loop   loop of `sampled_loop`
template <class Loop>
MinimumRadiusGains minimum_radius_gains(const Loop& loop) {
  return detail::MinimumRadiusGainsSearch(loop_polynomial(loop)).run();
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template MinimumRadiusGains minimum_radius_gains(const SampledLoop<double>&);
#endif

}  // namespace holdfast
