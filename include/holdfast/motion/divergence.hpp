#pragma once

#include <algorithm>
#include <cmath>
#include <complex>

#include "holdfast/excitation/multi_harmonic_force.hpp"
#include "holdfast/math/linalg/elimination.hpp"
#include "holdfast/motion/implemented_loop.hpp"
#include "holdfast/motion/modal/natural_motions.hpp"
#include "holdfast/plant/modal_plant.hpp"
#include "holdfast/plant/ports.hpp"

namespace holdfast {

namespace detail {

/// The scale of the static deflection (m) under a force F (N): the largest entry of A⁻¹ c F, or of
/// c F where A has no inverse. States that are constant between samples are left out.
template <class Plant>
double static_deflection(const Plant& plant, double force) {
  const auto& input = plant.excitation_input();
  auto matrix = plant.state_matrix();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    if (matrix.row(i).cwiseAbs().maxCoeff() == 0.0) matrix(i, i) = 1.0;
  const auto bend = eliminated(matrix, input);
  return force * (bend.allFinite() ? bend : input).cwiseAbs().maxCoeff();
}

}  // namespace detail

/// The bound on the |entries| of the state (m, m/s) above which a motion counts as diverging: 10¹²
/// (y + ω y + r₀ + largest |entry| of the initial state). y (m): static deflection under the
/// largest force; ω (rad/s): highest frequency of the force; r₀ (m): backlash width.
/// @param loop   an admissible loop
/// @param state  the initial state, N × 1, finite
template <class Plant>
double divergence_bound(const ImplementedLoopOf<Plant>& loop, const StateOf<Plant>& state) {
  const MultiHarmonicForce& force = loop.digital.force;
  double largest = 0.0;
  if (force.record)
    for (const double row : force.record->forces()) largest = std::max(largest, std::abs(row));
  for (const Harmonic& harmonic : force.harmonics) largest += harmonic.amplitude;
  const double deflection = detail::static_deflection(loop.plant, largest);
  const double scale = deflection * (1.0 + force.highest_angular_frequency()) +
                       loop.backlash.width + state.cwiseAbs().maxCoeff();
  return 1e12 * std::max(scale, 1e-100);
}

/// The divergence bound for a conductor given by its modes. The formula is that for an
/// ImplementedLoop, but y (m) is the static deflection at the absorber under the force amplitude.
/// @param loop   an admissible loop
/// @param state  the initial state of the plant of `loop`
inline double divergence_bound(const ModalLoop& loop, const NaturalMotions::Full& state) {
  const double bend = receptance(loop.modes, std::complex<double>(0.0)).real();
  const double deflection = loop.excitation.amplitude * bend;
  const double scale = deflection * (1.0 + loop.excitation.angular_frequency()) +
                       loop.backlash_width + state.cwiseAbs().maxCoeff();
  return 1e12 * std::max(scale, 1e-100);
}

}  // namespace holdfast
