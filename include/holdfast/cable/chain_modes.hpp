#pragma once

#include <Eigen/Eigenvalues>
#include <cmath>
#include <vector>

#include "holdfast/cable/bar_chain.hpp"
#include "holdfast/cable/cable_place_modes.hpp"
#include "holdfast/cable/modes.hpp"

namespace holdfast {

/// One undamped in-plane mode of a cable that is modelled by finite elements.
struct ElementsMode {
  ModeFamily family;   ///< symmetry of the vertical displacement about mid-span
  double frequency;    ///< natural frequency (Hz)
  double along_share;  ///< fraction of the kinetic energy in motion along the span, 0 … 1
  Eigen::VectorXd shape;  ///< x₀, y₀, x₁, y₁ … displacements of the free nodes, largest magnitude 1
};

/// Undamped modes of a cable without absorber about its equilibrium.
struct ElementsModes {
  EquilibriumOutcome outcome;  ///< whether the equilibrium was found
  /// Transverse and longitudinal modes (`along_share` near 0 or near 1) in ascending order of
  /// frequency. Empty without an equilibrium.
  std::vector<ElementsMode> modes;
};

namespace detail {

/// Family of a mode shape: symmetric if Σ v(x) v(L − x) > 0 over the vertical displacements v.
inline ModeFamily family_of(const Eigen::VectorXd& shape) {
  const Eigen::Index nodes = shape.size() / 2;
  double overlap = 0.0;
  for (Eigen::Index node = 0; node < nodes; ++node)
    overlap += shape[2 * node + 1] * shape[2 * (nodes - 1 - node) + 1];
  return overlap > 0.0 ? ModeFamily::symmetric : ModeFamily::antisymmetric;
}

}  // namespace detail

/// The `count` lowest undamped modes of a cable without absorber, with N = `elements` equal bars:
/// K φ = ω² M φ with the tangent stiffness K at the equilibrium and the lumped masses M. Lumping
/// makes the frequencies too low. K is stored as a dense matrix: N up to about 1000 is practical.
/// @throws InvalidParameter for an inadmissible conductor, N not 2, 4, 6 …, count not 1 … 2(N − 1)
template <class Real>
ElementsModes elements_modes(const Conductor<Real>& conductor, int elements, int count) {
  using Square = Matrix<Real, Eigen::Dynamic>;
  if (elements < 2 || elements % 2 != 0)
    throw InvalidParameter("number of elements", elements, "", "even and >= 2");
  require_within("number of modes", count, "", 1, 2.0 * (elements - 1));
  const BasicBarChain<Real> chain(conductor, conductor.span / 2, elements);
  const ChainEquilibrium rest = chain_equilibrium(chain, 0.0);
  ElementsModes result{rest.outcome, {}};
  if (rest.outcome != EquilibriumOutcome::converged) return result;
  const Vector<Real, Eigen::Dynamic> masses =
      detail::mass_matrix(chain, BarMass::lumped).diagonal();
  const Eigen::GeneralizedSelfAdjointEigenSolver<Square> solver(
      Square(tangent_stiffness(chain, rest.nodes)), Square(masses.asDiagonal()));
  for (int k = 0; k < count; ++k) {
    Vector<Real, Eigen::Dynamic> shape = solver.eigenvectors().col(k);
    const Vector<Real, Eigen::Dynamic> energies = masses.cwiseProduct(shape.cwiseAbs2());
    const double along = energies.reshaped(2, energies.size() / 2).row(0).sum() / energies.sum();
    shape /= shape.cwiseAbs().maxCoeff();
    // Every bar is in tension, so no eigenvalue is negative but by round-off.
    const double frequency =
        std::sqrt(std::fmax(solver.eigenvalues()[k], 0.0)) / (2.0 * pi<double>);
    result.modes.push_back({detail::family_of(shape), frequency, along, std::move(shape)});
  }
  return result;
}

}  // namespace holdfast
