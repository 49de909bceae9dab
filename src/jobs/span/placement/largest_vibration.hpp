#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "case/case.hpp"
#include "case/model/span/span_of_case.hpp"
#include "holdfast/span/end_response.hpp"
#include "holdfast/span/wind/wind_power_law.hpp"
#include "jobs/span/aeolian_amplitudes.hpp"

namespace holdfast::program {

/// `AeolianBalance::largest` of one set of devices after another, at frequencies that are known:
/// what wind and conductor say by each pair of laws is computed once, on the grid on which
/// `balanced_amplitude` looks.
class LargestVibration {
 public:
  /// @param frequencies  Hz
  LargestVibration(const Case& the_case, const std::vector<double>& frequencies);

  /// With ends that answer to the k-th frequency.
  Vibration at(std::size_t k, const std::array<EndResponse, 2>& ends) const;

 private:
  static constexpr std::size_t points = 61;
  /// What is left for devices (W/m³) at amplitudes from the largest of a law of the wind downward.
  using Spare = std::array<double, points>;

  double spare(const WindPowerLaw& wind, const LossLaw& loss, double frequency, double y) const;
  BalancedAmplitude balance(const WindPowerLaw& wind, std::size_t of_pair, std::size_t k,
                            double taken) const;

  TautString<double> string_;
  double diameter_, wind_share_;
  std::vector<LossLaw> losses_;
  std::optional<ClampBending> bending_;
  std::vector<double> frequencies_;
  std::vector<std::vector<Spare>> spares_;  // of each pair, at each frequency
};

}  // namespace holdfast::program
