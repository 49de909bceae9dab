#pragma once

#include <Eigen/LU>
#include <cstddef>
#include <limits>
#include <vector>

#include "holdfast/core/types.hpp"
#include "holdfast/math/linalg/reflections.hpp"

namespace holdfast {

/// Products of successive sample maps, in blocks short enough that no product loses digits.
/// @tparam Map  type of a map, N × N
template <class Map>
class BlockProducts {
 public:
  /// @param most  largest number of samples in a block, ≥ 1, which a product entry ≥ 1000 also ends
  explicit BlockProducts(std::size_t most) : most_(most), length_(most) {}

  /// Adds the map of the next sample.
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
  std::size_t most_, length_;  // samples: of a block at most, of the last one
  std::vector<Map> blocks_;
};

/// A step of Newton's method towards a periodic motion: applies (I − M)⁻¹, where M = M_{K−1} … M₀
/// is the product of the maps that linearise the motion block by block. For an affine motion the
/// first step is already exact up to rounding.
///
/// The equations x_{k+1} = M_k x_k are one block-bidiagonal system. The inner unknowns x_k are
/// eliminated in turn by orthogonal factorisations of their coefficients B and −M_k,
///
///     Qᵀ [B; −M_k] = [R; 0],
///
/// after which the lower rows do not contain x_k. The equation first · x₀ + last · x_K = 0 remains.
/// M, whose entries may span hundreds of decades, is never formed. Source: S. J. Wright, Stable
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

  /// Whether 1 is a multiplier to working precision: no periodic motion exists, or infinitely many.
  bool is_singular() const {
    const Scalar smallest_pivot = closed_.matrixLU().diagonal().cwiseAbs().minCoeff();
    const Scalar rounding = Scalar(64) * std::numeric_limits<Scalar>::epsilon();
    return !(smallest_pivot > rounding * closed_.maxPivot());
  }

  /// The correction (I − M)⁻¹ (x_K − x₀) of the first state x₀, which closes the motion.
  /// @param open  closure error x_K − x₀ of the motion
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
