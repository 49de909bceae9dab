#pragma once

#include "holdfast/cable/elements.hpp"

namespace holdfast::test {

/// Kinetic and elastic energy and that of the weights (J), up to a constant; constant along an
/// undamped motion.
inline double energy_of(const CableElements& cable, const HangingAbsorber& absorber,
                        const Eigen::VectorXd& state) {
  const BarChain& chain = cable.chain();
  const bool sprung = absorber.reading == AbsorberReading::spring_mass;
  const bool rigid = absorber.reading == AbsorberReading::rigid_mass;
  const int loaded = chain.loaded_node();
  const auto nodes = cable.positions(state.data());
  double sum = -absorber.mass * chain.conductor().gravity * nodes(1, loaded);
  for (int node = 0; node < chain.free_nodes(); ++node) {
    const double mass = chain.mass(node), carried = rigid && node == loaded ? absorber.mass : 0.0;
    const int first = 4 * node + (sprung && node > loaded ? 2 : 0);
    sum += 0.5 * (mass + carried) * state.segment<2>(first + 2).squaredNorm();
    sum -= mass * chain.conductor().gravity * nodes(1, node);
  }
  for (int e = 0; e < chain.elements(); ++e) {
    const double stretch = chain.reach(nodes, e).norm() - chain.length(e);
    sum += 0.5 * chain.axial_stiffness() / chain.length(e) * stretch * stretch;
  }
  if (!sprung) return sum;
  const double lag = state[4 * loaded + 4] - cable.displacement(state);
  const double speed = state[4 * loaded + 5];
  return sum + 0.5 * absorber.stiffness * lag * lag + 0.5 * absorber.mass * speed * speed;
}

}  // namespace holdfast::test
