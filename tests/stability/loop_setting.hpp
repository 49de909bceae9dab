#pragma once

#include "holdfast/control/gains.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "holdfast/stability/chart/loop_chart.hpp"
#include "holdfast/stability/sensitivity/sensitivity.hpp"
#include "support/testing.hpp"

namespace holdfast {

/// A loop to be moved one parameter at a time.
using LoopSetting = OperatingPoint;

/// Central differences of fourth order of `quantity(LoopSetting)` by one parameter.
/// @param relative_step  a share of the parameter
template <class Quantity>
double difference_quotient(const Quantity& quantity, const LoopSetting& setting,
                           LoopParameter parameter, double relative_step) {
  LoopSetting at = setting;
  const double value = value_of(at, parameter);
  const double step = relative_step * (value == 0.0 ? 1.0 : std::abs(value));
  const auto moved = [&](double steps) {
    value_of(at, parameter) = value + steps * step;
    return quantity(at);
  };
  return (8.0 * (moved(1) - moved(-1)) - (moved(2) - moved(-2))) / (12.0 * step);
}

/// Compares every entry but the delay at its end δ = 0 or τ, from which it can only move inwards.
/// @param scale  of the quantity, for entries that are zero
template <class Quantity>
void expect_sensitivity(const LoopSensitivity& sensitivity, const Quantity& quantity,
                        const LoopSetting& setting, double scale, double tolerance = 1e-6,
                        double relative_step = 2e-4) {
  LoopSetting at = setting;
  const double delay = setting.sampling.processing_delay;
  const bool delay_at_end = delay == 0.0 || delay == setting.sampling.period;
  for (int entry = 0; entry < loop_parameters; ++entry) {
    if (delay_at_end && (entry == 7 || (entry == 6 && delay > 0.0))) continue;
    const auto parameter = static_cast<LoopParameter>(entry);
    const double expected = difference_quotient(quantity, setting, parameter, relative_step);
    const double unit = scale / std::max(std::abs(value_of(at, parameter)), 1e-3);
    EXPECT_NEAR(sensitivity[parameter], expected, tolerance * std::max(std::abs(expected), unit))
        << "entry " << entry << ", period " << setting.sampling.period;
  }
}

}  // namespace holdfast
