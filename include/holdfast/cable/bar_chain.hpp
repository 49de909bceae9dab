#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "holdfast/cable/hanging_cable.hpp"
#include "holdfast/core/types.hpp"

namespace holdfast {

/// Tension T = EA (l − l₀)/l₀ (N) of an elastic bar, < 0 in compression. `reach` (m) is the vector
/// from the bar's left end to its right end, l = |reach| its length, l₀ (m) its unstretched
/// `length` and EA (N) its axial stiffness.
template <class Scalar>
Scalar bar_tension(const Vector<Scalar, 2>& reach, double length, double axial_stiffness) {
  return axial_stiffness * (reach.norm() - length) / length;
}

/// Force vector T n (N) of a bar on its left node. T is the tension by bar_tension(), with the same
/// parameters, and n = reach/|reach| the unit vector towards the right node.
template <class Scalar>
Vector<Scalar, 2> bar_pull(const Vector<Scalar, 2>& reach, double length, double axial_stiffness) {
  return reach * Scalar(axial_stiffness * (Scalar(1.0 / length) - Scalar(1) / reach.norm()));
}

/// Derivative matrix (EA/l₀) n nᵀ + (T/l)(I − n nᵀ) (N/m) of the force bar_pull() with respect to
/// `reach`. The symbols are those of bar_tension() and bar_pull(); I is the identity matrix.
template <class Scalar>
Matrix<Scalar, 2> bar_stiffness(const Vector<Scalar, 2>& reach, double length,
                                double axial_stiffness) {
  const Matrix<Scalar, 2> along = reach * reach.transpose() / reach.squaredNorm();
  return axial_stiffness / length * along + bar_tension<Scalar>(reach, length, axial_stiffness) /
                                                reach.norm() *
                                                (Matrix<Scalar, 2>::Identity() - along);
}

/// A cable as a chain of N elastic bars and N + 1 nodes; the outer two nodes are the supports. The
/// unstretched lengths of the bars add up to that of the cable. One node lies at the absorber. All
/// bars left of this node have equal unstretched lengths, and so have all bars right of it. The
/// N − 1 nodes between the supports are free to move. A free node has the position [x, y]ᵀ (m)
/// relative to the left support: x towards the right support, y downward. Free nodes and bars are
/// numbered from 0, from left to right.
/// @tparam Real  number type, always `double`; as a template the class is compiled only where used
template <class Real>
class BasicBarChain {
 public:
  /// Positions (m) or velocities (m/s) of the free nodes, one column per node.
  using Nodes = Eigen::Matrix<Real, 2, Eigen::Dynamic>;

  /// @param conductor  admissible conductor of the cable, see `validate`
  /// @param position   horizontal distance x_p (m) of the absorber from the left support in the
  ///                   cable under its own weight alone, 0 < x_p < span
  /// @param elements   number N of bars, 2 … 10⁶
  /// @throws InvalidParameter for an argument outside its range
  BasicBarChain(const Conductor<Real>& conductor, Real position, int elements)
      : conductor_(checked(conductor, position, elements)),
        cable_(conductor),
        place_(cable_.material_coordinate(position)),
        loaded_node_(0) {
    const Real whole = cable_.unstretched_length();
    const int left =
        std::clamp(static_cast<int>(std::lround(elements * place_ / whole)), 1, elements - 1);
    loaded_node_ = left - 1;
    lengths_.assign(static_cast<std::size_t>(left), place_ / left);
    lengths_.resize(static_cast<std::size_t>(elements), (whole - place_) / (elements - left));
  }

  /// Number N of bars.
  int elements() const { return static_cast<int>(lengths_.size()); }
  /// Number N − 1 of nodes between the supports.
  int free_nodes() const { return elements() - 1; }
  /// Index of the free node that carries the absorber, 0 … N − 2.
  int loaded_node() const { return loaded_node_; }
  /// Unstretched length l₀ (m) of bar `element`, 0 … N − 1. The bar lies between the free nodes
  /// `element` − 1 and `element`; the first and the last bar end at a support.
  Real length(int element) const { return lengths_[static_cast<std::size_t>(element)]; }
  /// Axial stiffness EA (N), the same for all bars.
  Real axial_stiffness() const { return cable_.axial_stiffness(); }
  /// Conductor whose cable the bars model.
  const Conductor<Real>& conductor() const { return conductor_; }

