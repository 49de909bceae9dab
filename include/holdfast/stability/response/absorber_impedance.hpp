#pragma once

#include <cmath>
#include <complex>

#include "holdfast/control/gains.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/plant/loop_hardware.hpp"
#include "holdfast/plant/modal_plant.hpp"

namespace holdfast {

/// The impedance Z_eff(s) = −u/v (N s/m) of the control force. v is the conductor's velocity,
/// proportional to e^{st}, and u is the part of the force that is proportional to e^{st}:
///
///     Z_eff = −(D + P/s) F(s) A(s) e^{−s(δ + τ/2)} sinh(sτ/2)/(sτ/2)
///
/// F and A are the transfer functions of measurement filter and drive. Without a velocity sensor D
/// has the factor (1 − e^{−sτ})/(sτ). For s = iω the held force also has the frequencies ω + 2πk/τ,
/// k = ±1, ±2, …; where the conductor responds to them, only the sampled loop (`ModalResponse`) is
/// exact. The arguments are not checked.
/// @param sampling  τ and δ of the loop
/// @param gains     gains P and D
/// @param hardware  measurement filter and drive
/// @param s         complex frequency (1/s), ≠ 0
inline std::complex<double> drive_impedance(const Sampling<double>& sampling,
                                            const PdGains<double>& gains,
                                            const LoopHardware& hardware,
                                            const std::complex<double>& s) {
  const std::complex<double> half = s * sampling.period / 2.0;
  const std::complex<double> late =
      std::sinh(half) / half * std::exp(-s * (sampling.processing_delay + sampling.period / 2.0));
  const detail::HardwarePoles lags(hardware);
  const std::complex<double> seen = hardware.has_velocity_sensor
                                        ? std::complex<double>(1.0)
                                        : std::sinh(half) / half * std::exp(-half);
  return -(gains.differential * seen + gains.proportional / s) * late *
         detail::HardwarePoles::lag(lags.drive, s) * detail::HardwarePoles::lag(lags.filter, s);
}

/// The impedance Z(s) = (M_c s² + K_p)/s + T_a Z_eff (N s/m) of the controlled absorber, with T_a =
/// m₂ s²/(m₂ s² + c₂ s + k₂), K_p = T_a (k₂ + c₂ s) and Z_eff of `drive_impedance`. M_c is the mass
/// of the clamp; m₂, c₂ and k₂ are the absorber's mass, damping and stiffness. Nothing is checked.
/// @param absorber  absorber with its clamp
/// @param sampling  τ and δ of the loop
/// @param gains     gains P and D
/// @param hardware  measurement filter and drive
/// @param s         complex frequency (1/s), ≠ 0
inline std::complex<double> absorber_impedance(const Absorber<double>& absorber,
                                               const Sampling<double>& sampling,
                                               const PdGains<double>& gains,
                                               const LoopHardware& hardware,
                                               const std::complex<double>& s) {
  return detail::passive_stiffness(absorber, s) / s +
         detail::transmitted_share(absorber, s) * drive_impedance(sampling, gains, hardware, s);
}

}  // namespace holdfast
