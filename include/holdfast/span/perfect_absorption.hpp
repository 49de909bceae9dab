#pragma once

#include <cmath>
#include <complex>

#include "holdfast/cable/taut_string.hpp"
#include "holdfast/control/gains.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/span/device/active_absorber.hpp"

namespace holdfast {

/// The impedance Z* = Z_c (1 + i cot ka) (N s/m), k = ω/c, with which a device at a distance a from
/// a support reflects no wave of one frequency.
/// @param string             tension and mass
/// @param distance           a (m) from the support, > 0; sin ka ≠ 0
/// @param angular_frequency  ω (rad/s), > 0
/// @throws InvalidParameter where sin ka = 0: the device is at a node of this frequency
inline std::complex<double> matched_impedance(const TautString<double>& string, double distance,
                                              double angular_frequency) {
  const double phase = angular_frequency * distance / string.wave_speed();
  if (!(std::abs(std::sin(phase)) > 1e-9))
    throw InvalidParameter("distance from the support", distance, "m",
                           "not a whole number of half-waves: at a node nothing moves");
  return string.wave_impedance() * std::complex<double>(1.0, 1.0 / std::tan(phase));
}

/// The gains P and D with which a controlled absorber completely absorbs a wave of one frequency:
///
///     Z_eff = (Z* − (M_c s² + K_p)/s)/T_a,   s = iω
///     −(D d + P/s) Λ = Z_eff,   Λ = F(s) D(s) e^{−s(δ + τ/2)} sinc(ωτ/2)
///
/// where d is 1, or (1 − e^{−sτ})/(sτ) for a velocity by difference: two real equations for P, D.
/// The lags F(s), D(s) are defined at `LoopHardware`, K_p and T_a at `place_response`. Stability of
/// the loop with these gains must be examined separately.
/// @param string             tension and mass
/// @param distance           a (m) from the support, > 0; sin ka ≠ 0
/// @param device             absorber with its computer; its gains are not used
/// @param angular_frequency  ω (rad/s), > 0, no multiple of 2π/τ; with a velocity by difference, no
///                           multiple of π/τ
/// @throws InvalidParameter where the device is at a node of the wave, or ω an excluded multiple
inline PdGains<double> perfect_absorption(const TautString<double>& string, double distance,
                                          const ActiveAbsorber& device, double angular_frequency) {
  const std::complex<double> s(0.0, angular_frequency);
  const std::complex<double> wanted = (matched_impedance(string, distance, angular_frequency) -
                                       detail::passive_stiffness(device.absorber, s) / s) /
                                      detail::transmitted_share(device.absorber, s);
  const std::complex<double> by_p =
      drive_impedance(device.sampling, {1.0, 0.0}, device.hardware, s);
  const std::complex<double> by_d =
      drive_impedance(device.sampling, {0.0, 1.0}, device.hardware, s);
  const double area = (std::conj(by_p) * by_d).imag();
  if (!(std::abs(area) > 1e-9 * std::abs(by_p) * std::abs(by_d)))
    throw InvalidParameter("angular frequency", angular_frequency, "rad/s",
                           "no multiple of pi/tau, where samples do not show the vibration");
  return {(std::conj(wanted) * by_d).imag() / area, (std::conj(by_p) * wanted).imag() / area};
}

}  // namespace holdfast
