#pragma once

#include "holdfast/control/gains.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/math/linalg/resolvent.hpp"
#include "holdfast/math/poly/polynomial.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast {

/// Kind of the variable x of a characteristic polynomial. It determines which roots x are stable.
/// Polynomials in different kinds of variables have different types.
enum class PolynomialVariable {
  half_plane,    ///< x = s, or w of `in_half_plane`; roots with Re x < 0 are stable
  about_one,     ///< x = λ − 1; roots with |1 + x| < 1 are stable
  about_centre,  ///< x = λ − c with `centre` c of `LoopPolynomial`; stable: |c + x| < 1
};

/// Polynomial in x whose coefficients are affine in the gains P and D:
///
///     p(x; P, D) = base(x) + P · proportional(x) + D · differential(x)
///
/// The characteristic polynomial of a loop has this form because both gains are in one row of the
/// feedback matrix. Its coefficients at one (P, D) cost 2 (Degree + 1) multiply-adds.
/// @tparam Variable  kind of the variable x; by default s for degree 4, otherwise λ − 1
template <class Scalar, int Degree,
          PolynomialVariable Variable =
              Degree == 4 ? PolynomialVariable::half_plane : PolynomialVariable::about_one>
struct AffinePolynomial {
  Polynomial<Scalar, Degree> base;          ///< polynomial at P = D = 0, constant coefficient first
  Polynomial<Scalar, Degree> proportional;  ///< derivative ∂p/∂P, per N/m of P
  Polynomial<Scalar, Degree> differential;  ///< derivative ∂p/∂D, per N s/m of D

  /// The polynomial at given gains, constant coefficient first.
  Polynomial<Scalar, Degree> at(const PdGains<Scalar>& gains) const {
    return base + gains.proportional * proportional + gains.differential * differential;
  }

  /// The polynomial in another variable.
  /// @tparam To  kind of the new variable
  /// @param map  linear function from the old to the new coefficients, applied to all three parts
  template <PolynomialVariable To, class LinearMap>
  AffinePolynomial<Scalar, Degree, To> transformed(const LinearMap& map) const {
    return {map(base), map(proportional), map(differential)};
  }
};

/// Validates a polynomial. @throws InvalidParameter unless all coefficients are finite
template <class Scalar, int Degree, PolynomialVariable Variable>
void validate(const AffinePolynomial<Scalar, Degree, Variable>& polynomial) {
  const Scalar sum =
      polynomial.base.sum() + polynomial.proportional.sum() + polynomial.differential.sum();
  require_finite("sum of the polynomial's coefficients", static_cast<double>(sum), "");
}

/// Polynomial affine in the gains P and D, in a variable in which stable roots have Re < 0.
template <class Scalar, int Degree>
using HalfPlanePolynomial = AffinePolynomial<Scalar, Degree, PolynomialVariable::half_plane>;

/// The polynomial in w instead of λ − 1, with λ = (1 + w)/(1 − w): stable roots have Re w < 0.
template <class Scalar, int Degree>
HalfPlanePolynomial<Scalar, Degree> in_half_plane(
    const AffinePolynomial<Scalar, Degree, PolynomialVariable::about_one>& polynomial) {
  return polynomial.template transformed<PolynomialVariable::half_plane>(
      [](const Polynomial<Scalar, Degree>& p) { return in_half_plane<Scalar, Degree + 1>(p); });
}
/// Returns the polynomial unchanged, as its stable roots have Re < 0 already.
template <class Scalar, int Degree>
const HalfPlanePolynomial<Scalar, Degree>& in_half_plane(
    const HalfPlanePolynomial<Scalar, Degree>& polynomial) {
  return polynomial;
}

/// The characteristic polynomial of the continuous loop without delay, of degree 4 in s. With the
/// plant's state matrix A, its input b of the control force and the feedback K = [P D 0 0]:
///
///     det(sI − A − bK) = det(sI − A) − P [1 0 0 0] adj(sI − A) b − D [0 1 0 0] adj(sI − A) b
///
/// The loop is asymptotically stable if and only if all Re s < 0. Source: Kollár 2022, §4.1.
/// @throws InvalidParameter where the two masses are not admissible
template <class Scalar, template <class> class Plant>
AffinePolynomial<Scalar, 4> characteristic_polynomial(const Plant<Scalar>& plant) {
  detail::require_admissible(plant);
  const auto open_loop = resolvent<Scalar, 4>(plant.state_matrix());
  AffinePolynomial<Scalar, 4> result;
  const auto coefficient = [&](int state) {
    Polynomial<Scalar, 4> value = Polynomial<Scalar, 4>::Zero();
    value.template head<4>() =
        -open_loop.between(RowVector<Scalar, 4>::Unit(state), plant.control_input());
    return value;
  };
  result.base = open_loop.determinant;
  result.proportional = coefficient(0);
  result.differential = coefficient(1);
  return result;
}

namespace detail {

/// The polynomial det(λI − S) in powers of μ = λ − c, with λ Γ₀ + Γ₁ = μ Γ₀ + (c Γ₀ + Γ₁).
/// @param centre  centre c of the powers, 1 or 0
template <class Scalar>
AffinePolynomial<Scalar, 5, PolynomialVariable::about_centre> polynomial_about(
    int centre, const SampledLoop<Scalar>& loop) {
  const auto open_loop = resolvent<Scalar, 4>(centre == 1 ? loop.increment : loop.transition);
  Vector<Scalar, 4> force = loop.previous_force;
  if (centre == 1) force += loop.present_force;
  AffinePolynomial<Scalar, 5, PolynomialVariable::about_centre> result;
  const auto coefficient = [&](int state) {
    const RowVector<Scalar, 4> row = RowVector<Scalar, 4>::Unit(state);
    Polynomial<Scalar, 5> value = Polynomial<Scalar, 5>::Zero();
    value.template head<4>() -= open_loop.between(row, force);
    value.template segment<4>(1) -= open_loop.between(row, loop.present_force);
    return value;
  };
  result.base.setZero();
  result.base.template tail<5>() = open_loop.determinant;
  if (centre == 1) result.base.template head<5>() += open_loop.determinant;
  result.proportional = coefficient(0);
  result.differential = coefficient(1);
  return result;
}

}  // namespace detail

/// The characteristic polynomial det(λI − S) of the sampled loop, degree 5, in powers of μ = λ − 1.
///
/// With A_d, Γ₀, Γ₁ and S of `SampledLoop` and the feedback K = [P D 0 0],
///
///     det(λI − S) = λ det(λI − A_d) − K adj(λI − A_d) (λ Γ₀ + Γ₁)
///
/// Fast sampling makes four roots close to λ = 1. Powers of μ keep all digits of their λ − 1, which
/// round-off would destroy in powers of λ. `shifted` and `in_half_plane` change the variable.
/// The loop is asymptotically stable if and only if all |λ| < 1. For δ = 0, λ = 0 is always a root.
template <class Scalar>
AffinePolynomial<Scalar, 5> characteristic_polynomial(const SampledLoop<Scalar>& loop) {
  const auto about_one = detail::polynomial_about(1, loop);
  return {about_one.base, about_one.proportional, about_one.differential};
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template AffinePolynomial<double, 4> characteristic_polynomial(const TwoMass<double>&);
extern template AffinePolynomial<double, 5> characteristic_polynomial(const SampledLoop<double>&);
#endif

}  // namespace holdfast
