#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "holdfast/control/gains.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/core/interval.hpp"
#include "holdfast/math/linalg/balancing.hpp"
#include "holdfast/math/linalg/resolvent.hpp"
#include "holdfast/math/poly/parity.hpp"
#include "holdfast/math/poly/polynomial.hpp"
#include "holdfast/stability/boundary/stable_intervals.hpp"
#include "holdfast/stability/polynomial/affine_polynomial.hpp"
#include "holdfast/stability/polynomial/characteristic_polynomial.hpp"

namespace holdfast {

/// det(λI − S) in powers of λ − 1 where the plant moves little between samples, and in powers of λ
/// where hardly anything is left of its motion from one sample to the next.
///
/// In the first case the roots crowd at λ = 1, in the second at λ = 0; the polynomial must be
/// written about the place where they crowd so that round-off does not move them by a root of its
/// size. Radii are carried as their offset from the centre for the same reason.
template <class Scalar>
struct LoopPolynomial {
  Scalar centre;                           ///< 1 or 0
  AffinePolynomial<Scalar, 5> polynomial;  ///< monic, in powers of λ − centre

  /// The size of the roots' distances from the centre, for tolerances.
  Scalar scale() const {
    if (centre == Scalar(0)) return Scalar(0);
    return std::min(Scalar(1), std::pow(std::abs(polynomial.base[0]), Scalar(0.25)));
  }

  /// ρ(P, D) − centre, the largest |λ|, without cancellation.
  Scalar radius_offset(const PdGains<Scalar>& gains) const {
    Scalar largest = -centre;
    for (const std::complex<Scalar>& root : roots(polynomial.at(gains))) {
      // |1 + μ| − 1 = (2 Re μ + |μ|²) / (1 + |1 + μ|)
      const Scalar modulus = std::abs(centre + root);
      const Scalar offset = (Scalar(2) * centre * root.real() + std::norm(root)) /
                            std::max(centre + modulus, std::numeric_limits<Scalar>::min());
      largest = std::max(largest, offset);
    }
    return largest;
  }

  /// ρ(P, D) − 1.
  Scalar excess(const PdGains<Scalar>& gains) const {
    return (centre - Scalar(1)) + radius_offset(gains);
  }

  /// The polynomial of λ′ = λ/r in powers of λ′ − 1: stable where all |λ| < r.
  /// @param offset  r − centre, above −centre
  AffinePolynomial<Scalar, 5> at_radius(const Scalar& offset) const {
    const Scalar radius = centre + offset;
    return polynomial.transformed([&](Polynomial<Scalar, 5> p) {
      // λ − centre = r μ' + offset with μ' = λ' − 1: a Taylor shift, then a change of unit.
      for (int start = 0; start < 5; ++start) {
        for (int k = 4; k >= start; --k) p[k] += offset * p[k + 1];
      }
      return detail::rescaled<Scalar, 6>(p, radius);
    });
  }

  /// The open intervals of D (N s/m) with ρ(P, D) < centre + offset, exact and ascending.
  std::vector<Interval<Scalar>> differential_gains_within(const Scalar& proportional_gain,
                                                          const Scalar& offset) const {
    if (!(centre + offset > Scalar(0))) return {};
    return stable_differential_gains(at_radius(offset), proportional_gain);
  }
};

namespace detail {

/// `characteristic_polynomial(loop)` in powers of λ, from A_d itself.
template <class Scalar>
AffinePolynomial<Scalar, 5> characteristic_polynomial_in_lambda(const SampledLoop<Scalar>& loop) {
  const auto open_loop = resolvent<Scalar, 4>(loop.transition);
  const auto coefficient = [&](int state) {
    const RowVector<Scalar, 4> row = RowVector<Scalar, 4>::Unit(state);
    Polynomial<Scalar, 5> value = Polynomial<Scalar, 5>::Zero();
    value.template head<4>() -= open_loop.between(row, loop.previous_force);
    value.template segment<4>(1) -= open_loop.between(row, loop.present_force);
    return value;
  };
  Polynomial<Scalar, 5> base = Polynomial<Scalar, 5>::Zero();
  base.template tail<5>() = open_loop.determinant;
  return {base, coefficient(0), coefficient(1)};
}

}  // namespace detail

/// The loop's polynomial about 0 where the balanced A_d has a norm below 1/4, about 1 elsewhere.
template <class Scalar>
LoopPolynomial<Scalar> loop_polynomial(const SampledLoop<Scalar>& loop) {
  const Scalar norm =
      BalancedMatrix<Scalar, 4>(loop.transition).balanced.cwiseAbs().rowwise().sum().maxCoeff();
  if (norm < Scalar(0.25)) return {Scalar(0), detail::characteristic_polynomial_in_lambda(loop)};
  return {Scalar(1), characteristic_polynomial(loop)};
}

/// The open intervals of D (N s/m) at which every root of the sampled loop has |λ| < radius; radius
/// 1 gives `stable_differential_gains`.
/// @param loop               of `sampled_loop`
/// @param proportional_gain  P (N/m), finite
/// @param radius             > 0
template <class Scalar>
std::vector<Interval<Scalar>> differential_gains_within_radius(const SampledLoop<Scalar>& loop,
                                                               const Scalar& proportional_gain,
                                                               const Scalar& radius) {
  const LoopPolynomial<Scalar> polynomial = loop_polynomial(loop);
  return polynomial.differential_gains_within(proportional_gain, radius - polynomial.centre);
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template struct LoopPolynomial<double>;
extern template LoopPolynomial<double> loop_polynomial(const SampledLoop<double>&);
extern template std::vector<Interval<double>> differential_gains_within_radius(
    const SampledLoop<double>&, const double&, const double&);
#endif

}  // namespace holdfast
