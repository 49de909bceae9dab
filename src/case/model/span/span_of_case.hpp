#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "holdfast/cable/taut_string.hpp"
#include "holdfast/span/device/span_device.hpp"
#include "holdfast/span/life/clamp_bending.hpp"
#include "holdfast/span/life/miner_damage.hpp"
#include "holdfast/span/life/safe_border_line.hpp"

namespace holdfast::program {

/// A note that the built-in absorber is left out, or that gains need an absorber; empty otherwise.
std::string absent_absorber_note(const Case& the_case);

/// A device as masses, springs and dashpots; not for kind "measured".
LumpedDevice lumped_device_of(const case_tables::Device& device);

/// Absorber with its computer as a device of the span; gains are 0 unless `controlled`.
SpanDevice active_device_of(const Case& the_case, bool controlled);

/// Devices and active absorber, if any, of the span, by position; gains are 0 unless `controlled`.
std::vector<SpanDevice> span_devices_of(const Case& the_case, bool controlled = true);

/// Whether a string with devices is statically stable. By Sturm's criterion: a static deflection
/// that starts at the left support has no zero up to the right one.
/// @param devices  sorted by `in_order`; negative stiffnesses are multiplied by `times`
bool comes_back(const TautString<double>& string, const std::vector<SpanDevice>& devices,
                double times = 1.0);

/// Throws WrongInput if a measured device has no data for the whole range of frequencies (Hz).
void require_measured(const Case& the_case, double lowest, double highest);

/// Throws MissingKeys for a conductor without diameter; `job` begins the message.
void require_diameter(const Case& the_case, const std::string& job);

/// Law of the conductor's self-damping: power (W/m) at a frequency (Hz) and antinode amplitude (m).
struct LossLaw {
  std::string name;
  std::function<double(double, double)> power;
};

/// The published self-damping laws if strength and diameter are known, else the damping ratio.
std::vector<LossLaw> loss_laws_of(const Case& the_case);

/// The bending of the conductor at a clamp; none if its wires or bending stiffness are not known.
std::optional<ClampBending> clamp_bending_of(const Case& the_case);

/// Fatigue curve (CIGRE safe border line) for the conductor's number of aluminium layers. If that
/// number is not known: the curve for several layers, which gives a shorter life.
SafeBorderLine life_line_of(const Case& the_case);

/// Hours per year at each wind speed (m/s): as given in [site], or by Weibull's law in steps of at
/// most 0.05 m/s from `lowest` to `highest`. Throws WrongInput if the case gives neither.
std::vector<WindHours> wind_hours_of(const Case& the_case, double lowest, double highest);

/// The Strouhal number f d/U of the vortices (frequency f, diameter d, wind speed U).
double strouhal_of(const Case& the_case);

}  // namespace holdfast::program
