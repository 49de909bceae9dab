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

/// That the built-in absorber does not count; empty where nobody could think it does.
std::string absent_absorber_note(const Case& the_case);

/// A device of masses, springs and dashpots, of every kind but a measured one.
LumpedDevice lumped_device_of(const case_tables::Device& device);

/// The absorber with its computer, or with gains 0.
SpanDevice active_device_of(const Case& the_case, bool controlled);

/// Clamped devices of the case's span and, where it has one, its absorber.
std::vector<SpanDevice> span_devices_of(const Case& the_case, bool controlled = true);

/// Whether the string with its devices comes back to rest, its springs that push away being so many
/// times as strong: from the left support on it passes through no node before the right one
/// (Sturm).
/// @param devices  `in_order`
bool comes_back(const TautString<double>& string, const std::vector<SpanDevice>& devices,
                double times = 1.0);

/// Throws WrongInput where a device was not measured at some frequency (Hz) of a range.
void require_measured(const Case& the_case, double lowest, double highest);

/// Throws WrongInput for a conductor without outside diameter, in the words of `job`.
void require_diameter(const Case& the_case, const std::string& job);

/// Power that a conductor itself takes at a frequency (Hz) and an antinode amplitude (m), W/m, by
/// one law.
struct LossLaw {
  std::string name;
  std::function<double(double, double)> power;
};

/// By each published self-damping law where the rated strength is known, else by the damping ratio.
std::vector<LossLaw> loss_laws_of(const Case& the_case);

/// How it bends at a clamp; nothing where its wires are not known.
std::optional<ClampBending> clamp_bending_of(const Case& the_case);

/// The line of life for its layers of aluminium: that of several where they are not known, which is
/// the shorter life.
SafeBorderLine life_line_of(const Case& the_case);

/// The hours of a year at each wind speed (m/s), of a Weibull site over the speeds of the range in
/// steps of a twentieth. Throws WrongInput where the case says nothing of its site.
std::vector<WindHours> wind_hours_of(const Case& the_case, double lowest, double highest);

/// f d/U of the vortices.
double strouhal_of(const Case& the_case);

}  // namespace holdfast::program
