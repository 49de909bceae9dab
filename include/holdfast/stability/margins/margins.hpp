#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <utility>
#include <vector>

#include "holdfast/control/gains.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/core/interval.hpp"
#include "holdfast/math/poly/polynomial.hpp"
#include "holdfast/math/roots/bracketing_root.hpp"
#include "holdfast/math/roots/first_crossing.hpp"
#include "holdfast/plant/linear_plant.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "holdfast/stability/boundary/boundary_point.hpp"
#include "holdfast/stability/boundary/stable_intervals.hpp"
#include "holdfast/stability/margins/loop_form.hpp"
#include "holdfast/stability/margins/slow_sampling.hpp"
#include "holdfast/stability/polynomial/characteristic_polynomial.hpp"

namespace holdfast {

/// Whether a loop is stable; only a stable loop has margins.
enum class MarginOutcome {
  stable,      ///< all margins are defined
  not_stable,  ///< a root is on or outside the unit circle: every MarginEnd is `undefined`
};

/// Kind of an end of the stable interval of a quantity: gain D or P, period τ or delay δ.
enum class MarginEndOutcome {
  undefined,      ///< the loop is not stable: `position` and `distance` are NaN
  boundary,       ///< a root reaches the unit circle at `position`
  none,           ///< no boundary: stable up to `position`, the end of the quantity's whole range
  beyond_search,  ///< stable at least up to `position`, where the search ended: at its limit, after
                  ///< its last step, or where round-off hides whether a root crosses the circle
};

/// One end of the stable interval of a quantity (D, P, τ or δ) around its given value.
struct MarginEnd {
  MarginEndOutcome outcome = MarginEndOutcome::undefined;      ///< kind of the end
  double position = std::numeric_limits<double>::quiet_NaN();  ///< value of the quantity at the end
  /// The distance of `position` from the given value (unit of the quantity); ∞ for `none`.
  double distance = std::numeric_limits<double>::quiet_NaN();
  BoundaryCurve curve = BoundaryCurve::plus_one;  ///< kind of the root at a `boundary`
  /// Frequency |arg λ|/(2πτ) (Hz) of the crossing root λ at the boundary; NaN without a boundary.
  double frequency = std::numeric_limits<double>::quiet_NaN();
};

/// Lower and upper end of the stable interval of a quantity around its given value.
struct TwoSidedMargin {
  MarginEnd below;  ///< lower end
  MarginEnd above;  ///< upper end
};

/// Stability margins of a loop: the stable interval of each quantity if only this one changes.
struct StabilityMargins {
  MarginOutcome outcome;  ///< whether the loop with the given values is stable
  double unit_circle;     ///< 1 − ρ (ρ: spectral radius); ≤ 0 where the loop is not stable
  TwoSidedMargin differential_gain;  ///< margin of D (N s/m)
  TwoSidedMargin proportional_gain;  ///< margin of P (N/m)
  TwoSidedMargin sampling_period;    ///< margin of τ (s) within (0, ∞), with δ/τ constant
  TwoSidedMargin processing_delay;   ///< margin of δ (s) within [0, ∞), with τ constant
};

/// The limits of the search for margins.
struct MarginSearch {
  /// The ratio, > 1, of the longest sampling period searched to τ. If twenty periods of the plant's
  /// slowest mode are longer than this, the search extends to them. It ends earlier at a period
  /// beyond which stability is proved.
  double longest_period_ratio = 1000.0;
  /// The largest number of steps of the search along τ or δ, ≥ 1. In a step the phase of the
  /// plant's fastest mode grows by about 1 rad; for two masses a step takes some 40 µs.
  int most_steps = 20000;
  bool of_delay = true;  ///< whether δ is searched; if not, the margins of δ are `undefined`
};

namespace detail {

/// Longest range next to a boundary of τ or δ in which stability may be unproved, as a share of τ
/// or δ there. A boundary could be missed only in this range.
constexpr double smallest_step = 1e-6;
/// Range of the search for longer delays, in sampling periods beyond δ.
constexpr double most_delays = 10.0;

/// The end of a stable interval at which a root λ crosses the unit circle.
/// @param from_one  distance |λ − 1|
inline MarginEnd crossing_end(const std::complex<double>& root, double from_one, double position,
                              double value, double period) {
  const bool real = std::abs(root.imag()) <= 1e-6 * from_one;
  const BoundaryCurve curve = !real               ? BoundaryCurve::complex_pair
                              : root.real() < 0.0 ? BoundaryCurve::minus_one
                                                  : BoundaryCurve::plus_one;
  return {MarginEndOutcome::boundary, position, std::abs(position - value), curve,
          std::abs(std::arg(root)) / (2.0 * pi<double> * period)};
}

/// The end of a stable interval at which the root nearest to the unit circle crosses it.
template <class Loop>
MarginEnd boundary_end(const Loop& loop, const PdGains<double>& gains, double position,
                       double value) {
  std::complex<double> nearest(1.0);
  double smallest = std::numeric_limits<double>::infinity();
  for (const std::complex<double>& mu : roots_from_one(loop, gains)) {
    const double excess = std::abs(2.0 * mu.real() + std::norm(mu));  // ||λ|² − 1|
    if (!(excess < smallest)) continue;
    smallest = excess;
    nearest = mu;
  }
  return crossing_end(1.0 + nearest, std::abs(nearest), position, value, loop.sampling.period);
}

/// The end of a stable interval that has no stability boundary there.
inline MarginEnd no_boundary(double position) {
  return {MarginEndOutcome::none, position, std::numeric_limits<double>::infinity()};
}

inline MarginEnd beyond_search(double position, double value) {
  return {MarginEndOutcome::beyond_search, position, std::abs(position - value)};
}

/// Both ends of the interval that contains the value; `undefined` where no interval contains it.
/// @param boundary_at  map from a finite position to its MarginEnd
template <class BoundaryAt>
TwoSidedMargin margin_in(const std::vector<Interval<double>>& intervals, double value,
                         const BoundaryAt& boundary_at) {
  const auto end = [&](double position) {
    return std::isfinite(position) ? boundary_at(position) : no_boundary(position);
  };
  for (const Interval<double>& interval : intervals) {
    if (interval.contains(value)) return {end(interval.lower), end(interval.upper)};
  }
  return {};
}

/// The MarginEnd at the first loss of stability in a family of samplings between `value` and
/// `limit`, with constant gains. It is `otherwise` if stability is not lost.
/// @param first  length of the first step (s), > 0
template <class Family>
MarginEnd margin_along(const Family& family, const PdGains<double>& gains, double value,
                       double limit, double first, const MarginSearch& search,
                       const MarginEnd& otherwise) {
  const auto stable = [&](double centre, double radius) {
    return family.stability(gains, centre, radius);
  };
  const auto excess = [&](double position) { return loop_excess(family.loop_at(position), gains); };
  const auto edge = [&](double inside, double outside) {
    SignChange<double> ends{inside, outside, excess(inside), excess(outside)};
    if ((ends.value_at_lower < 0.0) == (ends.value_at_upper < 0.0)) return outside;  // round-off
    if (outside < inside) {
      std::swap(ends.lower, ends.upper);
      std::swap(ends.value_at_lower, ends.value_at_upper);
    }
    const auto crossing = bracketing_root(excess, ends, 0.0);
    return limit < value ? crossing.upper : crossing.lower;
  };
  const FirstCrossing walk =
      first_crossing(stable, edge, value, limit, first, {smallest_step, search.most_steps});
  if (walk.outcome == WalkOutcome::blocked) return {};
  if (walk.outcome == WalkOutcome::clear) return otherwise;
  if (walk.outcome == WalkOutcome::open) return beyond_search(walk.last_inside, value);
  return boundary_end(family.loop_at(walk.first_outside), gains, walk.first_outside, value);
}

template <class Plant>
TwoSidedMargin period_margin(const Plant& plant, const Sampling<double>& sampling,
                             const PdGains<double>& gains, const MarginSearch& search) {
  const double period = sampling.period, fraction = sampling.processing_delay / period;
  const double shortest = 1e-6 * period;
  const double longest =
      std::max(search.longest_period_ratio * period, 20.0 * slowest_mode_period(plant));
  // Part of the delay beyond whole samples, of which the bound on slow sampling is free.
  const double share = std::clamp(fraction - (held_commands({1.0, fraction}) - 1), 0.0, 1.0);
  const double certain = SlowSamplingBound(plant, gains, share).certain_from();
  const auto roots = continuous_roots(plant, gains);  // of τ → 0
  const bool decays =
      std::all_of(roots.begin(), roots.end(), [](const auto& root) { return root.real() < 0.0; });
  const MarginEnd no_shorter = decays ? no_boundary(0.0) : beyond_search(shortest, period);
  const MarginEnd no_longer = certain <= longest
                                  ? no_boundary(std::numeric_limits<double>::infinity())
                                  : beyond_search(longest, period);
  const auto family = SamplingFamily<Plant>::of_period(plant, fraction);
  const auto towards = [&](double limit, const MarginEnd& otherwise) {
    return margin_along(family, gains, period, limit, 0.05 * period, search, otherwise);
  };
  return {towards(shortest, no_shorter),
          towards(std::max(period, std::min(certain, longest)), no_longer)};
}

/// Both margins of δ, from one search in each range (k − 1) τ … k τ, where the number k of delayed
/// commands is constant. At δ = k τ a root appears or vanishes at λ = 0, and the other roots are
/// continuous. For zero gains a stable loop is stable for any delay.
template <class Plant>
TwoSidedMargin delay_margin(const Plant& plant, const Sampling<double>& sampling,
                            const PdGains<double>& gains, const MarginSearch& search) {
  const double period = sampling.period, delay = sampling.processing_delay;
  const int held = held_commands(sampling);
  const double longest = delay + most_delays * period;
  if (gains.proportional == 0.0 && gains.differential == 0.0)
    return {no_boundary(0.0), no_boundary(std::numeric_limits<double>::infinity())};
  const auto walk = [&](int direction) {
    double position = delay;
    for (int k = held; k >= 1; k += direction) {
      const double seam = (direction < 0 ? k - 1 : k) * period;
      const double limit = std::min(seam, longest);
      const auto family = SamplingFamily<Plant>::of_delay(plant, period, k);
      MarginEnd end =
          margin_along(family, gains, position, limit, 0.05 * period, search, no_boundary(limit));
      if (end.outcome == MarginEndOutcome::undefined && k != held)  // it crosses at the seam
        return boundary_end(family.loop_at(position), gains, position, delay);
      if (end.outcome != MarginEndOutcome::none) {
        end.distance = std::abs(end.position - delay);
        return end;
      }
      if (limit == longest) return beyond_search(longest, delay);
      position = limit;
    }
    return no_boundary(0.0);
  };
  return {walk(-1), walk(1)};
}

}  // namespace detail

/// Validates the limits. @throws InvalidParameter where a member is outside its stated range
inline void validate(const MarginSearch& search) {
  require_positive("longest period ratio minus one", search.longest_period_ratio - 1.0, "");
  require_positive("largest number of steps", search.most_steps, "");
}

/// The stability margins of D, P, τ and δ: how far each may change alone while the loop is stable.
///
/// The stable intervals of D and P are found from all crossings of the unit circle by roots
/// (`circle_crossings`). τ and δ are varied in steps from the given value. For each step it is
/// proved that all roots stay inside the circle (`MovingSpectrum`); no boundary is missed. Where
/// the proof fails, the boundary is a zero of ρ − 1 (ρ: spectral radius). For periods below 10⁻⁶ τ
/// the continuous loop is tested. `SlowSamplingBound` may prove stability for all long periods.
/// @tparam Plant    two masses, or a plant of any order with `Ports`
/// @param plant     plant within its ranges
/// @param sampling  τ (s) > 0; δ (s): 0 … τ for two masses, 0 … 1000 τ for a plant with ports
/// @param gains     P (N/m) and D (N s/m), finite
/// @param search    limits of the search along τ and δ
/// @throws InvalidParameter where plant, sampling, gains or search are outside their ranges
template <class Plant>
StabilityMargins stability_margins(const Plant& plant, const Sampling<double>& sampling,
                                   const PdGains<double>& gains, const MarginSearch& search = {}) {
  validate(plant);
  const auto loop = detail::loop_of(plant, sampling);
  validate(gains);
  validate(search);
  const double reserve = -detail::loop_excess(loop, gains);
  const auto& general = detail::with_ports(plant);
  const auto map = loop_map(general, sampling);
  const auto of_gain = [&](FreeGain free) {
    const double value = detail::gain_of(gains, free);
    return detail::margin_in(stable_gains(map, free, gains), value, [&](double position) {
      return detail::boundary_end(loop, detail::with_gain(gains, free, position), position, value);
    });
  };
  const TwoSidedMargin by_d = of_gain(FreeGain::differential);
  const TwoSidedMargin by_p = of_gain(FreeGain::proportional);
  const bool stable = reserve > 0.0 && by_d.below.outcome != MarginEndOutcome::undefined &&
                      by_p.below.outcome != MarginEndOutcome::undefined;
  if (!stable) return {MarginOutcome::not_stable, std::min(reserve, 0.0), {}, {}, {}, {}};
  return {
      MarginOutcome::stable,
      reserve,
      by_d,
      by_p,
      detail::period_margin(plant, sampling, gains, search),
      search.of_delay ? detail::delay_margin(general, sampling, gains, search) : TwoSidedMargin{}};
}

/// Margins of a loop as a whole: gain margin, phase margin and delay margin.
///
/// If both gains are multiplied by x, the characteristic polynomial is a(λ) + x b(λ). The given
/// loop has x = 1; its return ratio at the drive is L(λ) = −b/a, and its roots satisfy L(λ) = 1.
struct LoopMargins {
  MarginOutcome outcome;  ///< whether the loop is stable; if not, only `unit_circle` is not NaN
  double unit_circle;     ///< 1 − ρ, ρ: spectral radius; ≤ 0 where the loop is not stable
  double largest_factor =
      std::nan("");  ///< upper end of the stable interval of x around 1; ∞ if unbounded
  double least_factor =
      std::nan("");  ///< lower end of the stable interval of x around 1; −∞ if unbounded
  double phase =
      std::nan("");  ///< phase margin: least |φ| (rad) with e^{iφ} L(e^{iθ}) = 1 for a θ; ∞ if none
  MarginEnd delay = {};  ///< margin towards longer delays δ (s), with τ constant
};

namespace detail {

/// The phase margin (rad): the least |arg L| with |L| = 1 on the unit circle, L = −b/a. In the
/// variable w of `in_half_plane`, w = iy there, and |a|² − |b|² is a polynomial in Y = y².
template <class Scalar>
Scalar phase_margin(const Polynomial<Scalar, 5>& constant_part,
                    const Polynomial<Scalar, 5>& slope_part) {
  const Scalar unit = mean_root_modulus(constant_part);
  const Polynomial<Scalar, 5> a = rescaled(constant_part, unit), b = rescaled(slope_part, unit);
  const auto squared = [](const Polynomial<Scalar, 5>& p) {
    const auto even = parity_part(p, 0), odd = parity_part(p, 1);
    Polynomial<Scalar, 5> sum = Polynomial<Scalar, 5>::Zero();
    sum.template head<5>() += multiply<Scalar, 3, 3>(even, even);
    sum.template tail<5>() += multiply<Scalar, 3, 3>(odd, odd);
    return sum;
  };
  Scalar least = std::numeric_limits<Scalar>::infinity();
  // Where |L| touches 1 the root is a double one.
  for (const Scalar& y2 : positive_roots(Polynomial<Scalar, 5>(squared(a) - squared(b)), 1e-6)) {
    const std::complex<Scalar> w(Scalar(0), std::sqrt(y2));
    least = std::min(least, std::abs(std::arg(-evaluate(b, w) / evaluate(a, w))));
  }
  return least;
}

}  // namespace detail

/// The gain margin, the phase margin and the delay margin of the loop of two masses.
///
/// The gain margin is the stable interval of a common factor x of both gains (`stable_intervals`).
/// The phase margin is found at all angles θ with |L(e^{iθ})| = 1, from the roots of one polynomial
/// (L: return ratio). The delay margin is searched up to ten samples beyond δ.
/// @tparam Plant    two masses
/// @param plant     plant within its ranges
/// @param sampling  τ (s) > 0, δ (s) 0 … τ
/// @param gains     P (N/m) and D (N s/m), finite
/// @param search    limits of the search along δ
/// @throws InvalidParameter where plant, sampling, gains or search are outside their ranges
template <class Plant>
LoopMargins loop_margins(const Plant& plant, const Sampling<double>& sampling,
                         const PdGains<double>& gains, const MarginSearch& search = {}) {
  static_assert(has_closed_forms<Plant>, "loop_margins() needs a plant of two masses");
  validate(plant);
  validate(gains);
  validate(search);
  const auto loop = detail::loop_of(plant, sampling);
  const double reserve = -detail::loop_excess(loop, gains);
  const auto polynomial = in_half_plane(characteristic_polynomial(loop));
  const Polynomial<double, 5> slope =
      gains.proportional * polynomial.proportional + gains.differential * polynomial.differential;
  LoopMargins margins{MarginOutcome::not_stable, reserve};
  for (const Interval<double>& factors : stable_intervals(polynomial.base, slope)) {
    if (!(reserve > 0.0) || !factors.contains(1.0)) continue;
    margins = {MarginOutcome::stable,
               reserve,
               factors.upper,
               factors.lower,
               detail::phase_margin(polynomial.base, slope),
               detail::delay_margin(linear_plant(plant), sampling, gains, search).above};
  }
  return margins;
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template StabilityMargins stability_margins(const TwoMass<double>&, const Sampling<double>&,
                                                   const PdGains<double>&, const MarginSearch&);
extern template StabilityMargins stability_margins(const LinearPlant<double>&,
                                                   const Sampling<double>&, const PdGains<double>&,
                                                   const MarginSearch&);
extern template LoopMargins loop_margins(const TwoMass<double>&, const Sampling<double>&,
                                         const PdGains<double>&, const MarginSearch&);
#endif

}  // namespace holdfast
