#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <vector>

#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/math/linalg/eigenvalues.hpp"
#include "holdfast/math/linalg/reflections.hpp"

namespace holdfast {

/// An eigenvalue λ of a product of many matrices, for instance a Floquet multiplier. Its logarithm
/// ln |λ| is stored, since |λ| may underflow.
struct Multiplier {
  double log_modulus;  ///< logarithm ln |λ|; −∞ for λ = 0
  double angle;        ///< argument arg λ (rad), in (−π, π]

  /// The eigenvalue λ = e^{ln |λ| + i arg λ}; 0 where it underflows.
  std::complex<double> value() const { return std::polar(std::exp(log_modulus), angle); }
  /// Whether the multiplier a has a larger modulus than b.
  static bool is_larger(const Multiplier& a, const Multiplier& b) {
    return a.log_modulus > b.log_modulus;
  }
};

namespace detail {

/// The product R = R_K … R₁ of upper triangular matrices as D U with D = diag(± e^{l_i}) and U of
/// unit diagonal, so that no entry overflows or underflows.
template <class Scalar, int Size>
struct ScaledTriangle {
  Vector<Scalar, Size> logarithms, signs;
  Matrix<Scalar, Size> unit;
  Eigen::Index rank;  ///< number of leading directions that no map annihilates

  /// Constructs the unit matrix, order × order.
  explicit ScaledTriangle(Eigen::Index order)
      : logarithms(Vector<Scalar, Size>::Zero(order)),
        signs(Vector<Scalar, Size>::Ones(order)),
        unit(Matrix<Scalar, Size>::Identity(order, order)),
        rank(order) {}

