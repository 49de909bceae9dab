#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "case/model/span/span_of_case.hpp"
#include "holdfast/span/end_response.hpp"
#include "holdfast/span/wind/energy_balance.hpp"
#include "holdfast/span/wind/wind_power_law.hpp"

namespace holdfast::program {

/// A vibration at one frequency, without the devices and with them.
struct Vibration {
  BalancedAmplitude amplitude;  ///< at the antinodes of the free span; NaN where the loop grows
  double strain;                ///< of the outermost wire, zero to peak; NaN where not known
};

/// Vibration of a span in the wind at one frequency, by one law of the wind and one of the losses.
struct AeolianRow {
  double frequency;   ///< Hz
  double wind_speed;  ///< m/s
  std::string wind_law, damping_law;
  Vibration bare, damped;
};

/// Data of a case with its span for the energy balance, whatever devices are on it.
class SpanInWind {
 protected:
  /// Throws WrongInput for a conductor whose diameter is not known.
  explicit SpanInWind(const Case& the_case);

  /// Strain of the outermost wire, where the antinodes vibrate by an amplitude (m).
  double strain_of(const std::array<EndResponse, 2>& ends, double amplitude) const;

  TautString<double> string_;
  double diameter_, wind_share_;
  std::vector<LossLaw> losses_;
  std::optional<ClampBending> bending_;
};

/// The energy balance of a case's span, one frequency after the other.
class AeolianBalance : SpanInWind {
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

  double strouhal_;
  std::vector<SpanDevice> devices_;
  bool grows_;  // with the devices it comes to no steady vibration
};

/// `AeolianBalance::largest` of one set of devices after another, at frequencies that are known:
/// what wind and conductor say by each pair of laws is computed once, on the grid on which
/// `balanced_amplitude` looks.
class LargestVibration : SpanInWind {
 public:
  /// @param frequencies  Hz
  LargestVibration(const Case& the_case, const std::vector<double>& frequencies);

  /// With ends that answer to the k-th frequency.
  Vibration at(std::size_t k, const std::array<EndResponse, 2>& ends) const;

 private:
  static constexpr std::size_t points = 61;
  /// Power spare for devices (W/m³) at amplitudes from the largest of a law of the wind downward.
  using Spare = std::array<double, points>;

  double spare(const WindPowerLaw& wind, const LossLaw& loss, double frequency, double y) const;
  BalancedAmplitude balance(const WindPowerLaw& wind, std::size_t of_pair, std::size_t k,
                            double taken) const;

  std::vector<double> frequencies_;
  std::vector<std::vector<Spare>> spares_;  // of each pair, at each frequency
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
