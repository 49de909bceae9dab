#pragma once

#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

#include "holdfast/cable/taut_string.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/span/device/span_device.hpp"

namespace holdfast {

/// The response of one end of a span (`SpanEnd`) to incident waves of angular frequency ω (rad/s).
/// Deflections y and slopes are amplitudes divided by the antinode amplitude of the span beyond the
/// devices. The outermost device is the one farthest from the support.
struct EndResponse {
  std::complex<double> reflection;  ///< reflection coefficient r of y at the outermost device
  /// Impedance Z = Z_c (1 − r)/(1 + r) (N s/m) of the end, measured at the outermost device and
  /// including this device. Z_c is the wave impedance. Without devices r = −1 and Z = ∞.
  std::complex<double> impedance;
  double support_angle;         ///< slope at the support (rad per m of antinode amplitude)
  std::vector<double> motions;  ///< |y| at each device (m/m), in the order of `SpanEnd::devices`
  std::vector<double> kinks;    ///< slope jump at each device (rad/m), device force over tension

  /// The fraction 1 − |r|² of the incident power that the devices absorb; < 0 if they supply power.
  double absorbed_fraction() const { return 1.0 - std::norm(reflection); }

  /// The inverse standing-wave ratio S = (1 − |r|)/(1 + |r|): amplitude at a node over amplitude at
  /// an antinode. S is negative if the devices supply power.
  double inverse_standing_wave_ratio() const {
    return (1.0 - std::abs(reflection)) / (1.0 + std::abs(reflection));
  }

  /// The absorbed power ½ Z_c ω² S (W/m²) per squared antinode amplitude, with S as defined in
  /// `inverse_standing_wave_ratio`.
  /// @param wave_impedance     wave impedance Z_c (N s/m) of the string
  /// @param angular_frequency  angular frequency ω (rad/s) of the incident waves
  double absorbed_power(double wave_impedance, double angular_frequency) const {
    return 0.5 * wave_impedance * angular_frequency * angular_frequency *
           inverse_standing_wave_ratio();
  }
};

/// One end of a span: a support and the devices in its half of the span, the nearest device first.
struct SpanEnd {
  std::vector<double> distances;           ///< distances (m) of the devices from the support, > 0
  std::vector<const SpanDevice*> devices;  ///< devices in the order of `distances`; not owned
};

/// The left end [0] and the right end [1] of a span. Devices at midspan belong to the left end.
/// @param devices  devices sorted by `in_order`; must outlive the result
/// @param span     span L (m)
inline std::array<SpanEnd, 2> span_ends(const std::vector<SpanDevice>& devices, double span) {
  std::array<SpanEnd, 2> ends;
  for (const SpanDevice& device : devices) {
    if (device.position > span / 2.0) continue;
    ends[0].distances.push_back(device.position);
    ends[0].devices.push_back(&device);
  }
  for (auto device = devices.rbegin(); device != devices.rend(); ++device) {
    if (device->position <= span / 2.0) break;
    ends[1].distances.push_back(span - device->position);
    ends[1].devices.push_back(&*device);
  }
  return ends;
}

/// The response of one end of a taut string to incident waves e^{iωt}. The deflection y is computed
/// from the support outward. Between devices y″ = −k² y, with k = ω/c and the wave speed c. At
/// a device of impedance Z the slope jumps by iω Z y/T, where T is the tension of the string. With
/// a single device at the distance a from the support, the reflection coefficient is
///
///     r = (1 − ζ_t)/(1 + ζ_t),   ζ_t = Z/Z_c − i cot ka   (wave impedance Z_c)
///
/// Damping of the string is neglected, as the few metres of an end absorb almost no power.
/// @param string             tension and mass; damping and bending stiffness are not used
/// @param end                support with its devices (unchecked)
/// @param angular_frequency  angular frequency ω (rad/s), > 0
inline EndResponse end_response(const TautString<double>& string, const SpanEnd& end,
                                double angular_frequency) {
  using Complex = std::complex<double>;
  const double k = angular_frequency / string.wave_speed();
  const Complex s(0.0, angular_frequency);
  EndResponse response{};
  Complex y(0.0), slope(1.0);
  double at = 0.0;
  for (std::size_t j = 0; j < end.devices.size(); ++j) {
    const double way = k * (end.distances[j] - at), sine = std::sin(way), cosine = std::cos(way);
    const Complex moved = y * cosine + slope * sine / k;
    slope = slope * cosine - y * k * sine;
    y = moved;
    const Complex kink = end.devices[j]->impedance(s) * s * y / string.tension;
    slope += kink;
    response.motions.push_back(std::abs(y));
    response.kinks.push_back(std::abs(kink));
    at = end.distances[j];
  }
  // y = A e^{ikx} + B e^{−ikx}: the first runs in, with e^{iωt}.
  const Complex incident = (y + slope / Complex(0.0, k)) / 2.0;
  const Complex returned = (y - slope / Complex(0.0, k)) / 2.0;
  const double antinode = std::abs(incident) + std::abs(returned);
  response.reflection = returned / incident;
  response.impedance = string.tension * slope / (s * y);
  response.support_angle = 1.0 / antinode;
  for (double& motion : response.motions) motion /= antinode;
  for (double& kink : response.kinks) kink /= antinode;
  return response;
}

}  // namespace holdfast
