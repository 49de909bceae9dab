#pragma once

#include "holdfast/control/gains.hpp"
#include "holdfast/control/loop_map.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/math/roots/first_crossing.hpp"
#include "holdfast/plant/linear_plant.hpp"
#include "holdfast/plant/ports.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "holdfast/stability/margins/tracked_roots.hpp"
#include "holdfast/stability/polynomial/loop_derivatives.hpp"

namespace holdfast {

/// A line through the samplings of one plant, along which a single number varies: the period τ, the
/// delay keeping its share of it, or the delay δ at a fixed period, as long as the number of
/// commands on their way stays.
/// @tparam Plant  two masses, whose loop is a `SampledLoop` in closed form, or a plant of any order
///                with ports, whose loop is a `LoopMap`
template <class Plant>
class SamplingFamily {
 public:
  /// τ varies, δ = delay_fraction · τ.
  /// @param plant           within its ranges, which are not checked here
  /// @param delay_fraction  0 … 1; ≥ 0 of a plant with ports
  static SamplingFamily of_period(const Plant& plant, double delay_fraction) {
    return {plant, 0.0, delay_fraction, holdfast::held_commands({1.0, delay_fraction})};
  }

  /// δ varies from (k − 1) τ to k τ.
  /// @param plant   within its ranges, which are not checked here
  /// @param period  τ (s), > 0
  /// @param held    k, 1 of the two masses, ≥ 1 of a plant with ports
  static SamplingFamily of_delay(const Plant& plant, double period, int held = 1) {
    return {plant, period, 0.0, held};
  }

  /// The sampling at a position (s): τ, or δ at the fixed period.
  Sampling<double> at(double position) const {
    if (fixed_period_ > 0.0) return {fixed_period_, position};
    return {position, delay_fraction_ * position};
  }

  /// The plant under the sampling at a position (s); costs two matrix exponentials.
  auto loop_at(double position) const {
    if constexpr (has_closed_forms<Plant>) {
      return sampled_loop(plant_, at(position));
    } else {
      return detail::loop_map_keeping<Plant, double>(plant_, at(position), held_);
    }
  }

  /// How the loop's matrices move along the path, per second of it.
  LoopDerivative rate(const SampledLoop<double>& loop) const {
    const LoopDerivative by_delay = derivative_by_delay(plant_, loop);
    if (fixed_period_ > 0.0) return by_delay;
    return derivative_by_period(plant_, loop).plus(by_delay, delay_fraction_);
  }
  /// The same of a loop's map.
  LoopMapDerivative<double> rate(const LoopMap<double>& map) const {
    return varies_period() ? loop_map_derivative(plant_, map, 1.0, delay_fraction_)
                           : loop_map_derivative(plant_, map, 0.0, 1.0);
  }

  /// The loop's roots λ and how they move along the path, and 1 − Π(1 + λ_i), which leaves the
  /// inside where a real root passes −1. Stable ⇔ all inside the unit circle.
  /// @param loop  of `loop_at`
  /// @param gains  P and D
  template <class Loop>
  TrackedPointSets tracked_at(const Loop& loop, const PdGains<double>& gains) const {
    return detail::tracked_roots(loop, rate(loop), gains, varies_period());
  }

  /// True on a path of τ, false on one of δ.
  bool varies_period() const { return !(fixed_period_ > 0.0); }

 private:
  SamplingFamily(const Plant& plant, double fixed_period, double delay_fraction, int held)
      : plant_(plant), fixed_period_(fixed_period), delay_fraction_(delay_fraction), held_(held) {}

  Plant plant_;
  double fixed_period_;  // 0 where the period varies
  double delay_fraction_;
  int held_;
};

}  // namespace holdfast
