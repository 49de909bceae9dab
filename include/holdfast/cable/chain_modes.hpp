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
  Eigen::VectorXd shape;  ///< 2(N − 1): x, y of each free node, largest magnitude 1
};

/// Undamped modes of the bare cable about its equilibrium.
struct ElementsModes {
  EquilibriumOutcome outcome;  ///< of the equilibrium
  std::vector<ElementsMode>
      modes;  ///< ascending frequency; vertical modes and those along the cable
};

namespace detail {

/// Mass matrix (kg) of the chain with fixed supports, 2(N − 1) square.
inline Eigen::MatrixXd mass_matrix(const BarChain& chain, MassModel model) {
  const int size = 2 * chain.free_nodes();
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size);
  for (int e = 0; e < chain.elements(); ++e) {
    const double mass = chain.conductor().mass_per_length * chain.length(e);
    const double own = mass * (model == MassModel::lumped ? 0.5 : 1.0 / 3.0);
    const double shared = model == MassModel::lumped ? 0.0 : mass / 6.0;
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
inline ElementsModes elements_modes(const Conductor<double>& conductor, int elements, int count,
                                    MassModel model = MassModel::lumped) {
  if (elements < 2 || elements % 2 != 0)
    throw InvalidParameter("number of elements", elements, "", "even and >= 2");
  require_within("number of modes", count, "", 1, 2.0 * (elements - 1));
  const BarChain chain(conductor, conductor.span / 2, elements);
  const ChainEquilibrium rest = chain_equilibrium(chain, 0.0);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(
      Eigen::MatrixXd(tangent_stiffness(chain, rest.nodes)), detail::mass_matrix(chain, model));
  ElementsModes result{rest.outcome, {}};
  for (int k = 0; k < count; ++k) {
    Eigen::VectorXd shape = solver.eigenvectors().col(k);
    shape /= shape.cwiseAbs().maxCoeff();
    const double squared = std::fmax(solver.eigenvalues()[k], 0.0);
    result.modes.push_back(
        {detail::family_of(shape), std::sqrt(squared) / (2.0 * pi<double>), std::move(shape)});
  }
  return result;
}

}  // namespace holdfast
