#include "case/model/span/span_of_case.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include "case/device/impedance_table.hpp"
#include "case/model/cable_of_case.hpp"
#include "case/model/modal/conductor_modes.hpp"
#include "case/model/modal/modal_plant_of_case.hpp"
#include "case/model/plant_of_case.hpp"
#include "case/needed.hpp"
#include "holdfast/span/wind/self_damping_law.hpp"
#include "process/errors.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

/// The measured impedance plus iωM of the clamp mass M, which is linear between rows too.
MeasuredImpedance measured(const case_tables::Device& device) {
  const ImpedanceTable& table = *device.table;
  std::vector<MeasuredImpedance::Row> rows;
  for (std::size_t k = 0; k < table.frequency.size(); ++k) {
    const double omega = 2.0 * pi<double> * table.frequency[k];
    rows.push_back({omega, std::polar(table.magnitude[k], table.phase_deg[k] * pi<double> / 180.0) +
                               std::complex<double>(0.0, omega * device.clamp_mass)});
  }
  return MeasuredImpedance(std::move(rows));
}

SpanDevice span_device_of(const case_tables::Device& device) {
  if (device.kind == "measured") return {device.position, measured(device)};
  return {device.position, lumped_device_of(device)};
}

/// Static stiffness (N/m) of a device; 0 for a device that hangs on the conductor.
double stiffness_at_rest(const SpanDevice& device) {
  double sum = 0.0;
  if (const auto* lumped = std::get_if<LumpedDevice>(&device.device))
    for (const DeviceBranch& branch : lumped->branches)
      if (!std::isfinite(branch.mass)) sum += branch.stiffness;
  return sum;
}

}  // namespace

std::string absent_absorber_note(const Case& the_case) {
  const auto& control = the_case.control;
  const bool has_gains = control.proportional_gain_tuned || control.proportional_gain != 0.0 ||
                         control.differential_gain != 0.0;
  if (the_case.stands_alone && !has_absorber(the_case) && has_gains)
    return "the gains of [control] need an absorber: give absorber.mass (kg)";
  if (has_active_absorber(the_case) || !has_absorber(the_case)) return "";
  return "the built-in absorber and its computer belong to another cable and are left out: give "
         "[absorber], plant.absorber_mass or [control] to include an absorber";
}

LumpedDevice lumped_device_of(const case_tables::Device& device) {
  if (device.kind == "stockbridge")
    return stockbridge({device.mass,
                        {device.frequencies[0], device.frequencies[1]},
                        {device.damping_ratios[0], device.damping_ratios[1]},
                        device.mass_share,
                        device.clamp_mass});
  DeviceBranch branch;
  if (device.to == "conductor") branch.mass = device.mass;
  branch.stiffness = device.stiffness;
  branch.damping = device.damping;
  branch.inertance = device.inertance;
  if (!device.frequencies.empty()) {
    const double omega = 2.0 * pi<double> * device.frequencies[0];
    branch.stiffness = device.mass * omega * omega;
  }
  if (!device.damping_ratios.empty())
    branch.damping = 2.0 * device.damping_ratios[0] * std::sqrt(branch.stiffness * device.mass);
  return {{branch}, device.clamp_mass};
}

SpanDevice active_device_of(const Case& the_case, bool controlled) {
  require_keys(the_case, {"absorber.position"});
  // In two masses the clamp is part of the conductor's mass; on a span it is a separate mass.
  Absorber<double> absorber = absorber_of(the_case);
  absorber.clamp_mass = the_case.absorber.clamp_mass;
  return {the_case.absorber.position,
          ActiveAbsorber{absorber, sampling_of(the_case),
                         controlled ? gains_of(the_case) : PdGains<double>{0.0, 0.0},
                         hardware_of(the_case)}};
}

std::vector<SpanDevice> span_devices_of(const Case& the_case, bool controlled) {
  std::vector<SpanDevice> devices;
  for (const case_tables::Device& device : the_case.devices)
    devices.push_back(span_device_of(device));
  if (has_active_absorber(the_case)) devices.push_back(active_device_of(the_case, controlled));
  return in_order(std::move(devices), string_of(the_case).span);
}

