#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <vector>

#include "holdfast/control/gains.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/math/linalg/elimination.hpp"
#include "holdfast/math/linalg/resolvent.hpp"
#include "holdfast/math/linalg/spectral_radius.hpp"
#include "holdfast/math/poly/polynomial.hpp"
#include "holdfast/plant/ports.hpp"

namespace holdfast {

/// Upper bound of |L(λ)|, the modulus of the loop's return ratio, for all |λ| ≥ 1. It decreases as
/// τ grows. The sampled loop is stable at every period τ for which the bound is below 1.
///
/// Let n(s)/p(s) = K (sI − A)⁻¹ b for plant matrix A, control input b and feedback row K. The plant
/// has the poles s_i = −a_i + iω_i. With A_d, Γ₀ and Γ₁ of `SampledLoop`, c_i = n(s_i)/(s_i
/// p′(s_i)), g = K A⁻¹ b = −n(0)/p(0) = Σ c_i, φ = δ/τ and e_i = e^{s_i τ}, the return ratio is
///
///     L(λ) = K (λI − A_d)⁻¹ (Γ₀ + Γ₁/λ)
///          = −g/λ + Σ c_i e^{s_i(1−φ)τ} (λ − 1)/(λ(λ − e_i))
///
/// The loop with the map S is stable if |L| < 1 for |λ| ≥ 1, as the roots λ of det(λI − S) = λ
/// det(λI − A_d) (1 − L) then have |λ| < 1. The bound is
///
///     |L| ≤ |g| + 2 Σ |c_i| e^{−a_i χτ}/(1 − e^{−a_iτ}),   χ = 1 − φ if φ < 1, χ = 1 if φ = 1
///
/// At φ = 1, L = −g/λ² + Σ c_i e_i (λ − 1)/(λ²(λ − e_i)), hence χ = 1. For the two-mass plant
/// g = 0: a constant force between the masses does not move the conductor. A delay by further whole
/// samples divides L by powers of λ; the bound remains valid.
class SlowSamplingBound {
 public:
  /// @tparam Plant          plant of any order; for (nearly) multiple poles the bound is infinite
  /// @param plant           plant within its ranges, which are not checked here
  /// @param gains           P (N/m) and D (N s/m), finite
  /// @param delay_fraction  ratio φ = δ/τ, 0 … 1, constant while τ varies
  template <class Plant>
  SlowSamplingBound(const Plant& plant, const PdGains<double>& gains, double delay_fraction)
      : delay_fraction_(delay_fraction) {
    if constexpr (has_closed_forms<Plant>) {
      take_poles_of_two_masses(plant, gains);
    } else {
      take_poles(plant, gains);
    }
  }

  /// The bound on |L| at a sampling period τ (s) > 0; ∞ if an undamped mode takes part in L.
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

  /// A period (s) at and beyond which the bound is below 1 and the loop is stable; ∞ if none found.
  double certain_from() const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const auto [slowest, fastest] = std::minmax_element(decay_.begin(), decay_.end());
    if (!(*slowest > 0.0)) return infinity;
    double period = 1.0 / *fastest;
    while (std::isfinite(period) && !(at(period) < 1.0)) period *= 2.0;
    return std::isfinite(period) ? period : infinity;
  }

 private:
  template <class Plant>
  void take_poles_of_two_masses(const Plant& plant, const PdGains<double>& gains) {
    const auto plain = resolvent(plant.state_matrix());
    const auto numerator = plain.between(gains.feedback_row(), plant.control_input());
    const auto slope = derivative(plain.determinant);
    for (const std::complex<double>& pole : roots(plain.determinant)) {
      decay_.push_back(decay_of(pole));
      weight_.push_back(std::abs(evaluate(numerator, pole) / (pole * evaluate(slope, pole))));
    }
    static_gain_ = std::abs(numerator[0] / plain.determinant[0]);
  }

  template <class Plant>
  void take_poles(const Plant& plant, const PdGains<double>& gains) {
    using Square = Matrix<double, Eigen::Dynamic>;
    const Square a = plant.state_matrix();
    const Vector<double, Eigen::Dynamic> b = plant.control_input();
    const RowVector<double, Eigen::Dynamic> feedback =
        ports_of(plant).feedback_row(gains.proportional, gains.differential);
    const auto poles = detail::balanced_eigenvalues<double, Eigen::Dynamic>(a);
    for (Eigen::Index i = 0; i < poles.size(); ++i) {
      decay_.push_back(decay_of(poles[i]));
      // The residue of K (sI − A)⁻¹ b is the derivative of the pole of A + ε b K by ε.
      weight_.push_back(
          std::abs(eigenvalue_derivative<double>(a, Square(b * feedback), poles[i]) / poles[i]));
      for (Eigen::Index k = 0; k < i; ++k) {
        // The residues of poles so close together are inaccurate.
        if (std::abs(poles[i] - poles[k]) < 1e-3 * std::abs(poles[i])) decay_.back() = 0.0;
      }
    }
    static_gain_ = std::abs(feedback.dot(eliminated(a, b)));
  }

  /// The decay rate −Re s of a pole s; 0 where the pole is undamped up to round-off, or unstable.
  static double decay_of(const std::complex<double>& pole) {
    return -pole.real() > 1e-12 * std::abs(pole) ? -pole.real() : 0.0;
  }

  double delay_fraction_;
  double static_gain_ = 0.0;    // |g|
  std::vector<double> decay_;   // a_i
  std::vector<double> weight_;  // |c_i|
};

}  // namespace holdfast
