#include "jobs/span/aeolian_amplitudes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "case/model/modal/conductor_modes.hpp"
#include "case/model/span/span_loop.hpp"
#include "holdfast/span/wind/turbulence.hpp"

namespace holdfast::program {
namespace {

/// Of a loop that grows.
constexpr Vibration no_vibration{{std::numeric_limits<double>::quiet_NaN(), BalanceRange::within},
                                 std::numeric_limits<double>::quiet_NaN()};

TautString<double> string_in_wind(const Case& the_case) {
  require_diameter(the_case, "the vibration in the wind");
  return string_of(the_case);
}

}  // namespace

double taken_by_devices(const TautString<double>& string, double angular_frequency,
                        const std::array<EndResponse, 2>& ends) {
  double taken = 0.0;
  for (const EndResponse& end : ends)
    taken += end.absorbed_power(string.wave_impedance(), angular_frequency) / string.span;
  return taken;
}

double sharpest_angle(const std::array<EndResponse, 2>& ends) {
  double angle = 0.0;
  for (const EndResponse& end : ends) {
    angle = std::max(angle, end.support_angle);
    // A clamp that turns with the conductor bends it half to each side.
    for (const double kink : end.kinks) angle = std::max(angle, 0.5 * kink);
  }
  return angle;
}

AeolianBalance::AeolianBalance(const Case& the_case, bool controlled)
    : string_(string_in_wind(the_case)),
      diameter_(the_case.conductor.diameter),
      strouhal_(strouhal_of(the_case)),
      wind_share_(turbulent_share(the_case.site.turbulence_intensity)),
      losses_(loss_laws_of(the_case)),
      bending_(clamp_bending_of(the_case)),
      devices_(span_devices_of(the_case, controlled)),
      grows_(is_growing_span(the_case, controlled)) {}

double AeolianBalance::outer_wire_modulus() const {
  return bending_ ? bending_->outer_wire_modulus : std::nan("");
}

Vibration AeolianBalance::vibration(const WindPowerLaw& wind, const LossLaw& loss, double frequency,
                                    const std::array<EndResponse, 2>& ends) const {
  const double omega = 2.0 * pi<double> * frequency;
  const double of_devices = taken_by_devices(string_, omega, ends);
  const auto lost = [&](double y) {
    return (loss.power(frequency, y) + of_devices * y * y) / wind_share_;
  };
  const BalancedAmplitude found = balanced_amplitude(wind, frequency, diameter_, lost);
  const double strain =
      bending_ ? bending_->strain_of_angle(sharpest_angle(ends) * found.amplitude) : std::nan("");
  return {found, strain};
}

std::array<EndResponse, 2> AeolianBalance::ends_at(double angular_frequency) const {
  const auto places = span_ends(devices_, string_.span);
  return {end_response(string_, places[0], angular_frequency),
          end_response(string_, places[1], angular_frequency)};
}

std::vector<AeolianRow> AeolianBalance::rows(double frequency) const {
  const double omega = 2.0 * pi<double> * frequency;
  const std::array<EndResponse, 2> damped = ends_at(omega);
  const EndResponse support = end_response(string_, {}, omega);
  std::vector<AeolianRow> rows;
  for (const WindPowerLaw& wind : wind_power_laws)
    for (const LossLaw& loss : losses_) {
      const Vibration bare = vibration(wind, loss, frequency, {support, support});
      rows.push_back({frequency, speed_of(frequency), std::string(wind.name), loss.name, bare,
                      grows_          ? no_vibration
                      : has_devices() ? vibration(wind, loss, frequency, damped)
                                      : bare});
    }
  return rows;
}

Vibration AeolianBalance::largest(double frequency) const {
  if (grows_) return no_vibration;
  const std::array<EndResponse, 2> ends = ends_at(2.0 * pi<double> * frequency);
  std::optional<Vibration> largest;
  for (const WindPowerLaw& wind : wind_power_laws)
    for (const LossLaw& loss : losses_) {
      const Vibration found = vibration(wind, loss, frequency, ends);
      if (!largest || found.amplitude.amplitude > largest->amplitude.amplitude) largest = found;
    }
  return *largest;
}

void RangeCount::add(const AeolianRow& row, bool with_devices) {
  const BalanceRange range = with_devices ? row.damped.amplitude.range : row.bare.amplitude.range;
  below_ += range == BalanceRange::below ? 1 : 0;
  above_ += range == BalanceRange::above ? 1 : 0;
}

std::string RangeCount::text() const {
  std::string text;
  if (below_ > 0)
    text = std::to_string(below_) +
           " row(s) vibrate less than the law of the wind was measured for, a hundredth of the "
           "diameter, which is given as their bound (amplitude_range)";
  if (above_ > 0)
    text += (text.empty() ? "" : "; ") + std::to_string(above_) +
            " row(s) more than it was measured for, whose largest amplitude is given as theirs";
  return text;
}

}  // namespace holdfast::program
