#pragma once

#include <complex>

#include "holdfast/control/gains.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/plant/loop_hardware.hpp"
#include "holdfast/plant/modal_plant.hpp"
#include "holdfast/stability/response/absorber_impedance.hpp"

namespace holdfast {

/// The absorber with its computer as a device on a span.
struct ActiveAbsorber {
  Absorber<double> absorber;   ///< absorber with its clamp
  Sampling<double> sampling;   ///< sampling period τ and processing delay δ
  PdGains<double> gains;       ///< gains P and D
  LoopHardware hardware = {};  ///< measurement filter and drive
};

/// The impedance Z(s) (N s/m) of an active absorber, by `absorber_impedance`.
/// @param device  absorber with its computer (unchecked)
/// @param s       complex frequency (1/s), ≠ 0
inline std::complex<double> impedance(const ActiveAbsorber& device, const std::complex<double>& s) {
  return absorber_impedance(device.absorber, device.sampling, device.gains, device.hardware, s);
}

}  // namespace holdfast
