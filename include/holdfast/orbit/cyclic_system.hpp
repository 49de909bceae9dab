#pragma once

#include <Eigen/LU>
#include <Eigen/QR>
#include <cstddef>
#include <limits>
#include <vector>

#include "holdfast/core/types.hpp"

namespace holdfast {

/// x ↦ map x + addition.
/// @tparam Size  N of x; 5 of z̃ = [z; u_{j−1}]
template <class Scalar, int Size = 5>
struct AffineMap {
  Matrix<Scalar, Size> map;       ///< N × N
  Vector<Scalar, Size> addition;  ///< in the units of x
};

/// first · x₀ + last · x_K = addition: what a sequence of K affine maps says of its two ends.
///
/// The maps x_{k+1} = M_k x_k + g_k are one block-bidiagonal system. Its inner unknowns are
/// eliminated one after the other by orthogonal factorisations,
///
///     Qᵀ [B; −M_k] = [R; 0],
///
/// whose lower rows do not contain them, so that M = M_{K−1} … M₀, whose entries may span hundreds
/// of decades, is never formed. Source: S. J. Wright, Stable parallel algorithms for two-point
/// boundary value problems, SIAM J. Sci. Stat. Comput. 13 (1992).
template <class Scalar, int Size = 5>
struct CondensedBoundary {
  Matrix<Scalar, Size> first;     ///< of x₀
  Matrix<Scalar, Size> last;      ///< of x_K
  Vector<Scalar, Size> addition;  ///< what the maps add on the way
};

/// The condensed boundary condition of a sequence of affine maps, at least one. Work per map: about
/// 16 N³ multiply-adds.
template <class Scalar, int Size>
CondensedBoundary<Scalar, Size> condensed_boundary(
    const std::vector<AffineMap<Scalar, Size>>& maps) {
  constexpr int twice = Size == Eigen::Dynamic ? Eigen::Dynamic : 2 * Size;
  const Eigen::Index n = maps.front().map.rows();
  const Matrix<Scalar, Size> identity = Matrix<Scalar, Size>::Identity(n, n);
  CondensedBoundary<Scalar, Size> ends{-maps.front().map, identity, maps.front().addition};
  Matrix<Scalar, twice, Size> inner(2 * n, n);
  Matrix<Scalar, twice, larger_size(twice, 1)> outer(2 * n, 2 * n + 1);
  for (std::size_t k = 1; k < maps.size(); ++k) {
    inner << ends.last, -maps[k].map;
    outer.setZero();
    outer.template topLeftCorner<Size, Size>(n, n) = ends.first;
    outer.template block<Size, Size>(n, n, n, n) = identity;
    outer.template block<Size, 1>(0, 2 * n, n, 1) = ends.addition;
    outer.template block<Size, 1>(n, 2 * n, n, 1) = maps[k].addition;
    const Eigen::HouseholderQR<Matrix<Scalar, twice, Size>> qr(inner);
    outer.applyOnTheLeft(qr.householderQ().adjoint());
    ends = {outer.template bottomLeftCorner<Size, Size>(n, n),
            outer.template block<Size, Size>(n, n, n, n),
            outer.template block<Size, 1>(n, 2 * n, n, 1)};
  }
  return ends;
}

/// The cyclic system of a sequence of affine maps, x_K = x₀, condensed to its ends.
///
/// Of maps that linearise a motion block by block its solution is a step of Newton's method, solved
/// without the product of the maps; of a motion that is affine the first step leaves rounding
/// alone.
///
///     const CyclicSystem system(maps);
///     if (!system.is_singular()) x = system.first_state();
template <class Scalar, int Size = 5>
class CyclicSystem {
 public:
  /// @param maps  at least one
  explicit CyclicSystem(const std::vector<AffineMap<Scalar, Size>>& maps)
      : ends_(condensed_boundary(maps)), closed_(ends_.first + ends_.last) {}

  /// 1 is a multiplier of the sequence to working precision: no solution, or a continuum of them.
  bool is_singular() const {
    const Scalar smallest_pivot = closed_.matrixLU().diagonal().cwiseAbs().minCoeff();
    const Scalar rounding = Scalar(64) * std::numeric_limits<Scalar>::epsilon();
    return !(smallest_pivot > rounding * closed_.maxPivot());
  }

  /// x₀.
  Vector<Scalar, Size> first_state() const { return closed_.solve(ends_.addition); }

  /// What a motion that these maps linearise is to begin with in addition, to close:
  /// (I − M)⁻¹ open.
  /// @param open  x_K − x₀ of the motion
  Vector<Scalar, Size> correction(const Vector<Scalar, Size>& open) const {
    return closed_.solve(ends_.last * open);
  }

 private:
  CondensedBoundary<Scalar, Size> ends_;
  Eigen::FullPivLU<Matrix<Scalar, Size>> closed_;
};

/// The linear parts of affine maps.
template <class Scalar, int Size>
std::vector<Matrix<Scalar, Size>> maps_of(const std::vector<AffineMap<Scalar, Size>>& blocks) {
  std::vector<Matrix<Scalar, Size>> maps;
  maps.reserve(blocks.size());
  for (const auto& block : blocks) maps.push_back(block.map);
  return maps;
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template CondensedBoundary<double> condensed_boundary(const std::vector<AffineMap<double>>&);
extern template CondensedBoundary<double, Eigen::Dynamic> condensed_boundary(
    const std::vector<AffineMap<double, Eigen::Dynamic>>&);
extern template class CyclicSystem<double>;
extern template class CyclicSystem<double, Eigen::Dynamic>;
#endif

}  // namespace holdfast
