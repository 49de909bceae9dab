#pragma once

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "holdfast/cable/bar_chain.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/plant/modal_plant.hpp"

namespace holdfast {

/// Mass that hangs on a cable at the absorber's place.
struct HungMass {
  double weight;          ///< kg, ≥ 0: under its weight the cable is at rest
  double sideways = 0.0;  ///< kg, ≥ 0: what of it has to go along the span with the cable
};

/// How the mass of a bar lies on its two nodes.
enum class BarMass {
  lumped,    ///< half of it on each, as in `CableElements`: waves run too slowly, by (kl)²/24
  averaged,  ///< of that and of what moves linearly between them the mean: by (kl)⁴/480
};

/// A hanging cable as the absorber's place sees it.
struct CablePlaceModes {
  EquilibriumOutcome outcome;            ///< of the equilibrium
  std::vector<PlaceMode<double>> modes;  ///< ascending ω; none without an equilibrium
  int apart = 0;                         ///< so many are modes, those behind bundles of modes
};

namespace detail {

/// Lanczos' process on K⁻¹M in the inner product of K, from where a unit force brings the cable:
/// the receptance there is its deflection times the first entry of (I + s²T)⁻¹, T tridiagonal.
/// Every vector is orthogonalised against all before it, twice where the first time cancels much.
template <class Real>
class FlexibilityLanczos {
 public:
  using Column = Vector<Real, Eigen::Dynamic>;
  using Square = Matrix<Real, Eigen::Dynamic>;

  /// @param stiffness  K, positive definite
  /// @param masses     M
  /// @param degree     of freedom that the force acts on
  /// @param steps      the size of T, unless the force reaches fewer motions
  FlexibilityLanczos(const Eigen::SparseMatrix<Real>& stiffness,
                     const Eigen::SparseMatrix<Real>& masses, Eigen::Index degree,
                     Eigen::Index steps)
      : diagonal_(steps), beside_(steps) {
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<Real>> solver(stiffness);
    const Eigen::Index size = stiffness.rows();
    Square basis(size, steps), pressed(size, steps);  // q and K q
    Column next = solver.solve(Column::Unit(size, degree));
    deflection_ = next[degree];
    Real norm = std::sqrt(deflection_);
    do {
      basis.col(count_) = next / norm;
      pressed.col(count_) = stiffness * basis.col(count_);
      const Column inertia = masses * basis.col(count_);
      diagonal_[count_] = inertia.dot(basis.col(count_));
      next = solver.solve(inertia);
      const Eigen::Index known = count_ + 1;
      Real before;
      int passes = 0;
      do {
        before = next.norm();
        next -= basis.leftCols(known) * (pressed.leftCols(known).transpose() * next).eval();
      } while (++passes < 2 && next.norm() < 0.1 * before);
      norm = std::sqrt(std::fmax(next.dot(stiffness * next), 0.0));
      beside_[count_++] = norm;
    } while (count_ < steps && norm > 1e-12 * diagonal_[0]);
  }

  /// m/N, under a unit force.
  Real deflection() const { return deflection_; }
  /// Remainder of T: the entry beside its last.
  Real remainder() const { return beside_[count_ - 1]; }
  /// The eigenvalues 1/ω² (s²) and eigenvectors of T.
  Eigen::SelfAdjointEigenSolver<Square> eigen() const {
    Eigen::SelfAdjointEigenSolver<Square> solver;
    solver.computeFromTridiagonal(diagonal_.head(count_), beside_.head(count_ - 1));
    return solver;
  }

