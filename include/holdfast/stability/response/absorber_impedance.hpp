#pragma once

#include <cmath>
#include <complex>

#include "holdfast/control/gains.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/plant/loop_hardware.hpp"
#include "holdfast/plant/modal_plant.hpp"

namespace holdfast {

/// The impedance Z_eff(s) (N s/m) of the computer's force: the part of that force with the
/// frequency of the motion, over the conductor's velocity:
///
///     Z_eff = −(D + P/s) F(s) A(s) e^{−s(δ + τ/2)} sinh(sτ/2)/(sτ/2)
///
/// with the lags F of the measurement filter and A of the drive. Where the velocity is a difference
/// of readings, D has the factor (1 − e^{−sτ})/(sτ). At s = iω sinh(sτ/2)/(sτ/2) = sinc(ωτ/2). The
/// held force also has the frequencies ω + 2πk/τ; where the conductor responds to them, only the
/// sampled loop (`ModalResponse`) is exact. The arguments are not checked.
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

/// The impedance Z(s) = (M_c s² + K_p)/s + T_a Z_eff (N s/m) of the absorber with its computer:
/// force over velocity of the conductor. M_c, K_p and T_a are as in plant/modal_plant.hpp. Like
/// `drive_impedance` it holds for one frequency only. The arguments are not checked.
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
