#include "jobs/span/placement/absorber_demands.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <variant>

#include "case/model/modal/conductor_modes.hpp"
#include "case/model/span/span_of_case.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/span/end_response.hpp"
#include "holdfast/span/perfect_absorption.hpp"
#include "jobs/span/aeolian_amplitudes.hpp"

namespace holdfast::program {
namespace {

/// Amplitude of the conductor at the absorber for an antinode amplitude of 1 m.
double motion_at_absorber(const TautString<double>& string, const std::vector<SpanDevice>& devices,
                          double omega) {
  for (const SpanEnd& end : span_ends(devices, string.span))
    for (std::size_t k = 0; k < end.devices.size(); ++k)
      if (std::holds_alternative<ActiveAbsorber>(end.devices[k]->device))
        return end_response(string, end, omega).motions[k];
  return 0.0;
}

/// Demands on the drive for a conductor amplitude z (m) at ω.
AbsorberDemands demands_at(const ActiveAbsorber& device, double z, double omega) {
  const std::complex<double> s(0.0, omega), v = s * z;
  const auto& [absorber, sampling, gains, hardware] = device;
  // Held over samples the command has this share at ω.
  const double half = 0.5 * omega * sampling.period, held = std::sin(half) / half;
  const std::complex<double> force = -drive_impedance(sampling, gains, hardware, s) * v;
  const std::complex<double> inertia = absorber.mass * s * s;
  // m (z + w) s² = −(k + c s) w − u, w the absorber's motion against the conductor.
  const std::complex<double> stroke =
      -(inertia * z + force) / (inertia + absorber.damping * s + absorber.stiffness);
  // The drive pushes the conductor by u and the absorber by −u.
  return {std::abs(force / held), std::abs(stroke), -0.5 * (force * std::conj(s * stroke)).real()};
}

}  // namespace

AbsorberDemands absorber_demands(const Case& the_case, const std::vector<double>& frequencies,
                                 double worst) {
  const double none = std::nan("");
  if (!std::isfinite(the_case.conductor.diameter)) return {none, none, none};
  const AeolianBalance balance(the_case, true);
  const TautString<double> string = string_of(the_case);
  const std::vector<SpanDevice> devices = span_devices_of(the_case);
  const auto device = std::get<ActiveAbsorber>(active_device_of(the_case, true).device);
  const auto at = [&](double frequency) {
    const double omega = 2.0 * pi<double> * frequency;
    const double antinode = balance.largest(frequency).amplitude.amplitude;
    return demands_at(device, antinode * motion_at_absorber(string, devices, omega), omega);
  };
  AbsorberDemands all{0.0, 0.0, at(worst).drive_power};
  for (const double frequency : frequencies) {
    const AbsorberDemands here = at(frequency);
    all.largest_force = std::max(all.largest_force, here.largest_force);
    all.largest_stroke = std::max(all.largest_stroke, here.largest_stroke);
  }
  return all;
}

PdGains<double> perfect_gains(const Case& the_case, double frequency) {
  const SpanDevice device = active_device_of(the_case, true);
  const double span = the_case.conductor.span;
  const double distance = std::min(device.position, span - device.position);
  try {
    return perfect_absorption(string_of(the_case), distance,
                              std::get<ActiveAbsorber>(device.device),
                              2.0 * pi<double> * frequency);
  } catch (const InvalidParameter&) {
    return {std::nan(""), std::nan("")};
  }
}

}  // namespace holdfast::program
