#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <optional>
#include <vector>

#include "holdfast/control/gains.hpp"
#include "holdfast/math/poly/polynomial.hpp"
#include "holdfast/stability/design/minimum_radius.hpp"
#include "holdfast/stability/polynomial/loop_derivatives.hpp"
#include "holdfast/stability/sensitivity/sensitivity.hpp"

namespace holdfast {

/// What holds the minimum spectral radius where it is.
enum class MinimumRadiusKind {
  balanced,     ///< two roots of equal modulus, of which D moves one in and the other out
  double_root,  ///< a double real root that D parts
  smooth,       ///< one root, or pair, whose modulus is stationary in D
  fixed,        ///< none of these: a root that D does not move, or gains that are not those of the
                ///< minimum radius; D has no sensitivity (NaN)
};

/// How the minimum radius over D and its D answer to the loop.
struct MinimumRadiusSensitivity {
  MinimumRadiusKind kind;             ///< what is active at the minimum
  LoopSensitivity radius;             ///< of min ρ over D; of `fixed`, of ρ at the held D
  LoopSensitivity differential_gain;  ///< of the D (N s/m) that has it; of `fixed` NaN
};

namespace detail {

/// Which roots are active at the D of minimum radius, and the two equations that they give.
class ActiveRoots {
 public:
  ActiveRoots(const DualPolynomial& loop, const PdGains<double>& gains)
      : polynomial_(loop), gains_(gains) {
    // One of each pair, and both of a double real root, which round-off parts by its square root.
    for (const auto& root : root_sensitivities<loop_parameters>(loop.at(gains), loop.centre)) {
      if (root.offset.imag() >= -1e-6 * std::abs(root.offset)) roots_.push_back(root);
    }
    std::sort(roots_.begin(), roots_.end(),
              [](const auto& a, const auto& b) { return a.radius_offset() > b.radius_offset(); });
  }

  MinimumRadiusSensitivity sensitivity() const {
    const double size = std::abs(roots_.front().offset);
    if (const auto result = of_double_root(1e-3 * size)) return *result;
    if (const auto result = of_balanced_roots(1e-6 * size)) return *result;
    if (const auto result = of_smooth_minimum(1e-6 * size / modulus())) return *result;
    return of_fixed();
  }

 private:
  double modulus() const { return std::abs(roots_.front().value()); }

  MinimumRadiusSensitivity answer(MinimumRadiusKind kind, Entries logarithm, Entries gain) const {
    logarithm[by_d] = gain[by_d] = 0.0;
    return {kind, {logarithm * modulus()}, {gain}};
  }

  /// ln|λ₁| = ln|λ₂| gives ∂D, and with it either gives the radius.
  std::optional<MinimumRadiusSensitivity> of_balanced_roots(double closeness) const {
    const Entries first = roots_.front().logarithmic_rates();
    for (std::size_t k = 1; k < roots_.size(); ++k) {
      const Entries other = roots_[k].logarithmic_rates();
      if (roots_.front().radius_offset() - roots_[k].radius_offset() > closeness) break;
      if (!(first[by_d] * other[by_d] < 0.0)) continue;
      const Entries gain = implicit_derivative(first - other, by_d);
      return answer(MinimumRadiusKind::balanced, first + first[by_d] * gain, gain);
    }
    return std::nullopt;
  }

  /// p = 0 and ∂p/∂λ = 0, two real equations for λ and D, solved by Newton's method and then
  /// differentiated.
  std::optional<MinimumRadiusSensitivity> of_double_root(double closeness) const {
    double mu = 0.0;
    if (!near_double_root(closeness, mu)) return std::nullopt;
    PdGains<double> gains = gains_;
    for (int step = 0; step < 6; ++step) {
      const Vector<double, 2> change =
          -double_root_matrix(gains, mu).inverse() * double_root_residual(values_at(gains), mu);
      mu += change[0];
      gains.differential += change[1];
    }
    if (!(std::abs(gains.differential - gains_.differential) <= 1e-4 * natural_gain(gains, mu)))
      return std::nullopt;
    const Matrix<double, 2> inverse = double_root_matrix(gains, mu).inverse();
    const auto p = polynomial_.at(gains);
    Entries logarithm, gain;
    for (int i = 0; i < by_d; ++i) {
      const Vector<double, 2> change = -inverse * double_root_residual(derivative_of(p, i), mu);
      logarithm[i] = change[0] / (polynomial_.centre + mu);
      gain[i] = change[1];
    }
    return answer(MinimumRadiusKind::double_root, logarithm, gain);
  }

  /// The middle of two real roots, or of a pair about to become real, at the largest modulus.
  bool near_double_root(double closeness, double& mu) const {
    const LoopRoot& lead = roots_.front();
    mu = lead.offset.real();
    if (lead.offset.imag() != 0.0) return lead.offset.imag() < closeness;
    for (std::size_t k = 1; k < roots_.size(); ++k) {
      if (std::abs(roots_[k].offset - lead.offset) > closeness) continue;
      mu = 0.5 * (mu + roots_[k].offset.real());
      return true;
    }
    return false;
  }

