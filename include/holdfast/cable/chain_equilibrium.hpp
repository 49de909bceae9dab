#pragma once

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <cmath>
#include <limits>
#include <vector>

#include "holdfast/cable/bar_chain.hpp"

namespace holdfast {

/// Equilibrium of a bar chain.
struct ChainEquilibrium {
  BarChain::Nodes nodes;       ///< 2 × (N − 1), m
  EquilibriumOutcome outcome;  ///< converged: forces balanced to round-off, every bar in tension
  double unbalanced;           ///< N, largest component of the force that is left at a node
};

/// ∂(internal force)/∂(positions) (N/m), 2(N − 1) square, symmetric, block-tridiagonal, with the
/// dofs x, y of each node in turn; positive definite where all bars are in tension.
template <class Real>
Eigen::SparseMatrix<Real> tangent_stiffness(const BasicBarChain<Real>& chain,
                                            const typename BasicBarChain<Real>::Nodes& nodes) {
  std::vector<Eigen::Triplet<Real>> entries;
  const auto add = [&](int row_node, int column_node, const Matrix<Real, 2>& block) {
    if (row_node < 0 || column_node < 0) return;
    if (row_node >= chain.free_nodes() || column_node >= chain.free_nodes()) return;
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j)
        entries.emplace_back(2 * row_node + i, 2 * column_node + j, block(i, j));
  };
  for (int e = 0; e < chain.elements(); ++e) {
    const Matrix<Real, 2> stiffness =
        bar_stiffness(chain.reach(nodes, e), chain.length(e), chain.axial_stiffness());
    add(e - 1, e - 1, stiffness);
    add(e, e, stiffness);
    add(e - 1, e, -stiffness);
    add(e, e - 1, -stiffness);
  }
  Eigen::SparseMatrix<Real> matrix(2 * chain.free_nodes(), 2 * chain.free_nodes());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

/// The force (N) left at each node by gravity, a load P (N) at the absorber's place and the bars.
template <class Real>
typename BasicBarChain<Real>::Nodes unbalanced_forces(
    const BasicBarChain<Real>& chain, const typename BasicBarChain<Real>::Nodes& nodes,
    double load) {
  using Nodes = typename BasicBarChain<Real>::Nodes;
  Nodes forces = Nodes::Zero(2, chain.free_nodes());
  for (int node = 0; node < chain.free_nodes(); ++node)
    forces(1, node) = chain.mass(node) * chain.conductor().gravity;
  forces(1, chain.loaded_node()) += load;
  for (int e = 0; e < chain.elements(); ++e) {
    const Vector<Real, 2> pull =
        bar_pull<Real>(chain.reach(nodes, e), chain.length(e), chain.axial_stiffness());
    if (e > 0) forces.col(e - 1) += pull;
    if (e < chain.free_nodes()) forces.col(e) -= pull;
  }
  return forces;
}

/// Equilibrium of the chain under gravity and a load P (N, downward) at the absorber's place:
/// Newton's method from the exact catenary, the step halved while it does not lessen the unbalanced
/// force.
template <class Real>
ChainEquilibrium chain_equilibrium(const BasicBarChain<Real>& chain, double load) {
  using Nodes = typename BasicBarChain<Real>::Nodes;
  require_finite("load", load, "N");
  ChainEquilibrium result{chain.catenary_positions(load), EquilibriumOutcome::not_converged, 0.0};
  auto forces = unbalanced_forces(chain, result.nodes, load);
  // A bar's pull is a difference of lengths times EA/l₀: its round-off, not the forces', is what
  // remains.
  const double resolution = 64.0 * std::numeric_limits<double>::epsilon() *
                            (chain.axial_stiffness() * chain.conductor().span / chain.length(0));
  for (int step = 0; step < 60 && forces.norm() > 1e-3 * resolution; ++step) {
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<Real>> solver(
        tangent_stiffness(chain, result.nodes));
    const Vector<Real, Eigen::Dynamic> flat = solver.solve(forces.reshaped());
    Nodes change = flat.reshaped(2, chain.free_nodes());
    bool closer = false;
    for (int halving = 0; halving < 30 && !closer; ++halving, change *= 0.5) {
      const Nodes trial = result.nodes + change;
      const auto left = unbalanced_forces(chain, trial, load);
      closer = left.norm() < forces.norm();
      if (!closer) continue;
      result.nodes = trial;
      forces = left;
    }
    if (!closer) break;
  }
  result.unbalanced = forces.cwiseAbs().maxCoeff();
  if (result.unbalanced <= resolution && chain.smallest_tension(result.nodes) > 0.0)
    result.outcome = EquilibriumOutcome::converged;
  return result;
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template Eigen::SparseMatrix<double> tangent_stiffness(const BarChain&,
                                                              const BarChain::Nodes&);
extern template BarChain::Nodes unbalanced_forces(const BarChain&, const BarChain::Nodes&, double);
extern template ChainEquilibrium chain_equilibrium(const BarChain&, double);
#endif

}  // namespace holdfast
