#pragma once

#include "holdfast/control/gains.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/math/poly/polynomial.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "holdfast/stability/polynomial/characteristic_polynomial.hpp"
#include "support/random.hpp"

namespace holdfast::test {

/// A plant over decades: masses 0.01 … 10 kg, frequencies of the two parts alone 0.5 … 50 Hz,
/// damping ratios 0 … 50 %.
inline TwoMass<double> random_plant(Random& random) {
  const auto part = [&random](double mass) {
    const double omega = 6.283185307179586 * random.log_uniform(0.5, 50.0);
    return std::pair{mass * omega * omega, 2.0 * random.uniform(0.0, 0.5) * mass * omega};
  };
  const double m1 = random.log_uniform(0.01, 10.0), m2 = random.log_uniform(0.01, 10.0);
  const auto [k1, c1] = part(m1);
  const auto [k2, c2] = part(m2);
  return {m1, k1, c1, m2, k2, c2};
}

/// Sampling between 1/500 of the period of one of the plant's parts and all of it, within 0.2 … 200
/// ms; δ is 0, τ or between them, a third each.
inline Sampling<double> random_sampling(const TwoMass<double>& plant, Random& random) {
  const double first =
      6.283185307179586 * std::sqrt(plant.conductor_mass / plant.conductor_stiffness);
  const double second =
      6.283185307179586 * std::sqrt(plant.absorber_mass / plant.absorber_stiffness);
  const double natural_period = random.unit() < 0.5 ? first : second;
  const double period =
      std::clamp(natural_period * random.log_uniform(1.0 / 500.0, 1.0), 2e-4, 0.2);
  const double fractions[] = {0.0, random.unit(), 1.0};
  return {period, fractions[random.index(3)] * period};
}

/// Gains of the size at which sampling begins to matter, D ~ m/τ and P ~ m/τ² of the reduced mass,
/// and down to a thousandth of them.
inline PdGains<double> random_gains(const TwoMass<double>& plant, double period, Random& random) {
  const double mass =
      plant.conductor_mass * plant.absorber_mass / (plant.conductor_mass + plant.absorber_mass);
  return {random.sign() * random.log_uniform(1e-4, 1.0) * mass / (period * period),
          (random.unit() < 0.8 ? -1.0 : 1.0) * random.log_uniform(1e-3, 2.0) * mass / period};
}

/// The loop of those very doubles, in extended precision.
inline SampledLoop<long double> precise_loop(const TwoMass<double>& plant,
                                             const Sampling<double>& sampling) {
  return sampled_loop(converted<long double>(plant),
                      Sampling<long double>{sampling.period, sampling.processing_delay});
}

/// How far the loop's dominant root lies outside the unit circle, in extended precision.
struct Growth {
  double excess;    ///< max |λ| − 1
  double crowding;  ///< min |λ − 1|: small where sampling is fast beside the slowest root
};

inline Growth growth(const TwoMass<double>& plant, const Sampling<double>& sampling,
                     const PdGains<double>& gains) {
  using Precise = long double;
  const auto polynomial = characteristic_polynomial(precise_loop(plant, sampling))
                              .at(PdGains<Precise>{gains.proportional, gains.differential});
  Precise largest = -1, nearest = 2;
  for (const auto& mu : roots(polynomial)) {
    const Precise square = 2 * mu.real() + std::norm(mu);  // |1 + μ|² − 1 without cancellation
    largest = std::max(largest, square / (1 + std::sqrt(std::max(Precise(0), 1 + square))));
    nearest = std::min(nearest, std::abs(mu));
  }
  return {static_cast<double>(largest), static_cast<double>(nearest)};
}

}  // namespace holdfast::test
