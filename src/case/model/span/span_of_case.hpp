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

/// The absorber with its computer as a device; its gains are 0 unless `controlled`.
SpanDevice active_device_of(const Case& the_case, bool controlled);

/// Devices and active absorber, if any, of the span, by position; gains are 0 unless `controlled`.
std::vector<SpanDevice> span_devices_of(const Case& the_case, bool controlled = true);

/// Whether the string with its devices, negative stiffnesses times `times`, is statically stable:
/// a static deflection started at the left support has no zero up to the right one (Sturm).
/// @param devices  sorted by `in_order`
bool comes_back(const TautString<double>& string, const std::vector<SpanDevice>& devices,
                double times = 1.0);

/// Throws WrongInput if a measured device does not cover the frequency range (Hz).
void require_measured(const Case& the_case, double lowest, double highest);

/// Throws MissingKeys for a conductor without diameter; `job` begins the message.
void require_diameter(const Case& the_case, const std::string& job);

/// A law of self-damping: dissipated power (W/m) at a frequency (Hz) and antinode amplitude (m).
struct LossLaw {
  std::string name;
  std::function<double(double, double)> power;
};

/// The published self-damping laws if strength and diameter are known, else the damping ratio.
std::vector<LossLaw> loss_laws_of(const Case& the_case);

/// The bending of the conductor at a clamp; none if its wires or bending stiffness are not known.
std::optional<ClampBending> clamp_bending_of(const Case& the_case);

/// The fatigue curve (safe border line) for the layers of aluminium wires; the curve for several
/// layers, of shorter life, if their number is not known.
SafeBorderLine life_line_of(const Case& the_case);

/// The hours per year at each wind speed (m/s); for Weibull's law from lowest to highest in steps
/// of at most 0.05 m/s. Throws WrongInput if the case has neither speeds nor Weibull's law.
std::vector<WindHours> wind_hours_of(const Case& the_case, double lowest, double highest);

/// The Strouhal number f d/U of the vortices (frequency f, diameter d, wind speed U).
double strouhal_of(const Case& the_case);

}  // namespace holdfast::program