  /// Lumped mass (kg) of free node `node`, 0 … N − 2: half the mass of each adjacent bar.
  Real mass(int node) const {
    return conductor_.mass_per_length * 0.5 * (length(node) + length(node + 1));
  }

  /// Vector [x, y]ᵀ (m), y downward, from the left to the right end of bar `element`, 0 … N − 1, at
  /// the positions `nodes` (m) of the free nodes.
  template <class Positions>
  auto reach(const Positions& nodes, int element) const {
    using Scalar = typename Positions::Scalar;
    Vector<Scalar, 2> from = Vector<Scalar, 2>::Zero(), to(Scalar(conductor_.span), Scalar(0));
    if (element > 0) from = nodes.col(element - 1);
    if (element < free_nodes()) to = nodes.col(element);
    return Vector<Scalar, 2>(to - from);
  }

  /// Smallest tension (N) of all bars at the positions `nodes` (m); ≤ 0 if a bar is slack.
  Real smallest_tension(const Nodes& nodes) const {
    Real smallest = std::numeric_limits<Real>::infinity();
    for (int e = 0; e < elements(); ++e)
      smallest =
          std::min(smallest, bar_tension<Real>(reach(nodes, e), length(e), axial_stiffness()));
    return smallest;
  }

  /// Positions (m) of the free nodes on the exact elastic catenary under gravity and a load P (N,
  /// downward) at the absorber; NaN if no catenary is found. They are the start values of
  /// chain_equilibrium().
  Nodes catenary_positions(Real load) const {
    const LoadedCable<Real> loaded = cable_.under_load(load, place_);
    Nodes nodes(2, free_nodes());
    Real s = 0.0;
    for (int node = 0; node < free_nodes(); ++node) {
      s += length(node);
      nodes.col(node) = cable_.point(loaded, load, place_, s);
    }
    return nodes;
  }

 private:
  static const Conductor<Real>& checked(const Conductor<Real>& conductor, Real position,
                                        int elements) {
    validate(conductor);
    require_inside_span(position, conductor.span);
    require_within("number of elements", elements, "", 2, 1000000);
    return conductor;
  }

  Conductor<Real> conductor_;
  HangingCable<Real> cable_;
  Real place_;
  int loaded_node_;
  std::vector<Real> lengths_;
};

/// The bar chain BasicBarChain with numbers of type `double`.
using BarChain = BasicBarChain<double>;

/// Equilibrium of a bar chain.
struct ChainEquilibrium {
  BarChain::Nodes nodes;       ///< positions (m) of the free nodes, valid if converged
  EquilibriumOutcome outcome;  ///< converged: forces balanced to round-off, every bar in tension
  double unbalanced;           ///< largest |component| (N) of the resultant force on a free node
};

/// Tangent stiffness matrix (N/m) of N bars: the derivative of the internal forces on the free
/// nodes with respect to their positions, at the positions `nodes` (m). It is symmetric and
/// block-tridiagonal, and positive definite if all bars are in tension. Its 2(N − 1) rows and
/// columns are ordered x₀, y₀, x₁, y₁ …
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

/// Resultant force [x, y]ᵀ (N), y downward, on each free node at the positions `nodes` (m): the sum
/// of the node's weight, the bars' forces and, at the absorber's node, `load` (N, downward).
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

/// Equilibrium of the chain under gravity and a load P (N, downward) at the absorber's node, by
/// Newton's method from the exact catenary. A step is halved until it reduces the resultant forces.
/// @throws InvalidParameter for a load that is not finite
template <class Real>
ChainEquilibrium chain_equilibrium(const BasicBarChain<Real>& chain, double load) {
  using Nodes = typename BasicBarChain<Real>::Nodes;
  require_finite("load", load, "N");
  ChainEquilibrium result{chain.catenary_positions(load), EquilibriumOutcome::not_converged, 0.0};
  auto forces = unbalanced_forces(chain, result.nodes, load);
  // A bar's pull is EA/l₀ times a difference of lengths, whose round-off limits the force balance.
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
extern template class BasicBarChain<double>;
extern template ChainEquilibrium chain_equilibrium(const BarChain&, double);
#endif

}  // namespace holdfast
