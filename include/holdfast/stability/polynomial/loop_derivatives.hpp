#pragma once

#include <Eigen/Core>
#include <unsupported/Eigen/AutoDiff>

#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/control/zero_order_hold.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast {

/// A number that carries its derivatives along `Directions` parameters through any kernel that is
/// written on a scalar type.
template <int Directions>
using Rated = Eigen::AutoDiffScalar<Vector<double, Directions>>;

/// How fast the matrices of the sampled loop move with one parameter: their derivatives.
struct LoopRate {
  Matrix<double, 4> transition = Matrix<double, 4>::Zero();       ///< of A_d, per unit
  Vector<double, 4> previous_force = Vector<double, 4>::Zero();   ///< of Γ₁
  Vector<double, 4> present_force = Vector<double, 4>::Zero();    ///< of Γ₀
  Vector<double, 4> held_excitation = Vector<double, 4>::Zero();  ///< of c_d

  /// The rate along two parameters at once.
  LoopRate plus(const LoopRate& other, double share) const {
    return {transition + share * other.transition, previous_force + share * other.previous_force,
            present_force + share * other.present_force,
            held_excitation + share * other.held_excitation};
  }
};

/// By τ at a fixed δ, per second:
///
///     A_d′ = A A_d,   Γ₁′ = A Γ₁,   Γ₀′ = e^{A(τ−δ)} b = b + A Γ₀,   c_d′ = A_d c
template <template <class> class Plant>
LoopRate rate_by_period(const Plant<double>& plant, const SampledLoop<double>& loop) {
  const Matrix<double, 4> a = plant.state_matrix();
  return {a * loop.transition, a * loop.previous_force,
          plant.control_input() + a * loop.present_force,
          loop.transition * plant.excitation_input()};
}

/// By δ at a fixed τ, per second:
///
///     Γ₀′ = −e^{A(τ−δ)} b = −b − A Γ₀,   Γ₁′ = A_d b − A Γ₁
template <template <class> class Plant>
LoopRate rate_by_delay(const Plant<double>& plant, const SampledLoop<double>& loop) {
  const Matrix<double, 4> a = plant.state_matrix();
  const Vector<double, 4> b = plant.control_input();
  LoopRate rate;
  rate.present_force = -b - a * loop.present_force;
  rate.previous_force = loop.transition * b - a * loop.previous_force;
  return rate;
}

/// Derivatives of a plant's A, b and c by one of its parameters.
struct PlantRate {
  Matrix<double, 4> state_matrix;      ///< A′, 4 × 4, per unit of the parameter
  Vector<double, 4> control_input;     ///< b′, 4 × 1
  Vector<double, 4> excitation_input;  ///< c′, 4 × 1
};

/// By parameter number `direction` of a plant whose members carry their derivatives.
template <int Directions, template <class> class Plant>
PlantRate plant_rate(const Plant<Rated<Directions>>& plant, int direction) {
  const auto rate = [direction](const Rated<Directions>& x) { return x.derivatives()[direction]; };
  return {plant.state_matrix().unaryExpr(rate), plant.control_input().unaryExpr(rate),
          plant.excitation_input().unaryExpr(rate)};
}

namespace detail {

/// The hold of b and c beside their derivatives: with A′ the derivative of A,
///
///     d/dt [x′; x] = [A A′; 0 A] [x′; x] + [b′ c′; b c] w
///
/// so that one exponential of twice the size has the derivatives in its upper blocks.
inline HeldStep<double, 8, 2> held_with_rate(const Matrix<double, 4>& a, const Vector<double, 4>& b,
                                             const Vector<double, 4>& c, const PlantRate& rate,
                                             double duration) {
  Matrix<double, 8> generator = Matrix<double, 8>::Zero();
  generator.topLeftCorner<4, 4>() = a;
  generator.bottomRightCorner<4, 4>() = a;
  generator.topRightCorner<4, 4>() = rate.state_matrix;
  Matrix<double, 8, 2> inputs;
  inputs << rate.control_input, rate.excitation_input, b, c;
  return zero_order_hold<double, 8, 2>(generator, inputs, duration);
}

}  // namespace detail

/// By a parameter of the plant, from the derivatives of A, b and c by it.
/// Source: C. F. Van Loan, IEEE TAC 23 (1978); the derivative of e^{Ah} is its upper right block.
template <template <class> class Plant>
LoopRate rate_by_plant(const Plant<double>& plant, const PlantRate& rate,
                       const Sampling<double>& sampling) {
  const Matrix<double, 4> a = plant.state_matrix();
  const auto hold = [&](double duration) {
    return detail::held_with_rate(a, plant.control_input(), plant.excitation_input(), rate,
                                  duration);
  };
  const HeldStep<double, 8, 2> before = hold(sampling.processing_delay);
  const HeldStep<double, 8, 2> after = hold(sampling.period - sampling.processing_delay);
  // Values and derivatives of the products: the block form multiplies like the matrices themselves.
  const Matrix<double, 8> transition = after.transition * before.transition;
  const Matrix<double, 8, 2> late = after.transition * before.input;
  return {transition.topRightCorner<4, 4>(), late.col(0).head<4>(), after.input.col(0).head<4>(),
          after.input.col(1).head<4>() + late.col(1).head<4>()};
}

/// The loop whose matrices carry their derivatives, for the kernels that take any number type.
/// @param loop   the values of the matrices; τ and δ carry no derivatives
/// @param rates  one for each direction
template <int Directions>
SampledLoop<Rated<Directions>> rated_loop(const SampledLoop<double>& loop,
                                          const std::array<LoopRate, Directions>& rates) {
  SampledLoop<Rated<Directions>> rated;
  rated.sampling = {Rated<Directions>(loop.sampling.period),
                    Rated<Directions>(loop.sampling.processing_delay)};
  const auto carry = [&rates](auto& target, const auto& value, auto member) {
    for (Eigen::Index k = 0; k < value.size(); ++k) {
      target(k).value() = value(k);
      for (int i = 0; i < Directions; ++i) {
        target(k).derivatives()[i] = (rates[static_cast<std::size_t>(i)].*member)(k);
      }
    }
  };
  carry(rated.transition, loop.transition, &LoopRate::transition);
  carry(rated.increment, loop.increment, &LoopRate::transition);
  carry(rated.previous_force, loop.previous_force, &LoopRate::previous_force);
  carry(rated.present_force, loop.present_force, &LoopRate::present_force);
  carry(rated.held_excitation, loop.held_excitation, &LoopRate::held_excitation);
  return rated;
}

}  // namespace holdfast
