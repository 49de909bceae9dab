#pragma once

#include <cmath>
#include <complex>

#include "holdfast/cable/taut_string.hpp"
#include "holdfast/control/gains.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/span/device/active_absorber.hpp"

namespace holdfast {

/// The impedance Z* = Z_c (1 + i cot ka) (N s/m) at which a device near a support reflects no part
/// of an incident wave. Z_c is the wave impedance, k = ω/c and c the wave speed.
/// @param string             tension and mass; damping and bending stiffness are not used
/// @param distance           distance a (m) of the device from the support, > 0; sin ka ≠ 0
/// @param angular_frequency  angular frequency ω (rad/s) of the wave, > 0
/// @throws InvalidParameter where |sin ka| ≤ 10⁻⁹, that is, where the device is at a node
inline std::complex<double> matched_impedance(const TautString<double>& string, double distance,
                                              double angular_frequency) {
  const double phase = angular_frequency * distance / string.wave_speed();
  if (!(std::abs(std::sin(phase)) > 1e-9))
    throw InvalidParameter("distance from the support", distance, "m",
                           "no multiple of half the wavelength, where the string does not move");
  return string.wave_impedance() * std::complex<double>(1.0, 1.0 / std::tan(phase));
}

/// The gains P and D with which an absorber completely absorbs an incident wave of frequency ω. The
/// controlled absorber then has the impedance Z* of `matched_impedance`:
///
///     (M_c s² + K_p)/s + T_a Z_eff = Z*,   s = iω
///
/// M_c is the clamp mass. `drive_impedance` defines Z_eff as a linear function of P and D, and
/// `place_response` defines K_p and T_a. The stability of the loop must be checked separately.
/// @param string             tension and mass; damping and bending stiffness are not used
/// @param distance           distance a (m) of the absorber from the support, > 0
/// @param device             absorber with its drive and computer; its gains are not used
/// @param angular_frequency  angular frequency ω (rad/s) of the wave, > 0
/// @throws InvalidParameter if the absorber is at a node of the wave, or if ω is a multiple of
/// 2π/τ with the sampling period τ (without a velocity sensor: of π/τ)
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
  if (!(std::abs(area) > 1e-9 * std::abs(by_p) * std::abs(by_d)) ||
      !(std::abs(by_p) * angular_frequency > 1e-9))
    throw InvalidParameter(
        "angular frequency", angular_frequency, "rad/s",
        "no multiple of 2 pi/tau (of pi/tau where the velocity is a difference), "
        "where P and D cannot set the force's phase");
  return {(std::conj(wanted) * by_d).imag() / area, (std::conj(by_p) * wanted).imag() / area};
}

}  // namespace holdfast
