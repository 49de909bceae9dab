#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <vector>

#include "holdfast/control/gains.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/math/roots/bracketing_root.hpp"
#include "holdfast/plant/plant_poles.hpp"
#include "holdfast/stability/boundary/unit_circle_crossings.hpp"
#include "holdfast/stability/margins/margins.hpp"
#include "holdfast/stability/response/modal_response.hpp"

namespace holdfast {

namespace detail {

/// The margins of a loop given by the poles of its plant.
template <class Scalar>
struct ModalMargins {
  using Response = ModalResponse<Scalar>;
  using Circle = UnitCircleCrossings<Scalar>;

  const std::vector<PlantPole>& poles;
  Sampling<Scalar> sampling;
  PdGains<Scalar> gains;
  bool has_velocity_sensor;
  Response response = response_at(sampling);
  Scalar reserve = -loop_excess_or_turn(response, gains);  // 1 − ρ

  bool is_stable() const { return reserve > Scalar(0); }

  TwoSidedMargin of_gain(FreeGain free) const {
    const Scalar value = gain_of(gains, free);
    const auto stable = UnitCircleCrossings<Scalar>(response).stable_gains(free, gains);
    return margin_in(stable, value, [&](Scalar position) {
      const Scalar outside = position + Scalar(1e-9) * (position - value);
      return boundary_at(response, with_gain(gains, free, outside), position, value,
                         sampling.period);
    });
  }

  /// The stable interval of a common factor of both gains, around 1.
  Interval<Scalar> factors() const {
    const UnitCircleCrossings<Scalar> circle(loop_response());
    for (const Interval<Scalar>& interval : circle.stable_gains(FreeGain::differential, {}))
      if (interval.contains(Scalar(1))) return interval;
    return {Scalar(1), Scalar(1)};
  }

  /// The phase margin, the least |arg L| where |L| = 1, L = P G_z + D G_v.
  Scalar phase() const {
    const auto loop_gain = [&](const Scalar& angle) {
      const auto g = response.at_angle(angle);
      return gains.proportional * g.displacement + gains.differential * g.velocity;
    };
    const auto level = [&](const Scalar& angle) { return std::norm(loop_gain(angle)) - Scalar(1); };
    Scalar least = std::numeric_limits<Scalar>::infinity(), before(0), at_before(-1);
    const UnitCircleCrossings<Scalar> circle(response);
    for (const auto& [angle, g] : circle.places()) {
      const Scalar here = level(angle);
      if ((here > Scalar(0)) != (at_before > Scalar(0))) {
        const auto crossing =
            bracketing_root<Scalar>(level, {before, angle, at_before, here}, Scalar(0));
        least = std::min(least, std::abs(std::arg(loop_gain(crossing.lower))));
      }
      before = angle;
      at_before = here;
    }
    return least;
  }

  /// Searches from a value towards a limit, and finds the boundary in the first unstable step.
  /// @param sampling_at  map from the quantity to the sampling
  /// @param next         map from a position to the next one, towards the limit
  template <class SamplingAt, class Next>
  MarginEnd walk(Scalar value, Scalar limit, const SamplingAt& sampling_at,
                 const Next& next) const {
    const auto excess = [&](const Scalar& x) {
      return loop_excess_or_turn(response_at(sampling_at(x)), gains);
    };
    Scalar inside = value;
    while (inside != limit) {
      const Scalar beyond =
          limit > value ? std::min(limit, next(inside)) : std::max(limit, next(inside));
      const Circle circle(response_at(sampling_at(beyond)), Circle::coarse);
      if (circle.roots_outside(gains) == 0 || excess(beyond) < Scalar(0)) {
        inside = beyond;
        continue;
      }
      const auto [lower, upper] = std::minmax(inside, beyond);
      const auto crossing = bracketing_root<Scalar>(
          excess, {lower, upper, excess(lower), excess(upper)}, Scalar(1e-9) * value);
      const bool down = beyond < inside;
      const Scalar edge = down ? crossing.upper : crossing.lower;
      const Scalar unstable = down ? crossing.lower : crossing.upper;
      return boundary_at(response_at(sampling_at(unstable)), gains, edge, value,
                         sampling_at(edge).period);
    }
    return beyond_search(inside, value);
  }

  /// The end of the stable range, sought between a stable position and an unstable one beyond it.
  /// @param of_period  true: the quantity is τ, with δ/τ constant; false: it is δ
  MarginEnd between(Scalar inside, Scalar outside, bool of_period) const {
    const Scalar value = of_period ? sampling.period : sampling.processing_delay;
    return walk(
        value, outside,
        [&](Scalar x) {
          return of_period ? with_period(x) : Sampling<Scalar>{sampling.period, x};
        },
        [&](Scalar x) { return x == inside || value == inside ? outside : inside; });
  }

  TwoSidedMargin of_period(Scalar ratio) const {
    const Scalar period = sampling.period, resolved(nyquist_period(poles));
    const auto sampling_at = [&](Scalar tau) { return with_period(tau); };
    const auto shorter = [&](Scalar tau) {
      return tau - std::clamp(resolved, tau, Scalar(10) * tau) / Scalar(21);
    };
    return {
        walk(period, period / ratio, sampling_at, shorter),
        walk(period, period * ratio, sampling_at, [](Scalar tau) { return tau * Scalar(1.05); })};
  }

  TwoSidedMargin of_delay() const {
    const Scalar period = sampling.period, delay = sampling.processing_delay;
    const Scalar step = period / Scalar(8);
    const auto sampling_at = [&](Scalar late) { return Sampling<Scalar>{period, late}; };
    MarginEnd below = walk(delay, Scalar(0), sampling_at, [&](Scalar late) { return late - step; });
    if (below.outcome == MarginEndOutcome::beyond_search && below.position == 0.0)
      below = no_boundary(0.0);
    return {below, walk(delay, delay + Scalar(most_delays) * period, sampling_at,
                        [&](Scalar late) { return late + step; })};
  }

