#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "case/model/span/span_of_case.hpp"
#include "holdfast/span/end_response.hpp"
#include "holdfast/span/wind/energy_balance.hpp"

namespace holdfast::program {

/// A vibration at one frequency, without the devices and with them.
struct Vibration {
  BalancedAmplitude amplitude;  ///< at the antinodes of the free span; NaN where the loop grows
  double strain;                ///< of the outermost wire, zero to peak; NaN where not known
};

/// What a span does in the wind at one frequency, by one law of the wind and one of the losses.
struct AeolianRow {
  double frequency;   ///< Hz
  double wind_speed;  ///< m/s
  std::string wind_law, damping_law;
  Vibration bare, damped;
};

/// What the devices at both ends take of 1 m at the antinodes, over the span (W/m³).
double taken_by_devices(const TautString<double>& string, double angular_frequency,
                        const std::array<EndResponse, 2>& ends);

/// The largest angle (rad/m) by which a clamp bends the conductor there: at a support or a device.
double sharpest_angle(const std::array<EndResponse, 2>& ends);

/// The energy balance of a case's span, one frequency after the other.
class AeolianBalance {
 public:
  /// Throws WrongInput for a conductor whose diameter is not known.
  AeolianBalance(const Case& the_case, bool controlled);

  /// One row by each pair of laws.
  std::vector<AeolianRow> rows(double frequency) const;

  /// The vibration with the devices by the pair of laws that gives the largest amplitude.
  Vibration largest(double frequency) const;

  /// Hz at which a wind of a speed (m/s) sheds its vortices, and the speed of a frequency.
  double frequency_of(double speed) const { return strouhal_ * speed / diameter_; }
  double speed_of(double frequency) const { return frequency * diameter_ / strouhal_; }

  double diameter() const { return diameter_; }  ///< m
  bool knows_strain() const { return bending_.has_value(); }
  bool has_devices() const { return !devices_.empty(); }
  bool is_growing() const { return grows_; }  ///< with the devices; then they have no amplitude
  /// Pa, of the outer wires; NaN where they are not known.
  double outer_wire_modulus() const;

 private:
  std::array<EndResponse, 2> ends_at(double angular_frequency) const;
  Vibration vibration(const WindPowerLaw& wind, const LossLaw& loss, double frequency,
                      const std::array<EndResponse, 2>& ends) const;

  TautString<double> string_;
  double diameter_, strouhal_, wind_share_;
  std::vector<LossLaw> losses_;
  std::optional<ClampBending> bending_;
  std::vector<SpanDevice> devices_;
  bool grows_;  // with the devices it comes to no steady vibration
};

/// How many rows lie beyond the amplitudes that the law of the wind was measured for.
class RangeCount {
 public:
  void add(const AeolianRow& row, bool with_devices);
  std::string text() const;  ///< what the user has to know of them; empty for none

 private:
  std::int64_t below_ = 0, above_ = 0;
};

}  // namespace holdfast::program
