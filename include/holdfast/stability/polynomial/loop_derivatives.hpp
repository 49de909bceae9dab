#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <unsupported/Eigen/AutoDiff>

#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/control/zero_order_hold.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast {

/// A number that carries its derivatives along `Directions` parameters through any kernel that is
/// written on a scalar type.
template <int Directions>
using DualNumber = Eigen::AutoDiffScalar<Vector<double, Directions>>;

/// How fast the matrices of the sampled loop move with one parameter: their derivatives.
template <class Scalar>
struct BasicLoopDerivative {
  Matrix<Scalar, 4> transition = Matrix<Scalar, 4>::Zero();       ///< of A_d, per unit
  Vector<Scalar, 4> previous_force = Vector<Scalar, 4>::Zero();   ///< of Γ₁
  Vector<Scalar, 4> present_force = Vector<Scalar, 4>::Zero();    ///< of Γ₀
  Vector<Scalar, 4> held_excitation = Vector<Scalar, 4>::Zero();  ///< of c_d

  /// The rate along two parameters at once.
  BasicLoopDerivative plus(const BasicLoopDerivative& other, const Scalar& share) const {
    return {transition + share * other.transition, previous_force + share * other.previous_force,
            present_force + share * other.present_force,
            held_excitation + share * other.held_excitation};
  }
};

/// The derivatives of a loop in `double`.
using LoopDerivative = BasicLoopDerivative<double>;

/// By τ at a fixed δ, per second:
///
///     A_d′ = A A_d,   Γ₁′ = A Γ₁,   Γ₀′ = e^{A(τ−δ)} b = b + A Γ₀,   c_d′ = A_d c
/// @tparam Plant  anything with `state_matrix()`, `control_input()` and `excitation_input()`
template <class Plant, class Scalar>
BasicLoopDerivative<Scalar> derivative_by_period(const Plant& plant,
                                                 const SampledLoop<Scalar>& loop) {
  const Matrix<Scalar, 4> a = plant.state_matrix();
  return {a * loop.transition, a * loop.previous_force,
          plant.control_input() + a * loop.present_force,
          loop.transition * plant.excitation_input()};
}

/// By δ at a fixed τ, per second:
///
///     Γ₀′ = −e^{A(τ−δ)} b = −b − A Γ₀,   Γ₁′ = A_d b − A Γ₁
/// @tparam Plant  anything with `state_matrix()` and `control_input()`
template <class Plant, class Scalar>
BasicLoopDerivative<Scalar> derivative_by_delay(const Plant& plant,
                                                const SampledLoop<Scalar>& loop) {
  const Matrix<Scalar, 4> a = plant.state_matrix();
  const Vector<Scalar, 4> b = plant.control_input();
  BasicLoopDerivative<Scalar> rate;
  rate.present_force = -b - a * loop.present_force;
  rate.previous_force = loop.transition * b - a * loop.previous_force;
  return rate;
}

/// Derivatives of a plant's A, b and c by one of its parameters.
template <class Scalar>
struct BasicPlantDerivative {
  Matrix<Scalar, 4> state_matrix;      ///< A′, 4 × 4, per unit of the parameter
  Vector<Scalar, 4> control_input;     ///< b′, 4 × 1
  Vector<Scalar, 4> excitation_input;  ///< c′, 4 × 1
};

/// The derivatives of a plant in `double`.
using PlantDerivative = BasicPlantDerivative<double>;

/// By parameter number `direction` of a plant whose members carry their derivatives.
template <int Directions, template <class> class Plant>
PlantDerivative plant_derivative(const Plant<DualNumber<Directions>>& plant, int direction) {
  const auto rate = [direction](const DualNumber<Directions>& x) {
    return x.derivatives()[direction];
  };
  return {plant.state_matrix().unaryExpr(rate), plant.control_input().unaryExpr(rate),
          plant.excitation_input().unaryExpr(rate)};
}

namespace detail {

/// The hold of b and c beside their derivatives: with A′ the derivative of A,
///
///     d/dt [x′; x] = [A A′; 0 A] [x′; x] + [b′ c′; b c] w
///
/// so that one exponential of twice the size has the derivatives in its upper blocks.
template <class Plant, class Scalar>
HeldStep<Scalar, 8, 2> held_with_derivative(const Plant& plant,
                                            const BasicPlantDerivative<Scalar>& rate,
                                            const Scalar& duration) {
  const Matrix<Scalar, 4> a = plant.state_matrix();
  Matrix<Scalar, 8> generator = Matrix<Scalar, 8>::Zero();
  generator.template topLeftCorner<4, 4>() = a;
  generator.template bottomRightCorner<4, 4>() = a;
  generator.template topRightCorner<4, 4>() = rate.state_matrix;
  Matrix<Scalar, 8, 2> inputs;
  inputs << rate.control_input, rate.excitation_input, plant.control_input(),
      plant.excitation_input();
  return zero_order_hold<Scalar, 8, 2>(generator, inputs, duration);
}

}  // namespace detail

/// By a parameter of the plant, from the derivatives of A, b and c by it.
/// Source: C. F. Van Loan, IEEE TAC 23 (1978); the derivative of e^{Ah} is its upper right block.
template <class Plant, class Scalar>
BasicLoopDerivative<Scalar> derivative_by_plant(const Plant& plant,
                                                const BasicPlantDerivative<Scalar>& rate,
                                                const Sampling<Scalar>& sampling) {
  const Scalar rest = sampling.period - sampling.processing_delay;
  const auto before = detail::held_with_derivative(plant, rate, sampling.processing_delay);
  const auto after = detail::held_with_derivative(plant, rate, rest);
  // Values and derivatives of the products: the block form multiplies like the matrices themselves.
  const Matrix<Scalar, 8> transition = after.transition * before.transition;
  const Matrix<Scalar, 8, 2> late = after.transition * before.input;
  return {transition.template topRightCorner<4, 4>(), late.col(0).template head<4>(),
          after.input.col(0).template head<4>(),
          after.input.col(1).template head<4>() + late.col(1).template head<4>()};
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

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template LoopDerivative derivative_by_period(const TwoMass<double>&,
                                                    const SampledLoop<double>&);
extern template LoopDerivative derivative_by_delay(const TwoMass<double>&,
                                                   const SampledLoop<double>&);
extern template LoopDerivative derivative_by_plant(const TwoMass<double>&, const PlantDerivative&,
                                                   const Sampling<double>&);
#endif

}  // namespace holdfast