 private:
  Column diagonal_, beside_;
  Eigen::Index count_ = 0;
  Real deflection_;
};

/// M (kg) of the free nodes, with the dofs x, y of each in turn.
template <class Real>
Eigen::SparseMatrix<Real> mass_matrix(const BasicBarChain<Real>& chain, BarMass mass) {
  const Eigen::Index size = 2 * chain.free_nodes();
  const Real across = mass == BarMass::averaged ? 1.0 / 12.0 : 0.0;  // of a bar's mass
  std::vector<Eigen::Triplet<Real>> entries;
  for (int node = 0; node < chain.free_nodes(); ++node) {
    const Real here = chain.mass(node) * (1.0 - 2.0 * across);
    const Real beside = across * chain.conductor().mass_per_length * chain.length(node + 1);
    for (int i = 2 * node; i < 2 * node + 2; ++i) {
      entries.emplace_back(i, i, here);
      if (i + 2 >= size) continue;
      entries.emplace_back(i, i + 2, beside);
      entries.emplace_back(i + 2, i, beside);
    }
  }
  Eigen::SparseMatrix<Real> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

/// Damps each bundle over its width, half of the way to its neighbours on either side.
inline void widen_bundles(std::vector<PlaceMode<double>>& modes, const std::vector<bool>& apart) {
  for (std::size_t n = 1; n < modes.size(); ++n) {
    if (apart[n]) continue;
    const double here = modes[n].angular_frequency;
    const double lower = std::sqrt(modes[n - 1].angular_frequency / here);
    const double upper =
        n + 1 < modes.size() ? std::sqrt(modes[n + 1].angular_frequency / here) : 1.0 / lower;
    modes[n].damping_ratio = 0.5 * (upper - lower);
  }
}

}  // namespace detail

/// The modes of a hanging cable about its equilibrium with the absorber's weight, as the absorber's
/// node sees them moving up and down, without damping:
///
///     H(s) = eᵀ (K + s²M)⁻¹ e ≈ Σ φ_n² / (s² + ω_n²),
///
/// K the tangent stiffness of the bars, M their masses. `steps` steps of Lanczos' process
/// keep the first 2·`steps` moments of H about s = 0 exactly: the slow modes come out as they are,
/// and the fast ones, however many bars, in bundles that are ever wider, in which no mode is lost.
/// A mode counts as one where Lanczos leaves less than 10⁻⁷ of 1/ω². A bundle is damped over its
/// width, so that the waves of its modes go out and do not come back. Modes with a node at the
/// place do not appear. Work: O(bars · steps²).
/// @tparam Real  `double`; a parameter so that it is compiled only where it is used
/// @param chain  the cable's bars, of which the fastest wave of interest needs six or more
/// @param hung   what loads the absorber's node
/// @param steps  1 … 2(N − 1) of N bars
/// @param mass   how the bars' mass lies on the nodes
/// @throws InvalidParameter for masses or steps that are not admissible
template <class Real>
CablePlaceModes cable_place_modes(const BasicBarChain<Real>& chain, const HungMass& hung, int steps,
                                  BarMass mass = BarMass::averaged) {
  require_non_negative("hanging mass", hung.weight, "kg");
  require_non_negative("mass that goes sideways", hung.sideways, "kg");
  require_within("number of Lanczos steps", steps, "", 1, 2.0 * chain.free_nodes());
  const ChainEquilibrium rest = chain_equilibrium(chain, hung.weight * chain.conductor().gravity);
  CablePlaceModes found{rest.outcome, {}};
  if (rest.outcome != EquilibriumOutcome::converged) return found;
  Eigen::SparseMatrix<Real> masses = detail::mass_matrix(chain, mass);
  const Eigen::Index along = 2 * chain.loaded_node();
  masses.coeffRef(along, along) += hung.sideways;
  const detail::FlexibilityLanczos<Real> lanczos(tangent_stiffness(chain, rest.nodes), masses,
                                                 along + 1, steps);
  const auto eigen = lanczos.eigen();
  const auto& vectors = eigen.eigenvectors();
  std::vector<bool> apart;
  for (Eigen::Index n = vectors.cols() - 1; n >= 0; --n) {
    const Real flexibility = eigen.eigenvalues()[n];
    if (!(flexibility > 1e-15 * eigen.eigenvalues()[vectors.cols() - 1])) break;  // round-off
    const Real shape = vectors(0, n) * std::sqrt(lanczos.deflection() / flexibility);
    found.modes.push_back({1.0 / std::sqrt(flexibility), 0.0, shape, 1.0});
    const Real left = lanczos.remainder() * vectors(vectors.rows() - 1, n);
    apart.push_back(std::abs(left) < 1e-7 * flexibility);
  }
  detail::widen_bundles(found.modes, apart);
  found.apart = static_cast<int>(std::find(apart.begin(), apart.end(), false) - apart.begin());
  return found;
}

}  // namespace holdfast
