#pragma once

#include "holdfast/control/gains.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/math/linalg/resolvent.hpp"
#include "holdfast/math/poly/polynomial.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast {

/// The variable x of a polynomial, on which the stable region of its roots depends. Polynomials in
/// different variables are different types.
enum class PolynomialVariable {
  half_plane,    ///< s, or w of `in_half_plane`; roots with Re x < 0 are stable
  about_one,     ///< λ − 1; roots with |1 + x| < 1 are stable
  about_centre,  ///< λ − c with c of `LoopPolynomial`; roots with |c + x| < 1 are stable
};

/// A polynomial whose coefficients are affine in the two gains:
///
///     p(x; P, D) = base(x) + P · proportional(x) + D · differential(x)
///
/// The characteristic polynomial of the loop has this form because both gains are in one row of the
/// feedback matrix. The polynomial at one (P, D) costs 2 (Degree + 1) multiply-adds.
/// @tparam Variable  x; by default that of the loop's polynomial, s for degree 4, else λ − 1
template <class Scalar, int Degree,
          PolynomialVariable Variable =
              Degree == 4 ? PolynomialVariable::half_plane : PolynomialVariable::about_one>
struct AffinePolynomial {
  Polynomial<Scalar, Degree> base;          ///< value without control, constant coefficient first
  Polynomial<Scalar, Degree> proportional;  ///< derivative ∂p/∂P, per N/m of P
  Polynomial<Scalar, Degree> differential;  ///< derivative ∂p/∂D, per N s/m of D

  /// The polynomial at one pair of gains, constant coefficient first.
  Polynomial<Scalar, Degree> at(const PdGains<Scalar>& gains) const {
    return base + gains.proportional * proportional + gains.differential * differential;
  }

  /// Applies one linear change of variable to all three parts.
  /// @tparam To  the new variable
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
  require_finite("coefficients of the polynomial", static_cast<double>(sum), "");
}

/// A polynomial in a variable whose stable half-plane is Re < 0.
template <class Scalar, int Degree>
using HalfPlanePolynomial = AffinePolynomial<Scalar, Degree, PolynomialVariable::half_plane>;

/// The polynomial transformed from λ − 1 to the half-plane's variable w (math/poly/polynomial.hpp).
template <class Scalar, int Degree>
HalfPlanePolynomial<Scalar, Degree> in_half_plane(
    const AffinePolynomial<Scalar, Degree, PolynomialVariable::about_one>& polynomial) {
  return polynomial.template transformed<PolynomialVariable::half_plane>(
      [](const Polynomial<Scalar, Degree>& p) { return in_half_plane<Scalar, Degree + 1>(p); });
}
/// The polynomial itself, unchanged, since its variable already is that of the half-plane.
template <class Scalar, int Degree>
const HalfPlanePolynomial<Scalar, Degree>& in_half_plane(
    const HalfPlanePolynomial<Scalar, Degree>& polynomial) {
  return polynomial;
}

/// The characteristic polynomial of the continuous loop without delay, degree 4 in s:
///
///     det(sI − A − bK) = det(sI − A) − P [1 0 0 0] adj(sI − A) b − D [0 1 0 0] adj(sI − A) b
///
/// All roots in the left half-plane ⇔ asymptotically stable. Source: Kollár 2022, §4.1.
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
/// @param centre  centre c, 1 or 0
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
/// Elimination of the stored force u_{j−1} gives
///
///     det(λI − S) = λ det(λI − A_d) − K adj(λI − A_d) (λ Γ₀ + Γ₁)
///
/// With fast sampling the plant's four roots are close to λ = 1, where powers of λ lose them to
/// round-off; powers of λ − 1 do not. `shifted` and `in_half_plane` change the variable. All |λ| <
/// 1 ⇔ asymptotically stable. For δ = 0, λ = 0 is a structural root.
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