 private:
  Response response_at(const Sampling<Scalar>& other) const {
    return modal_response<Scalar>(poles, other).with_sensor(has_velocity_sensor);
  }

  /// The response with P G_z + D G_v in place of G_v: its D is a common factor of both gains.
  Response loop_response() const {
    const Scalar p = gains.proportional, d = gains.differential;
    if (!has_velocity_sensor)
      return response.with_velocity_from_displacement({p, d / sampling.period});
    std::vector<typename Response::Residue> residues;
    residues.reserve(poles.size());
    for (const PlantPole& pole : poles)
      residues.push_back({pole.s, pole.residue, (p + d * pole.s) * pole.residue});
    return {residues, sampling};
  }

  Sampling<Scalar> with_period(Scalar period) const {
    return {period, sampling.processing_delay / sampling.period * period};
  }

  /// The end at which a root crosses the unit circle.
  /// @param there  response just outside the stable range, where the crossing root is the largest
  static MarginEnd boundary_at(const Response& there, const PdGains<Scalar>& with, Scalar position,
                               Scalar value, Scalar period) {
    std::complex<Scalar> root = largest_loop_root(there, with);
    if (!std::isfinite(std::abs(root)))
      root = Scalar(1) + UnitCircleCrossings<Scalar>(there).roots_nearby(with).front();
    return crossing_end(root, std::abs(root - Scalar(1)), position, value, period);
  }
};

}  // namespace detail

/// The stability margins of D, P, τ and δ, one at a time, for a loop given by its plant's poles.
///
/// The margins of D and P are found by `UnitCircleCrossings`. Upwards τ is varied in steps of 5 %.
/// Downwards the steps are 5 % of the `nyquist_period`, clamped to τ … 10 τ. δ is varied in steps
/// of τ/8. At each step the roots outside the unit circle are counted. An unstable range narrower
/// than a step may be missed; `proved_sampling_margins` misses none. Without a boundary the outcome
/// is `beyond_search`, or `none` for a δ that has reached 0.
/// @param poles     all `plant_poles` of the plant
/// @param sampling  τ (s) > 0, δ (s) 0 … 1000 τ
/// @param gains     P (N/m) and D (N s/m), finite
/// @param search    r = `longest_period_ratio` limits τ to τ/r … τ r; `most_steps` is not used
/// @param has_velocity_sensor  whether velocity is measured; if not, D multiplies the backward
///                             difference of the displacement readings
/// @throws InvalidParameter where an argument is outside its range
template <class Scalar = double>
StabilityMargins modal_stability_margins(const std::vector<PlantPole>& poles,
                                         const Sampling<detail::Undeduced<Scalar>>& sampling,
                                         const PdGains<detail::Undeduced<Scalar>>& gains,
                                         const MarginSearch& search = {},
                                         bool has_velocity_sensor = true) {
  validate(gains);
  validate(search);
  const detail::ModalMargins<Scalar> margins{poles, sampling, gains, has_velocity_sensor};
  const TwoSidedMargin by_d = margins.of_gain(FreeGain::differential);
  const TwoSidedMargin by_p = margins.of_gain(FreeGain::proportional);
  const bool stable = margins.is_stable() && by_d.below.outcome != MarginEndOutcome::undefined &&
                      by_p.below.outcome != MarginEndOutcome::undefined;
  if (!stable) return {MarginOutcome::not_stable, std::min(margins.reserve, 0.0), {}, {}, {}, {}};
  return {MarginOutcome::stable,
          margins.reserve,
          by_d,
          by_p,
          margins.of_period(search.longest_period_ratio),
          search.of_delay ? margins.of_delay() : TwoSidedMargin{}};
}

/// The value of τ or δ at which a loop with measured velocity becomes unstable. It lies between
/// `inside` (s), up to which the loop is stable (`ProvedMarginEnd`), and `outside` (s), at which it
/// is unstable. If `of_period`, τ varies, with δ/τ constant; if not, δ varies, with τ constant. The
/// other arguments are those of `modal_stability_margins`.
template <class Scalar = double>
MarginEnd modal_margin_end(const std::vector<PlantPole>& poles,
                           const Sampling<detail::Undeduced<Scalar>>& sampling,
                           const PdGains<detail::Undeduced<Scalar>>& gains,
                           detail::Undeduced<Scalar> inside, detail::Undeduced<Scalar> outside,
                           bool of_period) {
  return detail::ModalMargins<Scalar>{poles, sampling, gains, true}.between(inside, outside,
                                                                            of_period);
}

/// The gain, phase and delay margins of a loop given by its plant's poles. The delay margin is
/// searched in steps of τ/8. The arguments are those of `modal_stability_margins`.
/// @throws InvalidParameter where an argument is outside its range
template <class Scalar = double>
LoopMargins modal_loop_margins(const std::vector<PlantPole>& poles,
                               const Sampling<detail::Undeduced<Scalar>>& sampling,
                               const PdGains<detail::Undeduced<Scalar>>& gains,
                               bool has_velocity_sensor = true) {
  validate(gains);
  const detail::ModalMargins<Scalar> margins{poles, sampling, gains, has_velocity_sensor};
  if (!margins.is_stable()) return {MarginOutcome::not_stable, margins.reserve};
  const Interval<Scalar> factors = margins.factors();
  return {MarginOutcome::stable, margins.reserve, factors.upper,
          factors.lower,         margins.phase(), margins.of_delay().above};
}

}  // namespace holdfast