  /// |D|, or the change of D that parts a double root by its own size, whichever is larger.
  double natural_gain(const PdGains<double>& gains, double mu) const {
    const auto curvature = derivative<double, 5>(derivative<double, 6>(values_at(gains)));
    const auto slope = values_of(polynomial_.affine.differential);
    return std::max(std::abs(gains.differential),
                    std::abs(0.5 * evaluate(curvature, mu) * mu * mu / evaluate(slope, mu)));
  }

  Polynomial<double, 5> values_at(const PdGains<double>& gains) const {
    return values_of(polynomial_.at(gains));
  }

  static Vector<double, 2> double_root_residual(const Polynomial<double, 5>& p, double mu) {
    return {evaluate(p, mu), evaluate(derivative<double, 6>(p), mu)};
  }

  Matrix<double, 2> double_root_matrix(const PdGains<double>& gains, double mu) const {
    const Polynomial<double, 4> slope = derivative<double, 6>(values_at(gains));
    const Polynomial<double, 5> d = values_of(polynomial_.affine.differential);
    Matrix<double, 2> matrix;
    matrix << evaluate(slope, mu), evaluate(d, mu), evaluate(derivative<double, 5>(slope), mu),
        evaluate(derivative<double, 6>(d), mu);
    return matrix;
  }

  /// ∂ ln|λ|/∂D = 0, differentiated: ∂D/∂x = −∂²ln|λ|/∂D∂x / ∂²ln|λ|/∂D², with
  ///
  ///     p_λ λ_Dx = −(p_λλ λ_D λ_x + p_λD λ_x + p_λx λ_D + p_Dx)
  ///
  /// @param shortfall  by how much ln|λ| may exceed that of the minimum nearby
  std::optional<MinimumRadiusSensitivity> of_smooth_minimum(double shortfall) const {
    using Complex = std::complex<double>;
    const LoopRoot& root = roots_.front();
    const Complex mu = root.offset, lambda = root.value(), lambda_d = root.rates[by_d];
    const auto p = polynomial_.at(gains_);
    const Polynomial<double, 4> slope = derivative<double, 6>(values_of(p));
    const Complex p_l = evaluate(slope, mu), p_ll = evaluate(derivative<double, 5>(slope), mu);
    const auto& dual_d = polynomial_.affine.differential;
    const Complex p_ld = evaluate(derivative<double, 6>(values_of(dual_d)), mu);
    const auto mixed = [&](const Complex& by_x, const Complex& p_lx, const Complex& p_dx) {
      const Complex second = -(p_ll * lambda_d * by_x + p_ld * by_x + p_lx * lambda_d + p_dx) / p_l;
      return (second / lambda - lambda_d * by_x / (lambda * lambda)).real();
    };
    const double slope_by_d = root.logarithmic_rates()[by_d],
                 curvature = mixed(lambda_d, p_ld, 0.0);
    if (!(curvature > 0.0) || slope_by_d * slope_by_d > 2.0 * shortfall * curvature)
      return std::nullopt;
    Entries gain;
    for (int i = 0; i < by_d; ++i) {
      const Complex p_lx = evaluate(derivative<double, 6>(derivative_of(p, i)), mu);
      const Complex p_dx = evaluate(derivative_of(dual_d, i), mu);
      gain[i] = -mixed(root.rates[i], p_lx, p_dx) / curvature;
    }
    return answer(MinimumRadiusKind::smooth, root.logarithmic_rates(), gain);
  }

  MinimumRadiusSensitivity of_fixed() const {
    const Entries none = Entries::Constant(std::numeric_limits<double>::quiet_NaN());
    return {MinimumRadiusKind::fixed,
            answer(MinimumRadiusKind::fixed, roots_.front().logarithmic_rates(), none).radius,
            {none}};
  }

  DualPolynomial polynomial_;
  PdGains<double> gains_;
  std::vector<LoopRoot> roots_;
};

}  // namespace detail

/// The sensitivity of the minimum spectral radius over D at a fixed P, and of the D that has it.
///
/// Two equations hold at the minimum, by what is active there (`MinimumRadiusKind`);
/// differentiated, they give both. By D itself the entries are 0.
/// @param plant     m, k and c of both masses, within their ranges
/// @param sampling  τ (s) > 0, δ (s) 0 … τ
/// @param gains     P and the D of `minimum_radius`, finite
/// @throws InvalidParameter outside the admissible ranges
template <class Scalar>
MinimumRadiusSensitivity minimum_radius_sensitivity(const TwoMass<Scalar>& plant,
                                                    const Sampling<double>& sampling,
                                                    const PdGains<double>& gains) {
  return detail::ActiveRoots(detail::dual_polynomial(plant, sampling, gains), gains).sensitivity();
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template MinimumRadiusSensitivity minimum_radius_sensitivity(const TwoMass<double>&,
                                                                    const Sampling<double>&,
                                                                    const PdGains<double>&);
#endif

}  // namespace holdfast
