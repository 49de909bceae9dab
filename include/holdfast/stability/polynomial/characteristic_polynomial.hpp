#pragma once

#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/math/linalg/resolvent.hpp"
#include "holdfast/math/poly/polynomial.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "holdfast/stability/polynomial/affine_polynomial.hpp"

namespace holdfast {

/// Characteristic polynomial of the continuous loop without delay, degree 4 in s:
///
///     det(sI − A − bK) = det(sI − A) − P [1 0 0 0] adj(sI − A) b − D [0 1 0 0] adj(sI − A) b
///
/// All roots in the left half-plane ⇔ asymptotically stable. Source: Kollár 2022, §4.1.
template <class Scalar, template <class> class Plant>
AffinePolynomial<Scalar, 4> characteristic_polynomial(const Plant<Scalar>& plant) {
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

/// Characteristic polynomial det(λI − S) of the sampled loop, degree 5, written in powers of μ = λ
/// − 1.
///
/// Eliminating the stored force u_{j−1} leaves
///
///     det(λI − S) = λ det(λI − A_d) − K adj(λI − A_d) (λ Γ₀ + Γ₁)
///
/// When sampling is fast the plant's four roots crowd around λ = 1 (the fifth stays near 0), where
/// powers of λ lose them to round-off; powers of λ − 1 do not. `in_powers_of_lambda` and
/// `in_half_plane` (mobius_zhukovsky.hpp) change the variable. All |λ| < 1 ⇔ asymptotically stable.
/// For δ = 0, λ = 0 is a structural root.
template <class Scalar>
AffinePolynomial<Scalar, 5> characteristic_polynomial(const SampledLoop<Scalar>& loop) {
  const auto open_loop = resolvent<Scalar, 4>(loop.increment);
  const Vector<Scalar, 4> whole_force = loop.present_force + loop.previous_force;
  AffinePolynomial<Scalar, 5> result;
  const auto coefficient = [&](int state) {
    const RowVector<Scalar, 4> row = RowVector<Scalar, 4>::Unit(state);
    Polynomial<Scalar, 5> value = Polynomial<Scalar, 5>::Zero();
    value.template head<4>() -= open_loop.between(row, whole_force);
    value.template segment<4>(1) -= open_loop.between(row, loop.present_force);
    return value;
  };
  result.base.setZero();
  result.base.template head<5>() += open_loop.determinant;
  result.base.template tail<5>() += open_loop.determinant;
  result.proportional = coefficient(0);
  result.differential = coefficient(1);
  return result;
}

/// p(λ) from p written in powers of μ = λ − 1 (Taylor shift).
template <class Scalar, int Size>
Vector<Scalar, Size> in_powers_of_lambda(Vector<Scalar, Size> in_powers_of_mu) {
  for (int start = 0; start < Size - 1; ++start) {
    for (int k = Size - 2; k >= start; --k) in_powers_of_mu[k] -= in_powers_of_mu[k + 1];
  }
  return in_powers_of_mu;
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template AffinePolynomial<double, 4> characteristic_polynomial(const TwoMass<double>&);
extern template AffinePolynomial<double, 5> characteristic_polynomial(const SampledLoop<double>&);
#endif

}  // namespace holdfast
