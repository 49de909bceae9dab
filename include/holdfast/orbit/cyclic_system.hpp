#pragma once

#include <Eigen/LU>
#include <cstddef>
#include <limits>
#include <vector>

#include "holdfast/core/types.hpp"
#include "holdfast/math/linalg/reflections.hpp"

namespace holdfast {

/// Products of the matrices of successive samples, in blocks short enough to keep all digits.
/// @tparam Map  type of a map, N × N
template <class Map>
class BlockProducts {
 public:
  /// @param most  largest number of samples in a block, ≥ 1. A block also ends when an entry of its
  ///              product reaches 1000.
  explicit BlockProducts(std::size_t most) : most_(most), length_(most) {}

  /// Multiplies the last block by the map of the next sample, or starts a new block.
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

/// The linear solver for a Newton step towards a periodic motion: it applies (I − M)⁻¹. M = M_{K−1}
/// … M₀ is the product of the maps M_k of deviations x over the K blocks of one period. For an
/// affine motion the first Newton step is exact up to rounding.
///
/// The equations x_{k+1} = M_k x_k form a block-bidiagonal system. The inner unknowns x₁ … x_{K−1}
/// are eliminated in turn. If B is the present coefficient of x_k, an orthogonal factorisation
///
///     Qᵀ [B; −M_k] = [R; 0]
///
/// gives lower rows without x_k. At the end one equation between x₀ and x_K remains. M itself,
/// whose entries may span hundreds of decades, is never formed. Source: S. J. Wright, Stable
/// parallel algorithms for two-point boundary value problems, SIAM J. Sci. Stat. Comput. 13 (1992).
///
///     const CyclicSystem<double> system(maps);
///     if (!system.is_singular()) x += system.correction(open);
/// @tparam Size  size N of x; 5 for z̃ = [z; u_{j−1}]
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

  /// The correction (I − M)⁻¹ · `open`. Added to the first state, it closes the linearised motion.
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
