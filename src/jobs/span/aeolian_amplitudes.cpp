#include "jobs/span/aeolian_amplitudes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "case/model/modal/conductor_modes.hpp"
#include "case/model/span/span_loop.hpp"
#include "holdfast/math/roots/bracketing_root.hpp"
#include "holdfast/span/wind/turbulence.hpp"
#include "process/interrupt.hpp"

namespace holdfast::program {
namespace {

/// The vibration of an unstable loop, which has no steady amplitude: NaN.
constexpr Vibration no_vibration{{std::numeric_limits<double>::quiet_NaN(), BalanceRange::within},
                                 std::numeric_limits<double>::quiet_NaN()};

TautString<double> string_in_wind(const Case& the_case) {
  require_diameter(the_case, "the vibration in the wind");
  return string_of(the_case);
}

/// Relative amplitude y/d (amplitude over diameter) at a point of the amplitude grid.
double share_of_diameter(const WindPowerLaw& wind, std::size_t point, std::size_t points) {
  if (point + 1 == points) return wind.lowest;
  return wind.highest * std::pow(wind.lowest / wind.highest,
                                 static_cast<double>(point) / static_cast<double>(points - 1));
}

/// Power absorbed by all devices over span and antinode amplitude squared (W/m³).
double taken_by_devices(const TautString<double>& string, double angular_frequency,
                        const std::array<EndResponse, 2>& ends) {
  double taken = 0.0;
  for (const EndResponse& end : ends)
    taken += end.absorbed_power(string.wave_impedance(), angular_frequency) / string.span;
  return taken;
}

/// Largest angle (rad/m) by which a clamp at a support or a device bends the conductor.
double sharpest_angle(const std::array<EndResponse, 2>& ends) {
  double angle = 0.0;
  for (const EndResponse& end : ends) {
    angle = std::max(angle, end.support_angle);
    // A clamp that turns with the conductor bends it half to each side.
    for (const double kink : end.kinks) angle = std::max(angle, 0.5 * kink);
  }
  return angle;
}

}  // namespace

SpanInWind::SpanInWind(const Case& the_case)
    : string_(string_in_wind(the_case)),
      diameter_(the_case.conductor.diameter),
      wind_share_(turbulent_share(the_case.site.turbulence_intensity)),
      losses_(loss_laws_of(the_case)),
      bending_(clamp_bending_of(the_case)) {}

double SpanInWind::strain_of(const std::array<EndResponse, 2>& ends, double amplitude) const {
  return bending_ ? bending_->strain_of_angle(sharpest_angle(ends) * amplitude) : std::nan("");
}

AeolianBalance::AeolianBalance(const Case& the_case, bool controlled)
    : SpanInWind(the_case),
      strouhal_(strouhal_of(the_case)),
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
  return {found, strain_of(ends, found.amplitude)};
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

LargestVibration::LargestVibration(const Case& the_case, const std::vector<double>& frequencies)
    : SpanInWind(the_case), frequencies_(frequencies) {
  for (const WindPowerLaw& wind : wind_power_laws)
    for (const LossLaw& loss : losses_) {
      std::vector<Spare> of_pair(frequencies.size());
      for (std::size_t k = 0; k < frequencies.size(); ++k) {
        throw_if_interrupted();
        for (std::size_t i = 0; i < points; ++i)
          of_pair[k][i] =
              spare(wind, loss, frequencies[k], share_of_diameter(wind, i, points) * diameter_);
      }
      spares_.push_back(std::move(of_pair));
    }
}

double LargestVibration::spare(const WindPowerLaw& wind, const LossLaw& loss, double frequency,
                               double y) const {
  return (wind_share_ * wind.power(frequency, diameter_, y) - loss.power(frequency, y)) / (y * y);
}

BalancedAmplitude LargestVibration::balance(const WindPowerLaw& wind, std::size_t of_pair,
                                            std::size_t k, double taken) const {
  const Spare& spares = spares_[of_pair][k];
  const auto first = static_cast<std::size_t>(
      std::find_if(spares.begin(), spares.end(), [&](double left) { return left >= taken; }) -
      spares.begin());
  if (first == 0) return {wind.highest * diameter_, BalanceRange::above};
  if (first == points) return {wind.lowest * diameter_, BalanceRange::below};
  const LossLaw& loss = losses_[of_pair % losses_.size()];
  const double lower = share_of_diameter(wind, first, points) * diameter_;
  const double upper = share_of_diameter(wind, first - 1, points) * diameter_;
  const auto root = bracketing_root<double>(
      [&](double y) { return spare(wind, loss, frequencies_[k], y) - taken; },
      {lower, upper, spares[first] - taken, spares[first - 1] - taken}, 1e-12 * lower);
  return {root.lower, BalanceRange::within};
}

Vibration LargestVibration::at(std::size_t k, const std::array<EndResponse, 2>& ends) const {
  const double taken = taken_by_devices(string_, 2.0 * pi<double> * frequencies_[k], ends);
  BalancedAmplitude largest{0.0, BalanceRange::below};
  for (std::size_t of_pair = 0; of_pair < spares_.size(); ++of_pair) {
    const BalancedAmplitude found =
        balance(wind_power_laws[of_pair / losses_.size()], of_pair, k, taken);
    if (found.amplitude > largest.amplitude) largest = found;
  }
  return {largest, strain_of(ends, largest.amplitude)};
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
           " row(s) vibrate below the measured range of the wind law: their amplitude is the lower "
           "end of this range, a hundredth of the diameter, an upper bound (amplitude_range)";
  if (above_ > 0)
    text += (text.empty() ? "" : "; ") + std::to_string(above_) +
            " row(s) vibrate above the measured range of the wind law: their amplitude is the "
            "upper end of this range, a lower bound (amplitude_range)";
  return text;
}

}  // namespace holdfast::program
