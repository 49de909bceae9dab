#pragma once

#include <array>
#include <cmath>
#include <complex>

#include "holdfast/control/gains.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/math/roots/first_crossing.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "holdfast/stability/margins/moving_root.hpp"
#include "holdfast/stability/polynomial/characteristic_polynomial.hpp"
#include "holdfast/stability/polynomial/loop_derivatives.hpp"
#include "holdfast/stability/polynomial/root_sensitivity.hpp"

namespace holdfast {

/// A line through the samplings of one plant, along which a single number varies: the period τ, the
/// delay keeping its share of it, or the delay δ at a fixed period.
/// @tparam Plant  anything with `state_matrix()`, `control_input()` and `excitation_input()`
template <class Plant>
class SamplingFamily {
 public:
  /// τ varies, δ = delay_fraction · τ.
  /// @param plant           within its ranges, which are not checked here
  /// @param delay_fraction  0 … 1
  static SamplingFamily of_period(const Plant& plant, double delay_fraction) {
    return {plant, 0.0, delay_fraction};
  }

  /// δ varies from 0 to τ.
  /// @param plant   within its ranges, which are not checked here
  /// @param period  τ (s), > 0
  static SamplingFamily of_delay(const Plant& plant, double period) { return {plant, period, 0.0}; }

  /// The sampling at a position (s): τ, or δ at the fixed period.
  Sampling<double> at(double position) const {
    if (fixed_period_ > 0.0) return {fixed_period_, position};
    return {position, delay_fraction_ * position};
  }

  /// The plant under the sampling at a position (s); costs two matrix exponentials.
  SampledLoop<double> loop_at(double position) const { return sampled_loop(plant_, at(position)); }

  /// How the loop's matrices move along the path, per second of it.
  LoopDerivative rate(const SampledLoop<double>& loop) const;

  /// The loop's roots λ and how they move along the path, on spirals (`moving_loop_root`) where τ
  /// varies. Stable ⇔ all inside the unit circle.
  TrackedPoints roots_at(const SampledLoop<double>& loop, const PdGains<double>& gains) const;

  /// The roots, and beside them what vanishes where a real root passes −1: Π (1 + λ_i) = −p(−1).
  ///
  /// A pair that meets on the real axis near −1, sends one root through −1 and takes it back leaves
  /// no trace in the roots' speeds before and after; that product is smooth all the way. It is
  /// watched as the point 1 − Π, which lies inside as long as the product is positive.
  TrackedPointSets tracked_at(const SampledLoop<double>& loop, const PdGains<double>& gains) const;

  /// True on a path of τ, false on one of δ.
  bool varies_period() const { return !(fixed_period_ > 0.0); }

 private:
  SamplingFamily(const Plant& plant, double fixed_period, double delay_fraction)
      : plant_(plant), fixed_period_(fixed_period), delay_fraction_(delay_fraction) {}

  Plant plant_;
  double fixed_period_;  // 0 where the period varies
  double delay_fraction_;
};

template <class Plant>
LoopDerivative SamplingFamily<Plant>::rate(const SampledLoop<double>& loop) const {
  const LoopDerivative by_delay = derivative_by_delay(plant_, loop);
  if (fixed_period_ > 0.0) return by_delay;
  return derivative_by_period(plant_, loop).plus(by_delay, delay_fraction_);
}

template <class Plant>
TrackedPoints SamplingFamily<Plant>::roots_at(const SampledLoop<double>& loop,
                                              const PdGains<double>& gains) const {
  const auto polynomial = characteristic_polynomial(dual_loop<1>(loop, {rate(loop)}));
  TrackedPoints result;
  for (const RootSensitivity<1>& root : root_sensitivities<1>(polynomial, gains)) {
    result.push_back(detail::moving_loop_root(root.value(), root.rates[0], root.logarithm(),
                                              root.excess(), varies_period(),
                                              loop.sampling.period));
  }
  return result;
}

template <class Plant>
TrackedPointSets SamplingFamily<Plant>::tracked_at(const SampledLoop<double>& loop,
                                                   const PdGains<double>& gains) const {
  const auto polynomial =
      characteristic_polynomial(dual_loop<1>(loop, {rate(loop)}))
          .at({DualNumber<1>(gains.proportional), DualNumber<1>(gains.differential)});
  const double product = -evaluate(values_of<1, 5>(polynomial), -2.0);
  const double slope = -evaluate(derivative_of<1, 5>(polynomial, 0), -2.0);
  return {roots_at(loop, gains), {TrackedPoint{1.0 - product, -slope, 0.0, false, -product}}};
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template class SamplingFamily<TwoMass<double>>;
#endif

}  // namespace holdfast
