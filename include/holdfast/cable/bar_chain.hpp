#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "holdfast/cable/hanging_cable.hpp"
#include "holdfast/core/types.hpp"

namespace holdfast {

/// Tension T = EA (l − l₀)/l₀ (N) of a bar that reaches over `reach` (m), unstretched l₀.
template <class Scalar>
Scalar bar_tension(const Vector<Scalar, 2>& reach, double length, double axial_stiffness) {
  return axial_stiffness * (reach.norm() - length) / length;
}

/// T n (N): how a bar pulls its first node toward the second.
template <class Scalar>
Vector<Scalar, 2> bar_pull(const Vector<Scalar, 2>& reach, double length, double axial_stiffness) {
  return reach * Scalar(axial_stiffness * (Scalar(1.0 / length) - Scalar(1) / reach.norm()));
}

/// ∂(T n)/∂reach = (EA/l₀) n nᵀ + (T/l)(I − n nᵀ) (N/m), symmetric.
template <class Scalar>
Matrix<Scalar, 2> bar_stiffness(const Vector<Scalar, 2>& reach, double length,
                                double axial_stiffness) {
  const Matrix<Scalar, 2> along = reach * reach.transpose() / reach.squaredNorm();
  return axial_stiffness / length * along + bar_tension<Scalar>(reach, length, axial_stiffness) /
                                                reach.norm() *
                                                (Matrix<Scalar, 2>::Identity() - along);
}

/// A cable as N elastic bars between N + 1 nodes, the outer two being the supports.
///
/// The bars' unstretched lengths add up to the cable's; a node lies at the absorber's material
/// point, and on either side of it the bars are equal. Positions are 2 × (N − 1), a column
/// [x, y]ᵀ (m) per free node, y downward.
/// @tparam Real  `double`; a parameter so that the class is compiled only where it is used
template <class Real>
class BasicBarChain {
 public:
  /// Columns of free nodes' positions (m) or velocities (m/s).
  using Nodes = Eigen::Matrix<Real, 2, Eigen::Dynamic>;

  /// @param conductor  admissible in the sense of `validate`
  /// @param position   x_p (m), inside the span: where a node is to lie in the bare cable
  /// @param elements   N, ≥ 2
  /// @throws InvalidParameter otherwise
  BasicBarChain(const Conductor<Real>& conductor, Real position, int elements);

  /// N, the number of bars.
  int elements() const { return static_cast<int>(lengths_.size()); }
  /// N − 1, the nodes between the supports.
  int free_nodes() const { return elements() - 1; }
  /// Index of the free node at the absorber's place.
  int loaded_node() const { return loaded_node_; }
  /// l₀ (m) of bar e, between the free nodes e − 1 and e.
  Real length(int element) const { return lengths_[static_cast<std::size_t>(element)]; }
  /// EA (N), of every bar.
  Real axial_stiffness() const { return cable_.axial_stiffness(); }
  /// The cable that the bars stand for.
  const Conductor<Real>& conductor() const { return conductor_; }

  /// Lumped mass (kg) of a free node: half of each of its two bars.
  Real mass(int node) const {
    return conductor_.mass_per_length * 0.5 * (length(node) + length(node + 1));
  }

  /// The bar's reach: from the node at its left, or the left support, to the one at its right.
  template <class Positions>
  auto reach(const Positions& nodes, int element) const {
    using Scalar = typename Positions::Scalar;
    Vector<Scalar, 2> from = Vector<Scalar, 2>::Zero(), to(Scalar(conductor_.span), Scalar(0));
    if (element > 0) from = nodes.col(element - 1);
    if (element < free_nodes()) to = nodes.col(element);
    return Vector<Scalar, 2>(to - from);
  }

  /// Smallest tension (N) of all bars; not positive where the chain is slack.
  Real smallest_tension(const Nodes& nodes) const;

  /// Where the exact statics put the nodes with a load P (N) at the absorber's place: the first
  /// guess for the chain's own equilibrium.
  Nodes catenary_positions(Real load) const;

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

/// The chain in `double`.
using BarChain = BasicBarChain<double>;

template <class Real>
BasicBarChain<Real>::BasicBarChain(const Conductor<Real>& conductor, Real position, int elements)
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

template <class Real>
Real BasicBarChain<Real>::smallest_tension(const Nodes& nodes) const {
  Real smallest = std::numeric_limits<Real>::infinity();
  for (int e = 0; e < elements(); ++e)
    smallest = std::min(smallest, bar_tension<Real>(reach(nodes, e), length(e), axial_stiffness()));
  return smallest;
}

template <class Real>
typename BasicBarChain<Real>::Nodes BasicBarChain<Real>::catenary_positions(Real load) const {
  const LoadedCable<Real> loaded = cable_.under_load(load, place_);
  Nodes nodes(2, free_nodes());
  Real s = 0.0;
  for (int node = 0; node < free_nodes(); ++node) {
    s += length(node);
    nodes.col(node) = cable_.point(loaded, load, place_, s);
  }
  return nodes;
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template class BasicBarChain<double>;
#endif

}  // namespace holdfast
