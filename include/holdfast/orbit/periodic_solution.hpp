#pragma once

#include <Eigen/LU>
#include <Eigen/QR>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "holdfast/core/types.hpp"
#include "holdfast/orbit/itinerary_maps.hpp"
#include "holdfast/orbit/state_scale.hpp"

namespace holdfast {

/// first · z̃₀ + last · z̃_N = addition: what a sequence of N affine maps says of its two ends.
///
/// The maps z̃_{k+1} = M_k z̃_k + g_k are one block-bidiagonal system. Its inner unknowns are
/// eliminated one after the other by orthogonal factorisations,
///
///     Qᵀ [B; −M_k] = [R; 0],
///
/// whose lower rows do not contain them, so that M = M_{N−1} … M₀, whose entries may span hundreds
/// of decades, is never formed. Source: S. J. Wright, Stable parallel algorithms for two-point
/// boundary value problems, SIAM J. Sci. Stat. Comput. 13 (1992).
template <class Scalar>
struct CondensedBoundary {
  Matrix<Scalar, 5> first;     ///< of z̃₀
  Matrix<Scalar, 5> last;      ///< of z̃_N
  Vector<Scalar, 5> addition;  ///< what the forcing adds on the way
};

/// The condensed boundary condition of a sequence of affine maps, at least one. Work per map: about
/// 2000 multiply-adds.
template <class Scalar>
CondensedBoundary<Scalar> condensed_boundary(const std::vector<AffineMap<Scalar>>& maps) {
  const Matrix<Scalar, 5> identity = Matrix<Scalar, 5>::Identity();
  CondensedBoundary<Scalar> ends{-maps.front().map, identity, maps.front().addition};
  Matrix<Scalar, 10, 5> inner;
  Matrix<Scalar, 10, 11> outer;
  for (std::size_t k = 1; k < maps.size(); ++k) {
    inner << ends.last, -maps[k].map;
    outer.setZero();
    outer.template topLeftCorner<5, 5>() = ends.first;
    outer.template block<5, 5>(5, 5) = identity;
    outer.template block<5, 1>(0, 10) = ends.addition;
    outer.template block<5, 1>(5, 10) = maps[k].addition;
    const Eigen::HouseholderQR<Matrix<Scalar, 10, 5>> qr(inner);
    outer.applyOnTheLeft(qr.householderQ().adjoint());
    ends = {outer.template bottomLeftCorner<5, 5>(), outer.template block<5, 5>(5, 5),
            outer.template bottomRightCorner<5, 1>()};
  }
  return ends;
}

/// The states of a motion that repeats a given itinerary for ever.
template <class Scalar>
struct PeriodicSolution {
  std::vector<Vector<Scalar, 5>> states;  ///< z̃_j = [z_j; u_{j−1}], one for each sample
  Scalar closure_error;  ///< ‖z_N − z₀‖ (SI numbers of m and m/s) after one period from z₀
  /// What that means for z₀ itself, (I − M)⁻¹ (z̃_N − z̃₀), as a share of the states' extent.
  double state_error;
};

namespace detail {

/// All states of the sequence from a given first one, and the state after its last sample.
template <class Scalar>
Vector<Scalar, 5> follow_itinerary(const ItineraryMaps<Scalar>& maps, const Itinerary& itinerary,
                                   std::vector<Vector<Scalar, 5>>& states) {
  std::size_t phase = 0;
  for (std::size_t j = 0; j + 1 < itinerary.size(); ++j) {
    states[j + 1] = maps.step(states[j], itinerary[j] != 0, phase);
    if (++phase == maps.samples_of_forcing()) phase = 0;
  }
  return maps.step(states.back(), itinerary.back() != 0, phase);
}

}  // namespace detail

/// Solves z̃_N = z̃₀ for an itinerary: (I − M) z̃₀ = g without forming M or g.
///
/// The first state comes from the condensed boundary condition; the others follow by the maps
/// themselves, and what is left open after one period is divided out once more.
/// @param maps       of the loop
/// @param itinerary  N samples, N a multiple of the forcing's q, the first one at phase 0
/// @param ends       condensed_boundary() of the sequence's affine_blocks()
/// @return nothing where 1 is a multiplier of the sequence to working precision: then it has no
///         periodic solution, or a continuum of them
template <class Scalar>
std::optional<PeriodicSolution<Scalar>> periodic_solution(const ItineraryMaps<Scalar>& maps,
                                                          const Itinerary& itinerary,
                                                          const CondensedBoundary<Scalar>& ends) {
  const Eigen::FullPivLU<Matrix<Scalar, 5>> closed(ends.first + ends.last);
  const Scalar smallest_pivot = closed.matrixLU().diagonal().cwiseAbs().minCoeff();
  const Scalar rounding = Scalar(64) * std::numeric_limits<Scalar>::epsilon();
  if (!(smallest_pivot > rounding * closed.maxPivot())) return std::nullopt;
  PeriodicSolution<Scalar> solution;
  solution.states.resize(itinerary.size());
  const auto first_state_from = [&](const Vector<Scalar, 5>& addition) -> Vector<Scalar, 5> {
    return maps.units().cwiseProduct(closed.solve(addition));
  };
  solution.states.front() = first_state_from(ends.addition);
  Vector<Scalar, 5> open, correction;
  for (int refinement = 0; refinement < 3; ++refinement) {
    open = detail::follow_itinerary(maps, itinerary, solution.states) - solution.states.front();
    correction = first_state_from(ends.last * open.cwiseQuotient(maps.units()));
    if (refinement < 2) solution.states.front() += correction;
  }
  solution.closure_error = open.template head<4>().norm();
  solution.state_error = StateScale(solution.states).share_of(correction);
  return solution;
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template CondensedBoundary<double> condensed_boundary(const std::vector<AffineMap<double>>&);
extern template std::optional<PeriodicSolution<double>> periodic_solution(
    const ItineraryMaps<double>&, const Itinerary&, const CondensedBoundary<double>&);
#endif

}  // namespace holdfast