bool comes_back(const TautString<double>& string, const std::vector<SpanDevice>& devices,
                double times) {
  double y = 0.0, slope = 1.0, at = 0.0;
  for (const SpanDevice& device : devices) {
    y += slope * (device.position - at);
    if (!(y > 0.0)) return false;
    const double stiffness = stiffness_at_rest(device);
    slope += (stiffness < 0.0 ? times : 1.0) * stiffness * y / string.tension;
    at = device.position;
  }
  return y + slope * (string.span - at) > 0.0;
}

void require_measured(const Case& the_case, double lowest, double highest) {
  for (std::size_t k = 0; k < the_case.devices.size(); ++k) {
    const case_tables::Device& device = the_case.devices[k];
    if (!device.table) continue;
    const double first = device.table->frequency.front();
    const double last = device.table->frequency.back();
    if (lowest >= first && highest <= last) continue;
    throw WrongInput("device " + std::to_string(k + 1) + ": " + device.file + " covers " +
                     format_number(first) + " to " + format_number(last) + " Hz, but " +
                     format_number(lowest) + " to " + format_number(highest) +
                     " Hz are needed: give --frequency within the measured range");
  }
}

void require_diameter(const Case& the_case, const std::string& job) {
  if (std::isfinite(the_case.conductor.diameter)) return;
  throw MissingKeys(job +
                    " needs the conductor's outside diameter, which sets the frequency of the "
                    "vortices: give conductor.diameter (m), or conductor.name from the library "
                    "(holdfast conductors --find TEXT)");
}

std::vector<LossLaw> loss_laws_of(const Case& the_case) {
  const auto& conductor = the_case.conductor;
  const TautString<double> string = string_of(the_case);
  if (!std::isfinite(conductor.rated_strength) || !std::isfinite(conductor.diameter))
    return {{"damping_ratio",
             [string, ratio = damping_ratio_of(the_case)](double frequency, double amplitude) {
               return damped_power(string.mass_per_length, ratio, 2.0 * pi<double> * frequency,
                                   amplitude);
             }}};
  const StrandedConductor strand{conductor.mass_per_length, conductor.diameter,
                                 conductor.rated_strength, string.tension};
  std::vector<LossLaw> laws;
  laws.reserve(self_damping_laws.size());
  for (const SelfDampingLaw& law : self_damping_laws)
    laws.push_back({std::string(law.name), [strand, law](double frequency, double amplitude) {
                      return law.power(strand, frequency, amplitude);
                    }});
  return laws;
}

std::optional<ClampBending> clamp_bending_of(const Case& the_case) {
  const auto& conductor = the_case.conductor;
  if (!std::isfinite(conductor.outer_wire_diameter) ||
      !std::isfinite(conductor.outer_wire_modulus) || !(conductor.bending_stiffness > 0.0))
    return std::nullopt;
  const ClampBending bending{string_of(the_case).tension, conductor.bending_stiffness,
                             conductor.outer_wire_diameter, conductor.outer_wire_modulus};
  validate(bending);
  return bending;
}

SafeBorderLine life_line_of(const Case& the_case) {
  return the_case.conductor.layers == 1.0 ? single_layer : several_layers;
}

std::vector<WindHours> wind_hours_of(const Case& the_case, double lowest, double highest) {
  const case_tables::Site& site = the_case.site;
  std::vector<WindHours> rows;
  for (std::size_t k = 0; k < site.speeds.size(); ++k)
    rows.push_back({site.speeds[k], site.hours[k]});
  if (!rows.empty()) return rows;
  if (!std::isfinite(site.weibull_scale))
    throw WrongInput(
        "the case does not describe the wind at its site: give [site] with weibull_scale (m/s) and "
        "weibull_shape, or with speeds (m/s) and the hours per year of each speed");
  constexpr double step = 0.05;
  const int steps = std::max(1, static_cast<int>(std::ceil((highest - lowest) / step)));
  return weibull_hours(site.weibull_scale, site.weibull_shape, lowest, highest, steps);
}

double strouhal_of(const Case& the_case) {
  return the_case.wind ? the_case.wind->strouhal : case_tables::Wind{}.strouhal;
}

}  // namespace holdfast::program
