#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <unsupported/Eigen/AutoDiff>
#include <vector>

#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/math/poly/polynomial.hpp"

namespace holdfast {

/// A number that carries its derivatives along `Directions` parameters through any kernel that is
/// written on a scalar type.
template <int Directions>
using DualNumber = Eigen::AutoDiffScalar<Vector<double, Directions>>;

/// How fast the matrices of the sampled loop move with one parameter: their derivatives.
struct LoopDerivative {
  Matrix<double, 4> transition = Matrix<double, 4>::Zero();       ///< of A_d, per unit
  Vector<double, 4> previous_force = Vector<double, 4>::Zero();   ///< of Γ₁
  Vector<double, 4> present_force = Vector<double, 4>::Zero();    ///< of Γ₀
  Vector<double, 4> held_excitation = Vector<double, 4>::Zero();  ///< of c_d

  /// The rate along two parameters at once.
  LoopDerivative plus(const LoopDerivative& other, double share) const {
    return {transition + share * other.transition, previous_force + share * other.previous_force,
            present_force + share * other.present_force,
            held_excitation + share * other.held_excitation};
  }
};

/// By τ at a fixed δ, per second:
///
///     A_d′ = A A_d,   Γ₁′ = A Γ₁,   Γ₀′ = e^{A(τ−δ)} b = b + A Γ₀,   c_d′ = A_d c
/// @tparam Plant  anything with `state_matrix()`, `control_input()` and `excitation_input()`
template <class Plant>
LoopDerivative derivative_by_period(const Plant& plant, const SampledLoop<double>& loop) {
  const Matrix<double, 4> a = plant.state_matrix();
  return {a * loop.transition, a * loop.previous_force,
          plant.control_input() + a * loop.present_force,
          loop.transition * plant.excitation_input()};
}

/// By δ at a fixed τ, per second:
///
///     Γ₀′ = −e^{A(τ−δ)} b = −b − A Γ₀,   Γ₁′ = A_d b − A Γ₁
/// @tparam Plant  anything with `state_matrix()` and `control_input()`
template <class Plant>
LoopDerivative derivative_by_delay(const Plant& plant, const SampledLoop<double>& loop) {
  const Matrix<double, 4> a = plant.state_matrix();
  const Vector<double, 4> b = plant.control_input();
  LoopDerivative rate;
  rate.present_force = -b - a * loop.present_force;
  rate.previous_force = loop.transition * b - a * loop.previous_force;
  return rate;
}

/// The values of dual numbers, without the derivatives that they carry.
template <class Dual>
auto values_of(const Eigen::MatrixBase<Dual>& dual) {
  return dual.unaryExpr([](const auto& x) { return double(x.value()); }).eval();
}

/// The derivatives along direction number `direction` of dual numbers.
template <class Dual>
auto derivative_of(const Eigen::MatrixBase<Dual>& dual, int direction) {
  return dual.unaryExpr([direction](const auto& x) { return double(x.derivatives()[direction]); })
      .eval();
}

/// A plant beside its derivative by one of its parameters, state [x′; x]:
///
///     A ← [A A′; 0 A],   b ← [b′; b],   c ← [c′; c]
///
/// What is computed of it has the derivatives by the parameter in its upper (right) blocks.
/// Source: C. F. Van Loan, IEEE TAC 23 (1978).
struct PlantDerivative {
  Eigen::MatrixXd matrix;      ///< of A, 8 × 8
  Eigen::VectorXd force;       ///< of b, 8 × 1
  Eigen::VectorXd excitation;  ///< of c, 8 × 1

