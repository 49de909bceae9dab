#pragma once

#include <cmath>
#include <complex>

#include "holdfast/cable/taut_string.hpp"
#include "holdfast/control/gains.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/span/device/active_absorber.hpp"

namespace holdfast {

/// The impedance Z* = Z_c (1 + i cot ka) (N s/m) of a device that reflects no part of an incident
/// wave of the frequency ω. The device is at the distance a from a support; k = ω/c.
/// @param string             tension and mass; damping and bending stiffness are not used
/// @param distance           a (m) from the support, > 0; sin ka ≠ 0
/// @param angular_frequency  ω (rad/s), > 0
/// @throws InvalidParameter where sin ka = 0, that is, where the device is at a node
inline std::complex<double> matched_impedance(const TautString<double>& string, double distance,
                                              double angular_frequency) {
  const double phase = angular_frequency * distance / string.wave_speed();
  if (!(std::abs(std::sin(phase)) > 1e-9))
    throw InvalidParameter("distance from the support", distance, "m",
                           "no multiple of half the wavelength, where the string does not move");
  return string.wave_impedance() * std::complex<double>(1.0, 1.0 / std::tan(phase));
}

/// The gains P and D with which an absorber completely absorbs an incident wave of the frequency ω.
/// The absorber with its computer then has the impedance Z* of `matched_impedance`:
///
///     (M_c s² + K_p)/s + T_a Z_eff = Z*,   s = iω
///
/// `drive_impedance` defines Z_eff, which is linear in P and D; `place_response` defines K_p and
/// T_a. Stability of the loop with these gains must be examined separately.
/// @param string             tension and mass; damping and bending stiffness are not used
/// @param distance           a (m) from the support, > 0; sin ka ≠ 0
/// @param device             absorber with its computer; its gains are not used
/// @param angular_frequency  ω (rad/s), > 0; not a multiple of 2π/τ, at which the held force has no
///                           component of the frequency ω
/// @throws InvalidParameter where the device is at a node of the wave, where ω is a multiple of
/// 2π/τ, or where the velocity is a difference of readings and ω is a multiple of π/τ
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
