#pragma once

#include <algorithm>
#include <complex>
#include <variant>
#include <vector>

#include "holdfast/cable/conductor.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/span/device/active_absorber.hpp"
#include "holdfast/span/device/lumped_device.hpp"
#include "holdfast/span/device/measured_impedance.hpp"

namespace holdfast {

/// A device clamped on a span at a given position.
struct SpanDevice {
  double position;  ///< distance (m) from the left support, inside the span
  std::variant<LumpedDevice, MeasuredImpedance, ActiveAbsorber> device;  ///< the device itself

  /// The impedance Z(s) of the device, force over velocity of the conductor (N s/m).
  /// @param s  complex frequency (1/s), ≠ 0
  std::complex<double> impedance(const std::complex<double>& s) const {
    return std::visit([&](const auto& one) { return holdfast::impedance(one, s); }, device);
  }
};

/// The devices sorted by ascending distance from the left support.
/// @param devices  devices in any order
/// @param span     span L (m) of the conductor
/// @throws InvalidParameter unless 0 < position < L for every device
inline std::vector<SpanDevice> in_order(std::vector<SpanDevice> devices, double span) {
  for (const SpanDevice& device : devices) require_inside_span(device.position, span);
  std::stable_sort(devices.begin(), devices.end(), [](const SpanDevice& a, const SpanDevice& b) {
    return a.position < b.position;
  });
  return devices;
}

}  // namespace holdfast