  const Eigen::MatrixXd& state_matrix() const { return matrix; }          ///< of A
  const Eigen::VectorXd& control_input() const { return force; }          ///< of b
  const Eigen::VectorXd& excitation_input() const { return excitation; }  ///< of c
};

/// By parameter number `direction` of a plant whose members carry their derivatives.
template <int Directions, template <class> class Plant>
PlantDerivative plant_derivative(const Plant<DualNumber<Directions>>& plant, int direction) {
  const auto column = [direction](const auto& dual) {
    Eigen::VectorXd both(8);
    both << derivative_of(dual, direction), values_of(dual);
    return both;
  };
  const auto a = plant.state_matrix();
  Eigen::MatrixXd matrix(8, 8);
  matrix << values_of(a), derivative_of(a, direction), Matrix<double, 4>::Zero(), values_of(a);
  return {matrix, column(plant.control_input()), column(plant.excitation_input())};
}

/// By a parameter of the plant, per its unit.
template <class Plant>
LoopDerivative derivative_by_plant(const Plant& plant, const Sampling<double>& sampling) {
  const auto loop = sampled_loop(plant, sampling);
  return {loop.transition.template topRightCorner<4, 4>(), loop.previous_force.template head<4>(),
          loop.present_force.template head<4>(), loop.held_excitation.template head<4>()};
}

/// The loop whose matrices carry their derivatives, for the kernels that take any number type.
/// @param loop   the values of the matrices; τ and δ carry no derivatives
/// @param rates  one for each direction
template <int Directions>
SampledLoop<DualNumber<Directions>> dual_loop(const SampledLoop<double>& loop,
                                              const std::array<LoopDerivative, Directions>& rates) {
  SampledLoop<DualNumber<Directions>> dual;
  dual.sampling = {DualNumber<Directions>(loop.sampling.period),
                   DualNumber<Directions>(loop.sampling.processing_delay)};
  const auto carry = [&rates](auto& target, const auto& value, auto member) {
    for (Eigen::Index k = 0; k < value.size(); ++k) {
      target(k).value() = value(k);
      for (int i = 0; i < Directions; ++i) {
        target(k).derivatives()[i] = (rates[static_cast<std::size_t>(i)].*member)(k);
      }
    }
  };
  carry(dual.transition, loop.transition, &LoopDerivative::transition);
  carry(dual.increment, loop.increment, &LoopDerivative::transition);
  carry(dual.previous_force, loop.previous_force, &LoopDerivative::previous_force);
  carry(dual.present_force, loop.present_force, &LoopDerivative::present_force);
  carry(dual.held_excitation, loop.held_excitation, &LoopDerivative::held_excitation);
  return dual;
}

/// A root λ of the loop's characteristic polynomial p and how it moves with the parameters x that
/// the polynomial's coefficients carry:
///
///     ∂λ/∂x = −(∂p/∂x) / (∂p/∂λ)
///
/// At a multiple root the rates are infinite or not a number.
template <int Directions>
struct RootSensitivity {
  using Complex = std::complex<double>;  ///< the type of a root

  Complex offset;                     ///< μ = λ − centre
  double centre = 1.0;                ///< 1, or 0 where the roots crowd there (`LoopPolynomial`)
  Vector<Complex, Directions> rates;  ///< ∂λ/∂x, per unit of each parameter

  /// λ; where sampling is fast `offset` holds it with more digits.
  Complex value() const { return centre + offset; }

  /// |λ| − centre without cancellation.
  double radius_offset() const {
    if (centre == 0.0) return std::abs(offset);
    return (2.0 * offset.real() + std::norm(offset)) / (1.0 + std::abs(value()));
  }

  /// |λ| − 1.
  double excess() const { return radius_offset() - (1.0 - centre); }

  /// ln |λ|, −∞ for λ = 0.
  double logarithm() const {
    const double square = 2.0 * offset.real() + std::norm(offset);  // |λ|² − 1 about 1
    const bool near_one = centre == 1.0 && square > -0.5;
    return near_one ? 0.5 * std::log1p(square) : std::log(std::abs(value()));
  }

  /// ∂ ln|λ|/∂x.
  Vector<double, Directions> logarithmic_rates() const {
    return rates.unaryExpr([this](const Complex& rate) { return (rate / value()).real(); });
  }
};

/// All roots with their rates.
/// @param polynomial  of a `dual_loop` at some gains, in powers of μ = λ − centre
/// @param centre      1, or 0 for a polynomial in powers of λ
template <int Directions>
std::vector<RootSensitivity<Directions>> root_sensitivities(
    const Polynomial<DualNumber<Directions>, 5>& polynomial, double centre = 1.0) {
  const Polynomial<double, 5> values = values_of(polynomial);
  const Polynomial<double, 4> slope = derivative<double, 6>(values);
  std::vector<RootSensitivity<Directions>> result;
  for (const std::complex<double>& mu : roots(values)) {
    const std::complex<double> inverse = -1.0 / evaluate(slope, mu);
    RootSensitivity<Directions> root{mu, centre, {}};
    for (int i = 0; i < Directions; ++i)
      root.rates[i] = evaluate(derivative_of(polynomial, i), mu) * inverse;
    result.push_back(root);
  }
  return result;
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template LoopDerivative derivative_by_plant(const PlantDerivative&, const Sampling<double>&);
#endif

}  // namespace holdfast
