#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "holdfast/control/gains.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/core/interval.hpp"
#include "holdfast/math/linalg/balancing.hpp"
#include "holdfast/math/poly/polynomial.hpp"
#include "holdfast/stability/boundary/stable_intervals.hpp"
#include "holdfast/stability/polynomial/characteristic_polynomial.hpp"

namespace holdfast {

/// Characteristic polynomial det(λI − S) of the sampled loop in powers of λ − centre. The centre is
/// 0 if the plant's free motion almost decays within one sampling period, otherwise 1. Most roots λ
/// are close to this centre; their small differences λ − centre are thus computed with all digits.
/// For the same reason, radii in the λ plane are given by their offsets, radius − centre.
template <class Scalar>
struct LoopPolynomial {
  Scalar centre;  ///< centre of the powers, 1 or 0
  /// Monic polynomial in powers of λ − centre, affine in the gains P and D.
  AffinePolynomial<Scalar, 5, PolynomialVariable::about_centre> polynomial;

  /// Typical distance of the roots from 1: geometric mean of |λ − 1| over the eigenvalues λ of A_d
  /// (`SampledLoop`), at most 1; 0 if the centre is 0.
  Scalar scale() const {
    if (centre == Scalar(0)) return Scalar(0);
    return std::min(Scalar(1), std::pow(std::abs(polynomial.base[0]), Scalar(0.25)));
  }

  /// The offset ρ − centre of the spectral radius ρ at given gains, computed without cancellation.
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

  /// The excess ρ − 1 of the spectral radius at given gains; negative if the loop is stable.
  Scalar excess(const PdGains<Scalar>& gains) const {
    return (centre - Scalar(1)) + radius_offset(gains);
  }

  /// The polynomial in powers of λ/r − 1. It is stable if and only if all roots have |λ| < r.
  /// @param offset  offset r − centre of the radius r > 0
  AffinePolynomial<Scalar, 5> at_radius(const Scalar& offset) const {
    const Scalar radius = centre + offset;
    // λ − centre = r μ′ + offset with μ′ = λ′ − 1.
    return polynomial.template transformed<PolynomialVariable::about_one>(
        [&](const Polynomial<Scalar, 5>& p) { return rescaled(shifted(p, offset), radius); });
  }

  /// The open intervals of D (N s/m), ascending, with all |λ| < centre + offset at a given P (N/m).
  std::vector<Interval<Scalar>> differential_gains_within(const Scalar& proportional_gain,
                                                          const Scalar& offset) const {
    if (!(centre + offset > Scalar(0))) return {};
    return detail::differential_intervals(at_radius(offset), proportional_gain);
  }
};

/// Computes the characteristic polynomial of a loop. The centre is 0 if the balanced transition
/// matrix A_d has an ∞-norm < 1/4, otherwise 1.
template <class Scalar>
LoopPolynomial<Scalar> loop_polynomial(const SampledLoop<Scalar>& loop) {
  const Scalar norm =
      BalancedMatrix<Scalar, 4>(loop.transition).balanced.cwiseAbs().rowwise().sum().maxCoeff();
  if (norm < Scalar(0.25)) return {Scalar(0), detail::polynomial_about(0, loop)};
  return {Scalar(1), detail::polynomial_about(1, loop)};
}

/// The open intervals of D (N s/m) in which every root of the sampled loop has |λ| < radius, at a
/// given P; ascending. Radius 1 gives `stable_differential_gains`.
/// @param loop               loop of `sampled_loop`
/// @param proportional_gain  P (N/m), finite
/// @param radius             upper bound on |λ|, > 0
/// @throws InvalidParameter unless P is finite and the radius is finite and > 0
template <class Scalar>
std::vector<Interval<Scalar>> differential_gains_within_radius(const SampledLoop<Scalar>& loop,
                                                               const Scalar& proportional_gain,
                                                               const Scalar& radius) {
  require_finite("proportional gain P", static_cast<double>(proportional_gain), "N/m");
  require_positive("radius", static_cast<double>(radius), "");
  const LoopPolynomial<Scalar> polynomial = loop_polynomial(loop);
  return polynomial.differential_gains_within(proportional_gain, radius - polynomial.centre);
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template struct LoopPolynomial<double>;
extern template LoopPolynomial<double> loop_polynomial(const SampledLoop<double>&);
#endif

}  // namespace holdfast
