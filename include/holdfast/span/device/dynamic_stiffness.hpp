#pragma once

#include <cmath>
#include <complex>
#include <vector>

#include "holdfast/span/device/lumped_device.hpp"

namespace holdfast {

/// The dynamic stiffness K = s Z of a device, force over displacement, and its derivative dK/ds.
struct DynamicStiffness {
  std::complex<double> value;  ///< dynamic stiffness K (N/m)
  std::complex<double> slope;  ///< derivative dK/ds (N s/m)
};

/// The dynamic stiffness K(s) of a lumped device and dK/ds at the complex frequency s (1/s).
inline DynamicStiffness dynamic_stiffness(const LumpedDevice& device,
                                          const std::complex<double>& s) {
  DynamicStiffness sum{device.clamp_mass * s * s, 2.0 * device.clamp_mass * s};
  for (const DeviceBranch& branch : device.branches) {
    const std::complex<double> link =
        (branch.inertance * s + branch.damping) * s + branch.stiffness;
    const std::complex<double> link_slope = 2.0 * branch.inertance * s + branch.damping;
    if (!std::isfinite(branch.mass)) {
      sum.value += link;
      sum.slope += link_slope;
      continue;
    }
    // 1/(1/q + 1/p) with p = m s².
    const std::complex<double> inertia = branch.mass * s * s, both = link + inertia;
    sum.value += link * inertia / both;
    sum.slope +=
        (link_slope * inertia * inertia + 2.0 * branch.mass * s * link * link) / (both * both);
  }
  return sum;
}

/// The nonzero eigenvalues s (1/s) of a lumped device for a fixed clamp. A conjugate pair is listed
/// once, by its eigenvalue with Im s > 0.
inline std::vector<std::complex<double>> own_motions(const LumpedDevice& device) {
  std::vector<std::complex<double>> motions;
  for (const DeviceBranch& branch : device.branches) {
    if (!std::isfinite(branch.mass)) continue;
    const double mass = branch.mass + branch.inertance, decay = branch.damping / (2.0 * mass);
    const double square = decay * decay - branch.stiffness / mass;
    if (square < 0.0) {
      motions.emplace_back(-decay, std::sqrt(-square));
      continue;
    }
    const double larger = decay + std::sqrt(square);
    if (larger > 0.0) motions.emplace_back(-larger, 0.0);
    // A mass on a dashpot alone has no restoring force.
    if (larger > 0.0 && branch.stiffness != 0.0)
      motions.emplace_back(-branch.stiffness / mass / larger, 0.0);
  }
  return motions;
}

}  // namespace holdfast
