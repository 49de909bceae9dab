#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "holdfast/control/gains.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "holdfast/stability/sensitivity/sensitivity.hpp"

namespace holdfast {

/// Everything a sampled loop is made of, to be moved one parameter at a time.
struct LoopSetting {
  TwoMass<double> plant = kollar2022_plant();
  Sampling<double> sampling;
  PdGains<double> gains;

  /// The parameter of that entry of `LoopSensitivity`.
  double& parameter(int entry) {
    double* const all[] = {&plant.conductor_mass,     &plant.conductor_stiffness,
                           &plant.conductor_damping,  &plant.absorber_mass,
                           &plant.absorber_stiffness, &plant.absorber_damping,
                           &sampling.period,          &sampling.processing_delay,
                           &gains.proportional,       &gains.differential};
    return *all[entry];
  }
};

/// Central differences of fourth order of `quantity(LoopSetting)` by one parameter.
/// @param relative_step  a share of the parameter
template <class Quantity>
double difference_quotient(const Quantity& quantity, const LoopSetting& setting, int entry,
                           double relative_step) {
  LoopSetting at = setting;
  const double value = at.parameter(entry);
  const double step = relative_step * (value == 0.0 ? 1.0 : std::abs(value));
  const auto moved = [&](double steps) {
    at.parameter(entry) = value + steps * step;
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
  const Vector<double, loop_parameters> entries = entries_of(sensitivity);
  LoopSetting at = setting;
  const double delay = setting.sampling.processing_delay;
  const bool delay_at_end = delay == 0.0 || delay == setting.sampling.period;
  for (int entry = 0; entry < loop_parameters; ++entry) {
    if (delay_at_end && (entry == 7 || (entry == 6 && delay > 0.0))) continue;
    const double expected = difference_quotient(quantity, setting, entry, relative_step);
    const double unit = scale / std::max(std::abs(at.parameter(entry)), 1e-3);
    EXPECT_NEAR(entries[entry], expected, tolerance * std::max(std::abs(expected), unit))
        << "entry " << entry << ", period " << setting.sampling.period;
  }
}

}  // namespace holdfast
