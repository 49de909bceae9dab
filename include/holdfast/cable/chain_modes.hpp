#pragma once

#include <Eigen/Eigenvalues>
#include <cmath>
#include <vector>

#include "holdfast/cable/chain_equilibrium.hpp"
#include "holdfast/cable/modes.hpp"

namespace holdfast {

/// How the mass of a bar goes to its nodes.
enum class MassModel {
  lumped,      ///< half to each: frequencies come out low
  consistent,  ///< by the bar's linear shape functions: they come out high
};

/// One undamped in-plane mode of the finite elements.
struct ElementsMode {
  ModeFamily family;      ///< by the symmetry of the vertical displacement about mid-span
  double frequency;       ///< Hz
  double along_share;     ///< share of the kinetic energy that moves along the span, 0 … 1
  Eigen::VectorXd shape;  ///< 2(N − 1): x, y of each free node, largest magnitude 1
};

/// Undamped modes of the bare cable about its equilibrium.
struct ElementsModes {
  EquilibriumOutcome outcome;  ///< of the equilibrium
  /// Ascending frequency; those across the span and those along it, which `along_share` tells
  /// apart. None without an equilibrium.
  std::vector<ElementsMode> modes;
};

namespace detail {

/// Mass matrix (kg) of the chain with fixed supports, 2(N − 1) square.
template <class Real>
Matrix<Real, Eigen::Dynamic> mass_matrix(const BasicBarChain<Real>& chain, MassModel model) {
  const int size = 2 * chain.free_nodes();
  Matrix<Real, Eigen::Dynamic> matrix = Matrix<Real, Eigen::Dynamic>::Zero(size, size);
  for (int e = 0; e < chain.elements(); ++e) {
    const Real mass = chain.conductor().mass_per_length * chain.length(e);
    const Real own = mass * (model == MassModel::lumped ? 0.5 : 1.0 / 3.0);
    const Real shared = model == MassModel::lumped ? 0.0 : mass / 6.0;
    for (int i = 0; i < 2; ++i) {
      const int left = 2 * (e - 1) + i, right = 2 * e + i;
      if (e > 0) matrix(left, left) += own;
      if (e < chain.free_nodes()) matrix(right, right) += own;
      if (e == 0 || e == chain.free_nodes()) continue;
      matrix(left, right) += shared;
      matrix(right, left) += shared;
    }
  }
  return matrix;
}

/// Share of φᵀ M φ of a shape's displacements along the span.
template <class Real>
Real along_share(const Matrix<Real, Eigen::Dynamic>& mass,
                 const Vector<Real, Eigen::Dynamic>& shape) {
  Vector<Real, Eigen::Dynamic> along = shape;
  for (Eigen::Index k = 1; k < along.size(); k += 2) along[k] = 0.0;
  return along.dot(mass * along) / shape.dot(mass * shape);
}

/// Positive where a shape is its own mirror image, negative where it is the opposite of it.
inline ModeFamily family_of(const Eigen::VectorXd& shape) {
  const Eigen::Index nodes = shape.size() / 2;
  double overlap = 0.0;
  for (Eigen::Index node = 0; node < nodes; ++node)
    overlap += shape[2 * node + 1] * shape[2 * (nodes - 1 - node) + 1];
  return overlap > 0.0 ? ModeFamily::symmetric : ModeFamily::antisymmetric;
}

}  // namespace detail

/// The `count` lowest undamped modes of the bare cable in `elements` equal bars:
/// K φ = ω² M φ with the tangent stiffness K of the equilibrium (dense, so N up to about 1000).
/// @throws InvalidParameter for an inadmissible conductor, an odd or small number of elements, or
/// a count outside 1 … 2(N − 1)
template <class Real>
ElementsModes elements_modes(const Conductor<Real>& conductor, int elements, int count,
                             MassModel model = MassModel::lumped) {
  using Square = Matrix<Real, Eigen::Dynamic>;
  if (elements < 2 || elements % 2 != 0)
    throw InvalidParameter("number of elements", elements, "", "even and >= 2");
  require_within("number of modes", count, "", 1, 2.0 * (elements - 1));
  const BasicBarChain<Real> chain(conductor, conductor.span / 2, elements);
  const ChainEquilibrium rest = chain_equilibrium(chain, 0.0);
  ElementsModes result{rest.outcome, {}};
  if (rest.outcome != EquilibriumOutcome::converged) return result;
  const Square mass = detail::mass_matrix(chain, model);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Square> solver(
      Square(tangent_stiffness(chain, rest.nodes)), mass);
  for (int k = 0; k < count; ++k) {
    Vector<Real, Eigen::Dynamic> shape = solver.eigenvectors().col(k);
    const double along = detail::along_share(mass, shape);
    shape /= shape.cwiseAbs().maxCoeff();
    // Every bar is in tension, so no eigenvalue is negative but by round-off.
    const double frequency =
        std::sqrt(std::fmax(solver.eigenvalues()[k], 0.0)) / (2.0 * pi<double>);
    result.modes.push_back({detail::family_of(shape), frequency, along, std::move(shape)});
  }
  return result;
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template ElementsModes elements_modes(const Conductor<double>&, int, int, MassModel);
#endif

}  // namespace holdfast
