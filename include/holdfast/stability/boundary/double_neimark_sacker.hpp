#pragma once

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "holdfast/control/gains.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/math/poly/polynomial.hpp"
#include "holdfast/stability/boundary/root_pair_curve.hpp"

namespace holdfast {

/// Gains with two different root pairs on the imaginary axis: the curve of root pairs meets itself.
template <class Scalar>
struct DoubleNeimarkSacker {
  PdGains<Scalar> gains;  ///< P (N/m) and D (N s/m) that have both pairs
  Scalar lower_square;    ///< Y of the slower pair
  Scalar upper_square;    ///< Y of the faster pair
};

namespace detail {

/// Rows of the two 3 × 3 matrices by which (1, P, D) gives the coefficients of Y⁰, Y¹, Y² of the
/// even and of the odd part. Rows and columns are scaled to like size; `column` undoes the latter.
template <class Scalar>
struct ParityPencil {
  Matrix<Scalar, 3> even, odd;
  Vector<Scalar, 3> column;

  explicit ParityPencil(const RootPairCurve<Scalar>& curve) {
    even << curve.base().even, curve.proportional().even, curve.differential().even;
    odd << curve.base().odd, curve.proportional().odd, curve.differential().odd;
    column.setOnes();
    for (int k = 0; k < 3; ++k) {
      const Scalar size =
          std::max(even.col(k).cwiseAbs().maxCoeff(), odd.col(k).cwiseAbs().maxCoeff());
      if (!(size > Scalar(0))) continue;
      column[k] = Scalar(1) / size;
      even.col(k) *= column[k];
      odd.col(k) *= column[k];
    }
    for (int k = 0; k < 3; ++k) {
      const Scalar size =
          std::max(even.row(k).cwiseAbs().maxCoeff(), odd.row(k).cwiseAbs().maxCoeff());
      if (!(size > Scalar(0))) continue;
      even.row(k) /= size;
      odd.row(k) /= size;
    }
  }

  Matrix<Scalar, 3> at(const Scalar& ratio) const { return ratio * even - odd; }

  /// det(ν even − odd), degree 3 in ν.
  Polynomial<Scalar, 3> determinant() const {
    const auto mixed = [this](int rows_of_even) {
      Matrix<Scalar, 3> matrix;
      for (int k = 0; k < 3; ++k) {
        matrix.row(k) = (rows_of_even >> k) % 2 == 1 ? even.row(k) : odd.row(k);
      }
      return matrix.determinant();
    };
    return {-mixed(0), mixed(1) + mixed(2) + mixed(4), -mixed(3) - mixed(5) - mixed(6), mixed(7)};
  }

  /// The gains for which odd = ν even; not finite where there are none.
  PdGains<Scalar> gains(const Scalar& ratio) const {
    const Matrix<Scalar, 3> matrix = at(ratio);
    Vector<Scalar, 3> null = Vector<Scalar, 3>::Zero();
    for (int k = 0; k < 3; ++k) {
      const Vector<Scalar, 3> first = matrix.row(k), second = matrix.row((k + 1) % 3);
      const Vector<Scalar, 3> normal = first.cross(second);
      if (normal.norm() > null.norm()) null = normal;
    }
    // A solution at infinity leaves round-off in place of its first entry.
    if (std::abs(null[0]) <= Scalar(1e-11) * null.norm()) null[0] = Scalar(0);
    const Vector<Scalar, 3> solution = column.cwiseProduct(null);
    return {solution[1] / solution[0], solution[2] / solution[0]};
  }
};

/// The two roots in Y of the part of the polynomial that is larger; nothing unless they are
/// positive and differ: closer than 1e−5 of Y they are a cusp, or a loop that round-off closes (of
/// size 1e−15, the third power). A first or last coefficient that is round-off of its terms puts
/// one of them at 0 or ∞: that is an `end`, or no pair at all.
template <class Scalar>
std::optional<DoubleNeimarkSacker<Scalar>> pair_squares(const RootPairCurve<Scalar>& curve,
                                                        const PdGains<Scalar>& gains) {
  const auto at_gains = [&gains](const auto& base, const auto& p, const auto& d) {
    const Vector<Scalar, 3> first = gains.proportional * p, second = gains.differential * d;
    const Vector<Scalar, 3> terms = base.cwiseAbs() + first.cwiseAbs() + second.cwiseAbs();
    constexpr Scalar round_off = Scalar(64) * std::numeric_limits<Scalar>::epsilon();
    Vector<Scalar, 3> sum = base + first + second;
    for (int k : {0, 2}) {
      if (std::abs(sum[k]) <= round_off * terms[k]) sum[k] = Scalar(0);
    }
    return sum;
  };
  const Vector<Scalar, 3> even =
      at_gains(curve.base().even, curve.proportional().even, curve.differential().even);
  const Vector<Scalar, 3> odd =
      at_gains(curve.base().odd, curve.proportional().odd, curve.differential().odd);
  const Vector<Scalar, 3>& c = even.squaredNorm() > odd.squaredNorm() ? even : odd;
  const Scalar discriminant = c[1] * c[1] - Scalar(4) * c[0] * c[2];
  if (!(discriminant > Scalar(1e-10) * c[1] * c[1])) return std::nullopt;
  // Equal signs are added: −c₁ and the square root never cancel.
  const Scalar sum =
      -c[1] + (c[1] < Scalar(0) ? std::sqrt(discriminant) : -std::sqrt(discriminant));
  const Scalar first = sum / (Scalar(2) * c[2]), second = Scalar(2) * c[0] / sum;
  if (!(first > Scalar(0) && second > Scalar(0) && std::isfinite(first + second))) {
    return std::nullopt;
  }
  return DoubleNeimarkSacker<Scalar>{gains, std::min(first, second), std::max(first, second)};
}

}  // namespace detail

/// All points at which the curve of root pairs meets itself: at most three.
///
/// Two pairs ±iy₁, ±iy₂ leave room for one more root (none when the degree is 4), so that the
/// polynomial is (1 + νw) e(−w²) with e(Y) ∝ (Y − Y₁)(Y − Y₂): its odd part is ν times its even
/// part, coefficient by coefficient. With the even and the odd part linear in (1, P, D) this is a
/// generalised eigenvalue problem of order 3,
///
///     (ν E − O) (1, P, D)ᵀ = 0,   det(ν E − O) = 0
///
/// a cubic in ν, so that none can be missed. Where the curve is retraced as a whole (no damping:
/// D = 0 twice, once for each pair) its points are not isolated, and there are none to give.
template <class Scalar>
std::vector<DoubleNeimarkSacker<Scalar>> double_neimark_sacker_points(
    const RootPairCurve<Scalar>& curve) {
  const detail::ParityPencil<Scalar> pencil(curve);
  std::vector<DoubleNeimarkSacker<Scalar>> result;
  for (const auto& ratio : roots(pencil.determinant())) {
    if (std::abs(ratio.imag()) > Scalar(1e-6) * std::abs(ratio.real())) continue;
    const auto pair = detail::pair_squares(curve, pencil.gains(ratio.real()));
    if (pair) result.push_back(*pair);
  }
  return result;
}

}  // namespace holdfast
