#pragma once

#include <complex>

#include "holdfast/control/gains.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/plant/loop_hardware.hpp"
#include "holdfast/plant/modal_plant.hpp"
#include "holdfast/stability/response/absorber_impedance.hpp"

namespace holdfast {

/// An actively controlled absorber on a span, with its drive and its control computer.
struct ActiveAbsorber {
  Absorber<double> absorber;   ///< absorber with its clamp
  Sampling<double> sampling;   ///< sampling period τ (s) and processing delay δ (s)
  PdGains<double> gains;       ///< gains P (N/m) and D (N s/m)
  LoopHardware hardware = {};  ///< measurement filter and drive
};

/// The impedance Z(s) (N s/m), force over velocity of the conductor, from `absorber_impedance`.
/// @param device  absorber with its drive and computer (unchecked)
/// @param s       complex frequency (1/s), ≠ 0
inline std::complex<double> impedance(const ActiveAbsorber& device, const std::complex<double>& s) {
  return absorber_impedance(device.absorber, device.sampling, device.gains, device.hardware, s);
}

}  // namespace holdfast