  /// Replaces R by next · R. The rank drops to i at the first |next_ii| below round-off of `size`.
  void multiply_from_left(const Matrix<Scalar, Size>& next, const Scalar& size) {
    const Scalar round_off = Scalar(8) * std::numeric_limits<Scalar>::epsilon() * size;
    for (Eigen::Index i = 0; i < rank; ++i) {
      if (std::abs(next(i, i)) > round_off) continue;
      rank = i;
      break;
    }
    Matrix<Scalar, Size> inner = Matrix<Scalar, Size>::Identity(unit.rows(), unit.cols());
    for (Eigen::Index i = 0; i < rank; ++i) {
      for (Eigen::Index j = i + 1; j < rank; ++j)
        inner(i, j) =
            next(i, j) / next(i, i) * signs[i] * signs[j] * std::exp(logarithms[j] - logarithms[i]);
    }
    unit = inner * unit;
    for (Eigen::Index i = 0; i < rank; ++i) {
      logarithms[i] += std::log(std::abs(next(i, i)));
      if (next(i, i) < 0.0) signs[i] = -signs[i];
    }
  }
};

/// Columns in general position, so that no invariant axis is mistaken for the leading direction.
template <class Columns>
Columns generic_columns(Eigen::Index rows, Eigen::Index columns) {
  Columns dense(rows, columns);
  for (Eigen::Index i = 0; i < rows; ++i)
    for (Eigen::Index j = 0; j < columns; ++j) {
      const auto row = static_cast<double>(i), column = static_cast<double>(j);
      dense(i, j) =
          typename Columns::Scalar(std::cos(1.0 + 3.0 * row + 7.0 * column + 1.3 * row * column));
    }
  return dense;
}

/// Maps the basis Q through one period, orthonormalising it. @return product of triangular factors
template <class Scalar, int Size>
ScaledTriangle<Scalar, Size> turn_basis(const std::vector<Matrix<Scalar, Size>>& maps,
                                        Matrix<Scalar, Size>& basis) {
  ScaledTriangle<Scalar, Size> triangle(basis.rows());
  for (const Matrix<Scalar, Size>& map : maps) {
    Matrix<Scalar, Size> upper = map * basis;
    basis = orthogonal_factor(upper);
    triangle.multiply_from_left(upper, map.norm());
  }
  return triangle;
}

/// Whether the first `leading` directions are invariant: the block of the rotation W = Q₀ᵀQ_K that
/// mixes them with the other directions is small.
template <class Scalar, int Size>
bool decoupled(const Matrix<Scalar, Size>& turn, Eigen::Index leading) {
  const Eigen::Index others = turn.rows() - leading;
  return others == 0 ||
         turn.bottomLeftCorner(others, leading).cwiseAbs().maxCoeff() < Scalar(1e-10);
}

/// Whether W leaves the first k or the first k + 1 directions invariant, for every odd k. One of
/// the two suffices, since the directions of a conjugate pair usually stay coupled forever.
template <class Scalar, int Size>
bool settled(const Matrix<Scalar, Size>& turn, Eigen::Index rank) {
  for (Eigen::Index k = 1; k == 1 || k < rank; k += 2)
    if (!decoupled(turn, k) && !decoupled(turn, k + 1)) return false;
  return true;
}

/// Appends the eigenvalues of the diagonal block first … last − 1 of W D U; D U is `triangle`.
template <class Scalar, int Size>
void append_multipliers(const Matrix<Scalar, Size>& turn,
                        const ScaledTriangle<Scalar, Size>& triangle, Eigen::Index first,
                        Eigen::Index last, std::vector<Multiplier>& multipliers) {
  using Block = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic, 0, Size, Size>;
  const Eigen::Index size = last - first;
  const Scalar scale = triangle.logarithms[first];
  Block stretch = triangle.unit.block(first, first, size, size);
  for (Eigen::Index i = 0; i < size; ++i)
    stretch.row(i) *= triangle.signs[first + i] * std::exp(triangle.logarithms[first + i] - scale);
  const Block block = turn.block(first, first, size, size) * stretch;
  for (const std::complex<Scalar>& value : eigenvalues(block))
    multipliers.push_back({static_cast<double>(scale + std::log(std::abs(value))),
                           static_cast<double>(std::arg(value))});
}

/// The eigenvalues of W D U, by descending modulus.
/// @param turn  rotation W = Q₀ᵀQ_K
template <class Scalar, int Size>
std::vector<Multiplier> multipliers_of_turn(const Matrix<Scalar, Size>& turn,
                                            const ScaledTriangle<Scalar, Size>& triangle) {
  std::vector<Multiplier> multipliers;
  Eigen::Index first = 0;
  for (Eigen::Index last = 1; last <= triangle.rank; ++last) {
    if (last < triangle.rank && !decoupled(turn, last)) continue;
    append_multipliers(turn, triangle, first, last, multipliers);
    first = last;
  }
  multipliers.resize(static_cast<std::size_t>(turn.rows()),
                     {-std::numeric_limits<double>::infinity(), 0.0});
  std::stable_sort(multipliers.begin(), multipliers.end(), Multiplier::is_larger);
  return multipliers;
}

}  // namespace detail

/// The eigenvalues of a matrix product M = M_K … M₁ by descending modulus; M itself is not formed.
///
/// QR factorisations M_k Q_{k−1} = Q_k R_k give M = Q_K (R_K … R₁) Q₀ᵀ. M is therefore similar to
/// (Q₀ᵀQ_K) R_K … R₁. The factorisations are repeated with Q₀ = Q_K until Q₀ᵀQ_K is block diagonal,
/// one block for each group of eigenvalues of similar modulus. Each block is scaled separately.
/// @param maps  factors M₁ … M_K, M₁ applied first, K ≥ 1, each N × N, N ≥ 2, finite, any rank
/// @return N eigenvalues; a zero eigenvalue has log_modulus −∞
/// @throws InvalidParameter if the list of factors is empty, or their sizes disagree
template <class Scalar = double, int Size = 5>
std::vector<Multiplier> multipliers_of_product(const std::vector<Matrix<Scalar, Size>>& maps) {
  constexpr int most_turns = 40;
  require_positive("number of maps", static_cast<double>(maps.size()), "");
  for (const Matrix<Scalar, Size>& map : maps) {
    require_size("rows of a map", map.rows(), maps.front().rows());
    require_size("columns of a map", map.cols(), maps.front().rows());
  }
  const Eigen::Index order = maps.front().rows();
  auto dense = detail::generic_columns<Matrix<Scalar, Size>>(order, order);
  Matrix<Scalar, Size> basis = orthogonal_factor(dense), turn;
  detail::ScaledTriangle<Scalar, Size> triangle(order);
  for (int count = 0; count < most_turns; ++count) {
    const Matrix<Scalar, Size> before = basis;
    triangle = detail::turn_basis(maps, basis);
    turn = before.transpose() * basis;
    if (count > 1 && detail::settled(turn, triangle.rank)) break;
  }
  return detail::multipliers_of_turn(turn, triangle);
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template std::vector<Multiplier> multipliers_of_product(
    const std::vector<Matrix<double, 5>>&);
extern template std::vector<Multiplier> multipliers_of_product(const std::vector<Eigen::MatrixXd>&);
extern template std::vector<Multiplier> detail::multipliers_of_turn(
    const Eigen::MatrixXd&, const detail::ScaledTriangle<double, Eigen::Dynamic>&);
#endif

}  // namespace holdfast
