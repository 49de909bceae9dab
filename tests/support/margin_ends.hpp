#pragma once

#include <array>
#include <functional>
#include <utility>

#include "holdfast/control/loop_map.hpp"
#include "holdfast/math/linalg/spectral_radius.hpp"
#include "holdfast/stability/margins/margins.hpp"

namespace holdfast::test {

/// Margins of D, P, τ and δ, in this order.
inline std::array<TwoSidedMargin, 4> two_sided_of(const StabilityMargins& margins) {
  return {margins.differential_gain, margins.proportional_gain, margins.sampling_period,
          margins.processing_delay};
}

/// One quantity of a loop as it is moved: its margin, its value, and ρ at another value.
struct Moved {
  const char* name;
  TwoSidedMargin margin;
  double value;
  std::function<double(double)> radius;
};

/// D, P, τ and δ of a loop, with ρ by the eigenvalues of its map, the commands on their way being
/// states.
template <class Plant>
std::array<Moved, 4> all_moved(const StabilityMargins& margins, const Plant& plant,
                               const Sampling<double>& sampling, const PdGains<double>& gains) {
  const auto radius = [plant](const Sampling<double>& s, const PdGains<double>& g) {
    return spectral_radius(loop_map(plant, s).closed_map(g));
  };
  const auto [p, d] = std::pair(gains.proportional, gains.differential);
  const auto [tau, delta] = std::pair(sampling.period, sampling.processing_delay);
  const auto [of_d, of_p, of_period, of_delay] = two_sided_of(margins);
  return {{{"D", of_d, d,
            [=, p = p](double x) {
              return radius(sampling, {p, x});
            }},
           {"P", of_p, p,
            [=, d = d](double x) {
              return radius(sampling, {x, d});
            }},
           {"period", of_period, tau,
            [=, share = delta / tau](double x) {
              return radius({x, share * x}, gains);
            }},
           {"delay", of_delay, delta, [=, tau = tau](double x) {
              return radius({tau, x}, gains);
            }}}};
}

}  // namespace holdfast::test
