#pragma once

#include <Eigen/LU>
#include <cstddef>
#include <limits>
#include <vector>

#include "holdfast/core/types.hpp"
#include "holdfast/math/linalg/reflections.hpp"

namespace holdfast {

/// Groups the matrices of successive samples in blocks and computes the product of each block. The
/// blocks are short enough for the products to keep their digits. @tparam Map  N × N matrix
template <class Map>
class BlockProducts {
 public:
  /// @param most  largest number of samples in a block, ≥ 1. A block also ends when an entry of its
  ///              product reaches 1000.
  explicit BlockProducts(std::size_t most) : most_(most), length_(most) {}

  /// Appends the matrix of the next sample to the last block, or to a new one if that is complete.
  void append(const Map& map) {
    if (length_ == most_ || !(blocks_.back().cwiseAbs().maxCoeff() < 1e3)) {
      blocks_.push_back(map);
      length_ = 1;
    } else {
      blocks_.back() = map * blocks_.back();
      ++length_;
    }
  }

  /// The products, one for each block, in the order of the samples.
  const std::vector<Map>& blocks() const { return blocks_; }

 private:
  std::size_t most_, length_;  // samples of a block: largest number, number in the last one
  std::vector<Map> blocks_;
};

/// The linear solver for a Newton step towards a periodic motion: it applies (I − M)⁻¹. The matrix
/// M = M_{K−1} … M₀ propagates a deviation x over one period. M_k propagates it over block k of K
/// (BlockProducts). If the motion is affine in x, one Newton step is exact up to rounding.
///
/// The equations x_{k+1} = M_k x_k form a block-bidiagonal system. The inner unknowns x₁ … x_{K−1}
/// are eliminated in turn. If B is the current coefficient of x_k, an orthogonal factorisation
///
///     Qᵀ [B; −M_k] = [R; 0]
///
/// yields an equation without x_k. At the end one equation between x₀ and x_K remains. The product
/// M, with entries that may span hundreds of decades, is never formed. Source: S. J. Wright, Stable
/// parallel algorithms for two-point boundary value problems, SIAM J. Sci. Stat. Comput. 13 (1992).
///
///     const CyclicSystem<double> system(maps);
///     if (!system.is_singular()) x += system.correction(open);
/// @tparam Size  number N of entries of x; 5 for two masses (ItineraryMaps)
template <class Scalar, int Size = 5>
class CyclicSystem {
 public:
  /// @param maps  M_0 … M_{K−1}, N × N, K ≥ 1. Work per map: about 16 N³ multiply-adds.
  explicit CyclicSystem(const std::vector<Matrix<Scalar, Size>>& maps);

  /// Whether 1 is a multiplier (eigenvalue of M) to working precision. Then no periodic motion
  /// exists, or infinitely many do.
  bool is_singular() const {
    const Scalar smallest_pivot = closed_.matrixLU().diagonal().cwiseAbs().minCoeff();
    const Scalar rounding = Scalar(64) * std::numeric_limits<Scalar>::epsilon();
    return !(smallest_pivot > rounding * closed_.maxPivot());
  }

  /// The Newton step (I − M)⁻¹ · `open`, to be added to the first state of the period.
  /// @param open  closure error: last state minus first state of the period
  Vector<Scalar, Size> correction(const Vector<Scalar, Size>& open) const {
    return closed_.solve(last_ * open);
  }

 private:
  Matrix<Scalar, Size> last_;
  Eigen::FullPivLU<Matrix<Scalar, Size>> closed_;  // first + last
};

template <class Scalar, int Size>
CyclicSystem<Scalar, Size>::CyclicSystem(const std::vector<Matrix<Scalar, Size>>& maps) {
  constexpr int twice = Size == Eigen::Dynamic ? Eigen::Dynamic : 2 * Size;
  const Eigen::Index n = maps.front().rows();
  const Matrix<Scalar, Size> identity = Matrix<Scalar, Size>::Identity(n, n);
  Matrix<Scalar, Size> first = -maps.front();
  last_ = identity;
  Matrix<Scalar, twice, Size> inner(2 * n, n);
  Matrix<Scalar, twice> outer(2 * n, 2 * n);
  for (std::size_t k = 1; k < maps.size(); ++k) {
    inner << last_, -maps[k];
    outer.setZero();
    outer.template topLeftCorner<Size, Size>(n, n) = first;
    outer.template bottomRightCorner<Size, Size>(n, n) = identity;
    reflect_to_triangle(inner, outer);
    first = outer.template bottomLeftCorner<Size, Size>(n, n);
    last_ = outer.template bottomRightCorner<Size, Size>(n, n);
  }
  closed_.compute(first + last_);
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template class CyclicSystem<double>;
extern template class CyclicSystem<double, Eigen::Dynamic>;
#endif

}  // namespace holdfast
