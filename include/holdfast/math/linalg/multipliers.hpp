#pragma once

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <vector>

#include "holdfast/core/types.hpp"
#include "holdfast/math/linalg/eigenvalues.hpp"

namespace holdfast {

/// An eigenvalue of a product of many matrices, by its logarithm since it may be far below the
/// range of the number type.
struct Multiplier {
  double log_modulus;  ///< ln |λ|; −∞ for a null direction
  double angle;        ///< arg λ (rad), in (−π, π]

  /// λ itself; 0 where it is below the smallest number.
  std::complex<double> value() const { return std::polar(std::exp(log_modulus), angle); }
};

namespace detail {

/// The product R = R_K … R₁ of upper triangular matrices as D U with D = diag(± e^{l_i}) and U of
/// unit diagonal, so that no entry leaves the range of numbers.
template <class Scalar>
struct ScaledTriangle {
  Vector<Scalar, 5> logarithms = Vector<Scalar, 5>::Zero();
  Vector<Scalar, 5> signs = Vector<Scalar, 5>::Ones();
  Matrix<Scalar, 5> unit = Matrix<Scalar, 5>::Identity();
  int rank = 5;  ///< leading rows that no map takes to zero

  /// R ← next · R. A diagonal entry below the round-off of `size` ends the rank.
  void multiply_from_left(const Matrix<Scalar, 5>& next, const Scalar& size) {
    const Scalar round_off = Scalar(8) * std::numeric_limits<Scalar>::epsilon() * size;
    for (int i = 0; i < rank; ++i) {
      if (std::abs(next(i, i)) > round_off) continue;
      rank = i;
      break;
    }
    Matrix<Scalar, 5> inner = Matrix<Scalar, 5>::Identity();
    for (int i = 0; i < rank; ++i) {
      for (int j = i + 1; j < rank; ++j)
        inner(i, j) =
            next(i, j) / next(i, i) * signs[i] * signs[j] * std::exp(logarithms[j] - logarithms[i]);
    }
    unit = inner * unit;
    for (int i = 0; i < rank; ++i) {
      logarithms[i] += std::log(std::abs(next(i, i)));
      if (next(i, i) < 0.0) signs[i] = -signs[i];
    }
  }
};

/// An orthogonal matrix whose columns lie in no special position, so that no coordinate axis that
/// the maps keep is mistaken for the leading direction.
template <class Scalar>
Matrix<Scalar, 5> generic_basis() {
  Matrix<Scalar, 5> dense;
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 5; ++j)
      dense(i, j) = Scalar(std::cos(1.0 + 3.0 * i + 7.0 * j + 1.3 * i * j));
  return Eigen::HouseholderQR<Matrix<Scalar, 5>>(dense).householderQ();
}

/// One turn of orthogonal iteration around the period: Q ← the orthogonal factor after the last
/// map.
template <class Scalar>
ScaledTriangle<Scalar> turn_basis(const std::vector<Matrix<Scalar, 5>>& maps,
                                  Matrix<Scalar, 5>& basis) {
  ScaledTriangle<Scalar> triangle;
  for (const Matrix<Scalar, 5>& map : maps) {
    const Matrix<Scalar, 5> stretched = map * basis;
    const Eigen::HouseholderQR<Matrix<Scalar, 5>> qr(stretched);
    basis = qr.householderQ();
    const Matrix<Scalar, 5> upper = qr.matrixQR().template triangularView<Eigen::Upper>();
    triangle.multiply_from_left(upper, map.norm());
  }
  return triangle;
}

/// Whether the first `leading` directions turn among themselves: what the turn W = Q₀ᵀQ_N mixes
/// into the others is small.
template <class Scalar>
bool decoupled(const Matrix<Scalar, 5>& turn, int leading) {
  return turn.bottomLeftCorner(5 - leading, leading).cwiseAbs().maxCoeff() < Scalar(1e-10);
}

/// Eigenvalues of rows and columns first … last − 1 of W D U.
template <class Scalar>
void append_multipliers(const Matrix<Scalar, 5>& turn, const ScaledTriangle<Scalar>& triangle,
                        int first, int last, std::vector<Multiplier>& multipliers) {
  using Block = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic, 0, 5, 5>;
  const int size = last - first;
  const Scalar scale = triangle.logarithms[first];
  Block stretch = triangle.unit.block(first, first, size, size);
  for (int i = 0; i < size; ++i)
    stretch.row(i) *= triangle.signs[first + i] * std::exp(triangle.logarithms[first + i] - scale);
  const Block block = turn.block(first, first, size, size) * stretch;
  for (const std::complex<Scalar>& value : eigenvalues(block))
    multipliers.push_back({static_cast<double>(scale + std::log(std::abs(value))),
                           static_cast<double>(std::arg(value))});
}

}  // namespace detail

/// The eigenvalues of M = M_K … M₁, largest first, without forming it.
///
/// Orthogonal iteration around the period, Q₀ → Q_K with M_k Q_{k−1} = Q_k R_k, brings M to
/// Q₀ᵀ M Q₀ = (Q₀ᵀQ_K) R_K … R₁, where Q₀ᵀQ_K falls into diagonal blocks for the groups of
/// eigenvalues whose moduli are apart. Each block is scaled by its own exponent, so that a modulus
/// of 10⁻³⁰⁰⁰ is found as well as one of 0.9.
/// @param maps  at least one; each well enough conditioned to be factorised alone
/// @return five; those of null directions have log_modulus −∞
template <class Scalar = double>
std::vector<Multiplier> multipliers_of_product(const std::vector<Matrix<Scalar, 5>>& maps) {
  constexpr int most_turns = 40;
  Matrix<Scalar, 5> basis = detail::generic_basis<Scalar>(), turn;
  detail::ScaledTriangle<Scalar> triangle;
  for (int count = 0; count < most_turns; ++count) {
    const Matrix<Scalar, 5> before = basis;
    triangle = detail::turn_basis(maps, basis);
    turn = before.transpose() * basis;
    // Most often a pair is left that no further turn separates.
    const bool settled = detail::decoupled(turn, 1) || detail::decoupled(turn, 2);
    if (count > 1 && settled &&
        (triangle.rank < 4 || detail::decoupled(turn, 3) || detail::decoupled(turn, 4)))
      break;
  }
  std::vector<Multiplier> multipliers;
  int first = 0;
  for (int last = 1; last <= triangle.rank; ++last) {
    if (last < triangle.rank && !detail::decoupled(turn, last)) continue;
    detail::append_multipliers(turn, triangle, first, last, multipliers);
    first = last;
  }
  while (multipliers.size() < 5)
    multipliers.push_back({-std::numeric_limits<double>::infinity(), 0.0});
  std::stable_sort(multipliers.begin(), multipliers.end(),
                   [](const auto& a, const auto& b) { return a.log_modulus > b.log_modulus; });
  return multipliers;
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template std::vector<Multiplier> multipliers_of_product(
    const std::vector<Matrix<double, 5>>&);
#endif

}  // namespace holdfast
