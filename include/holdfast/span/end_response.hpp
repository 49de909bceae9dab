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

/// The response of an end of a span with its devices to incident waves of one frequency. Motions
/// are relative to a free span that vibrates with 1 m at its antinodes.
struct EndResponse {
  std::complex<double> reflection;  ///< reflection r of the displacement at the outermost device
  /// Impedance Z = Z_c (1 − r)/(1 + r) (N s/m) of the end at the outermost device's place; infinite
  /// without a device, as at the support.
  std::complex<double> impedance;
  double support_angle;         ///< slope of the conductor at the support (rad per m at antinodes)
  std::vector<double> motions;  ///< motions of the devices, outward from the support (m/m)
  std::vector<double> kinks;    ///< jumps |Z v|/T of the slope at devices of velocity v (rad/m)

  /// The absorbed fraction 1 − |r|² of the incident power.
  double absorbed_fraction() const { return 1.0 - std::norm(reflection); }

  /// The inverse standing-wave ratio S = (1 − |r|)/(1 + |r|), the amplitude at a node over that at
  /// an antinode. S is negative where the devices supply power.
  double inverse_standing_wave_ratio() const {
    return (1.0 - std::abs(reflection)) / (1.0 + std::abs(reflection));
  }

  /// The power ½ Z_c ω² S that the devices absorb at an antinode amplitude of 1 m (W/m²).
  double absorbed_power(double wave_impedance, double angular_frequency) const {
    return 0.5 * wave_impedance * angular_frequency * angular_frequency *
           inverse_standing_wave_ratio();
  }
};

/// An end of a span: its devices with their distances from the support, ascending.
struct SpanEnd {
  std::vector<double> distances;           ///< distances (m) from the support, > 0
  std::vector<const SpanDevice*> devices;  ///< devices at the distances
};

/// The two ends of a span: entry [0] has the devices nearer to the left support, entry [1] the
/// devices nearer to the right support.
/// @param devices  sorted by `in_order`; must outlive the result
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

/// The response of an end of a taut string to waves e^{iωt}, integrated from the fixed support
/// outward. Between devices y″ = −k² y with k = ω/c; at a device the slope jumps by Z iω y/T.
/// Beyond the last device the incident and reflected waves are separated by the impedance Z_c ζ_t:
///
///     r = (1 − ζ_t)/(1 + ζ_t),  ζ_t = Z/Z_c − i cot ka   for one device at a
///
/// The string is taken as undamped, since the few metres of an end absorb nearly nothing.
/// @param string             tension and mass; damping and bending stiffness are not used
/// @param end                end with its devices (unchecked)
/// @param angular_frequency  ω (rad/s), > 0
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
