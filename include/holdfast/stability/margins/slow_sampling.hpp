#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <vector>

#include "holdfast/control/gains.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/math/linalg/resolvent.hpp"
#include "holdfast/math/poly/polynomial.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast {

/// A bound on the loop's gain that falls as the sampling period grows, and so tells from which
/// period on the sampled loop is stable however slow the sampling.
///
/// With the plant's poles s_i = −a_i + iω_i, K (sI − A)⁻¹ b = n(s)/p(s), c_i = n(s_i)/(s_i
/// p′(s_i)), g = K A⁻¹ b = −n(0)/p(0) = Σ c_i, φ = δ/τ and e_i = e^{s_i τ}, the loop's return ratio
/// is
///
///     L(λ) = K (λI − A_d)⁻¹ (Γ₀ + Γ₁/λ)
///          = −g/λ + Σ c_i e^{s_i(1−φ)τ} (λ − 1)/(λ(λ − e_i))
///
/// and det(λI − S) = λ det(λI − A_d) (1 − L), so that all |λ| < 1 if |L| < 1 on |λ| ≥ 1. There
///
///     |L| ≤ |g| + 2 Σ |c_i| e^{−a_i χτ}/(1 − e^{−a_iτ}),   χ = 1 − φ, and χ = 1 for φ = 1
///
/// the latter from L = −g/λ² + Σ c_i e_i (λ − 1)/(λ²(λ − e_i)). For the two-mass plant g = 0: a
/// constant force between the masses does not move the conductor.
class SlowSamplingBound {
 public:
  /// @tparam Plant          anything with `state_matrix()` and `control_input()`
  /// @param plant           within its ranges, which are not checked here
  /// @param gains           P (N/m) and D (N s/m), finite
  /// @param delay_fraction  φ, 0 … 1, kept while τ varies
  template <class Plant>
  SlowSamplingBound(const Plant& plant, const PdGains<double>& gains, double delay_fraction);

  /// The bound on |L| over |λ| ≥ 1 at a sampling period (s), > 0; infinite for an undamped mode.
  double at(double period) const {
    const double share = delay_fraction_ == 1.0 ? 1.0 : 1.0 - delay_fraction_;
    double bound = static_gain_;
    for (std::size_t i = 0; i < weight_.size(); ++i) {
      if (weight_[i] == 0.0) continue;
      if (decay_[i] == 0.0) return std::numeric_limits<double>::infinity();
      bound += 2.0 * weight_[i] * std::exp(-decay_[i] * share * period) /
               -std::expm1(-decay_[i] * period);
    }
    return bound;
  }

  /// A period (s) from which on every longer one is stable; infinite where the bound shows none.
  double certain_from() const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const auto [slowest, fastest] = std::minmax_element(decay_.begin(), decay_.end());
    if (!(*slowest > 0.0)) return infinity;
    double period = 1.0 / *fastest;
    while (std::isfinite(period) && !(at(period) < 1.0)) period *= 2.0;
    return std::isfinite(period) ? period : infinity;
  }

 private:
  double delay_fraction_;
  double static_gain_ = 0.0;    // |g|
  std::vector<double> decay_;   // a_i
  std::vector<double> weight_;  // |c_i|
};

template <class Plant>
SlowSamplingBound::SlowSamplingBound(const Plant& plant, const PdGains<double>& gains,
                                     double delay_fraction)
    : delay_fraction_(delay_fraction) {
  const auto plain = resolvent(plant.state_matrix());
  const auto numerator = plain.between(gains.feedback_row(), plant.control_input());
  const auto slope = derivative(plain.determinant);
  for (const std::complex<double>& pole : roots(plain.determinant)) {
    const double decay = -pole.real();
    decay_.push_back(decay > 1e-12 * std::abs(pole) ? decay
                                                    : 0.0);  // or undamped but for round-off
    weight_.push_back(std::abs(evaluate(numerator, pole) / (pole * evaluate(slope, pole))));
  }
  static_gain_ = std::abs(numerator[0] / plain.determinant[0]);
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template SlowSamplingBound::SlowSamplingBound(const TwoDof<double>&, const PdGains<double>&,
                                                     double);
#endif

}  // namespace holdfast
