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

/// Masses attached to the cable's node at the absorber.
struct HungMass {
  double weight;  ///< mass m (kg), ≥ 0, that has the weight m g but no inertia in the model
  double sideways = 0.0;  ///< mass (kg), ≥ 0, that has inertia along the span only, and no weight
};

/// Mass matrix of a bar. Each entry states the relative error of the wave speed, at the wavenumber
/// k (rad/m) with bars of length l (m).
enum class BarMass {
  lumped,    ///< half the mass on each node, as in `CableElements`; waves too slow by (kl)²/24
  averaged,  ///< mean of the lumped and the consistent mass matrix; waves too slow by (kl)⁴/480
};

/// Result of cable_place_modes(): modes of a hanging cable with their shapes at the absorber. A
/// bundle is one mode that replaces several high modes of the cable.
struct CablePlaceModes {
  EquilibriumOutcome outcome;            ///< whether the equilibrium was found
  std::vector<PlaceMode<double>> modes;  ///< modes by ascending ω; empty without an equilibrium
  int apart = 0;                         ///< number of modes below the first bundle
};

namespace detail {

/// Lanczos' process on C⁻¹MC⁻ᵀ, with the stiffness K = CCᵀ and the masses M, started from C⁻¹e with
/// a unit force e. The result is a tridiagonal matrix T (s²): the receptance is the static one
/// times the (1, 1) entry of (I + s²T)⁻¹. Each vector is made orthogonal to its two predecessors,
/// then to all: one pass is enough unless it changes the vector's length.
template <class Real>
class FlexibilityLanczos {
 public:
  using Column = Vector<Real, Eigen::Dynamic>;
  using Square = Matrix<Real, Eigen::Dynamic>;

  /// @param degree  index of the degree of freedom on which the force acts
  /// @param steps   size of T; T is smaller if the force excites fewer modes
  FlexibilityLanczos(const Eigen::SparseMatrix<Real>& stiffness,
                     const Eigen::SparseMatrix<Real>& masses, Eigen::Index degree,
                     Eigen::Index steps)
      : diagonal_(steps), beside_(steps) {
    const Eigen::SimplicialLLT<Eigen::SparseMatrix<Real>> root(stiffness);
    const Eigen::Index size = stiffness.rows();
    Square basis = Square::Zero(size, (steps + 3) / 4 * 4);
    Column next = root.matrixL().solve(root.permutationP() * Column::Unit(size, degree));
    deflection_ = next.squaredNorm();
    Real norm = next.norm();
    do {
      basis.col(count_) = next / norm;
      const Column shape = root.permutationPinv() * root.matrixU().solve(basis.col(count_)).eval();
      const Column inertia = masses * shape;
      diagonal_[count_] = shape.dot(inertia);
      next = root.matrixL().solve(root.permutationP() * inertia);
      next -= diagonal_[count_] * basis.col(count_);
      if (count_ > 0) next -= norm * basis.col(count_ - 1);
      Real before;
      int passes = 0;
      do {
        before = next.norm();
        const Column shares = basis.leftCols(count_ / 4 * 4 + 4).transpose() * next;
        // Four columns at a time: a product with the whole basis takes twice as long.
        for (Eigen::Index k = 0; k <= count_; k += 4)
          next -= shares[k] * basis.col(k) + shares[k + 1] * basis.col(k + 1) +
                  shares[k + 2] * basis.col(k + 2) + shares[k + 3] * basis.col(k + 3);
      } while (++passes < 2 && next.norm() < 0.1 * before);
      norm = next.norm();
      beside_[count_++] = norm;
    } while (count_ < steps && norm > 1e-12 * diagonal_[0]);
  }

  /// Static receptance (m/N): the deflection under a unit force.
  Real deflection() const { return deflection_; }
  /// Off-diagonal entry (s²) that the next step of Lanczos' process would add to T.
  Real remainder() const { return beside_[count_ - 1]; }
  /// Eigenvalues 1/ω² (s²) and eigenvectors of the tridiagonal matrix T.
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

/// Mass matrix M (kg) of the free nodes, with the degrees of freedom x, y of each node in turn.
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

/// Sets the damping ratio of each bundle, a mode not in `apart`, to half the relative width of its
/// band. The band ends at the geometric means of the frequencies of adjacent modes.
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

/// Modes of an undamped hanging cable about its equilibrium with the weight on the absorber's node.
/// The angular frequencies ω_n (rad/s) and the vertical shapes φ_n at this node, for modal masses
/// of 1 kg, approximate the vertical receptance H (m/N) of the node at the complex frequency s:
///
///     H(s) = eᵀ (K + s²M)⁻¹ e ≈ Σ φ_n² / (s² + ω_n²).
///
/// K is the tangent stiffness and M the mass matrix of the bars; M includes `hung.sideways`. e is
/// the vertical unit vector at the node. A Lanczos process of `steps` steps reproduces the first
/// 2·`steps` coefficients of H in powers of s². The lowest results are modes of the cable. A higher
/// result may be a bundle: one mode that replaces several modes of the cable. It is a bundle if its
/// Lanczos residual is at least 10⁻⁷/ω_n². Its damping ratio is half its relative bandwidth, so
/// that no wave returns to the node. Modes with φ_n = 0 are left out. Work: O(bars · steps²).
/// @tparam Real  number type, always `double`; as a template it is compiled only where used
/// @param chain  the cable's bars, at least six per shortest wavelength of interest
/// @param hung   masses on the absorber's node
/// @param steps  number of Lanczos steps, 1 … 2(N − 1) for N bars
/// @param mass   mass matrix of the bars
/// @throws InvalidParameter for a negative mass, or a number of steps outside its range
template <class Real>
CablePlaceModes cable_place_modes(const BasicBarChain<Real>& chain, const HungMass& hung, int steps,
                                  BarMass mass = BarMass::averaged) {
  require_non_negative("hanging mass", hung.weight, "kg");
  require_non_negative("hung mass that takes part in motion along the span", hung.sideways, "kg");
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
