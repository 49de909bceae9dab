#pragma once

#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <vector>

#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"

namespace holdfast {

/// A branch of a device on a conductor. A dashpot, a spring and an inerter in parallel connect the
/// conductor to a mass or to the ground.
struct DeviceBranch {
  double damping = 0.0;    ///< dashpot coefficient c (N s/m), ≥ 0
  double stiffness = 0.0;  ///< spring stiffness k (N/m), of either sign
  double inertance = 0.0;  ///< inertance b (kg), ≥ 0: inerter force over relative acceleration
  /// The mass m (kg), > 0, to which the branch connects the conductor; infinity for the ground.
  double mass = std::numeric_limits<double>::infinity();
};

/// The impedance Z(s) of a branch, force over velocity of the conductor (N s/m):
/// 1/Z = 1/(b s + c + k/s) + 1/(m s), with the symbols of the members of `DeviceBranch`.
/// @param branch  branch of a device (unchecked)
/// @param s       complex frequency (1/s), ≠ 0
inline std::complex<double> impedance(const DeviceBranch& branch, const std::complex<double>& s) {
  const std::complex<double> link = branch.inertance * s + branch.damping + branch.stiffness / s;
  if (!std::isfinite(branch.mass)) return link;
  const std::complex<double> inertia = branch.mass * s;
  return link * inertia / (link + inertia);
}

/// A device of masses, springs, dashpots and inerters that is clamped on a conductor. Its impedance
/// is a sum over clamp and branches, with the members c, k, b and m of `DeviceBranch`:
///
///     Z(s) = M_c s + Σ 1/(1/(b s + c + k/s) + 1/(m s))
struct LumpedDevice {
  std::vector<DeviceBranch> branches;  ///< parallel branches
  double clamp_mass = 0.0;             ///< clamp mass M_c (kg), ≥ 0
};

/// The impedance Z(s) of the device (N s/m), force over velocity of the conductor.
/// @param device  lumped device (unchecked)
/// @param s       complex frequency (1/s), ≠ 0
inline std::complex<double> impedance(const LumpedDevice& device, const std::complex<double>& s) {
  std::complex<double> sum = device.clamp_mass * s;
  for (const DeviceBranch& branch : device.branches) sum += impedance(branch, s);
  return sum;
}

/// Checks that every member of the device and its branches is inside its stated range.
/// @throws InvalidParameter naming the first member that is not admissible
inline void validate(const LumpedDevice& device) {
  require_non_negative("clamp mass of a device", device.clamp_mass, "kg");
  for (const DeviceBranch& branch : device.branches) {
    require_non_negative("damping of a device", branch.damping, "N s/m");
    require_finite("stiffness of a device", branch.stiffness, "N/m");
    require_non_negative("inertance of a device", branch.inertance, "kg");
    if (!(branch.mass > 0.0)) throw InvalidParameter("mass of a device", branch.mass, "kg", "> 0");
  }
}

/// A branch of a mass on a spring and a dashpot, without inerter. Its frequency and damping ratio
/// are given for a fixed clamp. The arguments are not checked.
/// @param mass           mass m (kg), > 0
/// @param frequency      undamped natural frequency f (Hz), > 0
/// @param damping_ratio  damping ratio ζ ≥ 0, fraction of critical damping
inline DeviceBranch tuned_branch(double mass, double frequency, double damping_ratio) {
  const double omega = 2.0 * pi<double> * frequency;
  return {2.0 * damping_ratio * mass * omega, mass * omega * omega, 0.0, mass};
}

/// The data of a Stockbridge damper, that is, two weights on a messenger wire. Its two resonances
/// are given for a clamp that is held fixed.
struct StockbridgeData {
  double mass;                           ///< mass of both weights together (kg), > 0
  std::array<double, 2> frequencies;     ///< resonances (Hz), > 0, the lower one first
  std::array<double, 2> damping_ratios;  ///< damping ratios ζ of these resonances, > 0
  double mass_share = 0.5;               ///< fraction of `mass` for the lower resonance, 0 … 1
  double clamp_mass = 0.0;               ///< mass of the clamp (kg), ≥ 0
};

/// A Stockbridge damper as a lumped device. Each resonance is a branch with a mass on a spring and
/// a dashpot. The masses of the branches add up to `data.mass`; a branch of mass 0 is left out.
/// @throws InvalidParameter where data are out of range; the order of frequencies is not checked
inline LumpedDevice stockbridge(const StockbridgeData& data) {
  require_positive("mass of both weights of a Stockbridge damper", data.mass, "kg");
  require_within("mass share of a Stockbridge damper's lower resonance", data.mass_share, "", 0, 1);
  require_positive("lower frequency of a Stockbridge damper", data.frequencies[0], "Hz");
  require_positive("higher frequency of a Stockbridge damper", data.frequencies[1], "Hz");
  for (const double ratio : data.damping_ratios)
    require_positive("damping ratio of a Stockbridge damper", ratio, "");
  LumpedDevice device;
  device.clamp_mass = data.clamp_mass;
  const std::array<double, 2> masses = {data.mass_share * data.mass,
                                        (1.0 - data.mass_share) * data.mass};
  for (std::size_t k = 0; k < 2; ++k)
    if (masses[k] > 0.0)
      device.branches.push_back(
          tuned_branch(masses[k], data.frequencies[k], data.damping_ratios[k]));
  validate(device);
  return device;
}

}  // namespace holdfast
