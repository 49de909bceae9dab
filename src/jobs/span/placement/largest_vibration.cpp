#include "jobs/span/placement/largest_vibration.hpp"

#include <algorithm>
#include <cmath>

#include "case/model/modal/conductor_modes.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/math/roots/bracketing_root.hpp"
#include "holdfast/span/wind/energy_balance.hpp"
#include "holdfast/span/wind/turbulence.hpp"
#include "process/interrupt.hpp"

namespace holdfast::program {
namespace {

/// y/d of a point of the grid.
double share_of_diameter(const WindPowerLaw& wind, std::size_t point, std::size_t points) {
  if (point + 1 == points) return wind.lowest;
  return wind.highest * std::pow(wind.lowest / wind.highest,
                                 static_cast<double>(point) / static_cast<double>(points - 1));
}

}  // namespace

LargestVibration::LargestVibration(const Case& the_case, const std::vector<double>& frequencies)
    : string_(string_of(the_case)),
      diameter_(the_case.conductor.diameter),
      wind_share_(turbulent_share(the_case.site.turbulence_intensity)),
      losses_(loss_laws_of(the_case)),
      bending_(clamp_bending_of(the_case)),
      frequencies_(frequencies) {
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
  return {largest, bending_ ? bending_->strain_of_angle(sharpest_angle(ends) * largest.amplitude)
                            : std::nan("")};
}

}  // namespace holdfast::program
