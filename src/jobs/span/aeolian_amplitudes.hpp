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

/// Amplitude and strain of a span vibrating at one frequency.
struct Vibration {
  BalancedAmplitude amplitude;  ///< antinode amplitude of the free span; NaN: unstable loop
  double strain;                ///< strain of the outermost wire, zero to peak; NaN: unknown
};

/// Vibration of a span at one frequency, by one law of wind power and one of self-damping.
struct AeolianRow {
  double frequency;   ///< frequency (Hz)
  double wind_speed;  ///< wind speed (m/s)
  std::string wind_law, damping_law;
  Vibration bare, damped;
};

/// Data of a case's span for the energy balance, independent of its devices.
class SpanInWind {
 protected:
  /// Reads the data. Throws WrongInput for a conductor whose diameter is not known.
  explicit SpanInWind(const Case& the_case);

  /// Strain of the outermost wire, zero to peak, for an amplitude (m) at the antinodes.
  double strain_of(const std::array<EndResponse, 2>& ends, double amplitude) const;

  TautString<double> string_;
  double diameter_, wind_share_;
  std::vector<LossLaw> losses_;
  std::optional<ClampBending> bending_;
};

/// Energy balance of wind, self-damping and devices on a case's span.
class AeolianBalance : SpanInWind {
 public:
  /// Prepares the balance. Throws WrongInput for a conductor whose diameter is not known.
  AeolianBalance(const Case& the_case, bool controlled);

  /// Rows at a frequency (Hz), one for each pair of a wind law and a self-damping law.
  std::vector<AeolianRow> rows(double frequency) const;

  /// Largest vibration with the devices at a frequency (Hz), over all pairs of laws.
  Vibration largest(double frequency) const;

  /// Frequency (Hz) of vortex shedding in a wind of a speed (m/s); speed_of() is the inverse.
  double frequency_of(double speed) const { return strouhal_ * speed / diameter_; }
  double speed_of(double frequency) const { return frequency * diameter_ / strouhal_; }

  double diameter() const { return diameter_; }  ///< diameter of the conductor (m)
  bool knows_strain() const { return bending_.has_value(); }
  bool has_devices() const { return !devices_.empty(); }
  bool is_growing() const { return grows_; }  ///< whether no vibration is steady
  /// Young's modulus of the outer wires (Pa); NaN where it is not known.
  double outer_wire_modulus() const;

 private:
  std::array<EndResponse, 2> ends_at(double angular_frequency) const;
  Vibration vibration(const WindPowerLaw& wind, const LossLaw& loss, double frequency,
                      const std::array<EndResponse, 2>& ends) const;

  double strouhal_;
  std::vector<SpanDevice> devices_;
  bool grows_;  // unstable with the devices: no steady vibration
};

/// Fast version of `AeolianBalance::largest` for many sets of devices at fixed frequencies. Wind
/// power and self-damping on the amplitude grid of `balanced_amplitude` are computed only once.
class LargestVibration : SpanInWind {
 public:
  /// @param frequencies  frequencies (Hz) at which at() can be called
  LargestVibration(const Case& the_case, const std::vector<double>& frequencies);

  /// Largest vibration at the k-th frequency, for given responses of the two ends.
  Vibration at(std::size_t k, const std::array<EndResponse, 2>& ends) const;

 private:
  static constexpr std::size_t points = 61;
  /// Wind power minus self-damping over y² (W/m³), from the largest amplitude y of the law down.
  using Spare = std::array<double, points>;

  double spare(const WindPowerLaw& wind, const LossLaw& loss, double frequency, double y) const;
  BalancedAmplitude balance(const WindPowerLaw& wind, std::size_t of_pair, std::size_t k,
                            double taken) const;

  std::vector<double> frequencies_;
  std::vector<std::vector<Spare>> spares_;  // for each pair of laws and frequency
};

/// Number of rows with an amplitude outside the measured range of the wind law.
class RangeCount {
 public:
  void add(const AeolianRow& row, bool with_devices);
  std::string text() const;  ///< warning about these rows; empty for none

 private:
  std::int64_t below_ = 0, above_ = 0;
};

}  // namespace holdfast::program
