#pragma once

#include <cmath>
#include <complex>
#include <limits>
#include <vector>

#include "holdfast/control/gains.hpp"
#include "holdfast/control/loop_map.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/core/interval.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/math/linalg/spectral_radius.hpp"
#include "holdfast/math/poly/polynomial.hpp"
#include "holdfast/plant/linear_plant.hpp"
#include "holdfast/plant/ports.hpp"
#include "holdfast/stability/boundary/circle_crossings.hpp"
#include "holdfast/stability/boundary/stable_intervals.hpp"
#include "holdfast/stability/margins/sampling_family.hpp"
#include "holdfast/stability/polynomial/characteristic_polynomial.hpp"
#include "holdfast/stability/polynomial/loop_polynomial.hpp"

namespace holdfast {

/// The open intervals of one gain, P (N/m) or D (N s/m), in which the loop of two masses is stable
/// for a fixed value of the other gain. They are computed in closed form (`stable_intervals`).
/// @param loop   loop from `sampled_loop`
/// @param free   the gain that varies
/// @param gains  gains, of which only the fixed one is used
/// @throws InvalidParameter where the polynomial of the loop or the fixed gain is not finite
template <class Scalar>
std::vector<Interval<Scalar>> stable_gains(const SampledLoop<Scalar>& loop, FreeGain free,
                                           const PdGains<detail::Undeduced<Scalar>>& gains) {
  const auto polynomial = characteristic_polynomial(loop);
  return free == FreeGain::differential ? stable_differential_gains(polynomial, gains.proportional)
                                        : stable_proportional_gains(polynomial, gains.differential);
}

/// The loop of a computer without velocity sensor: D multiplies the backward difference (z_j −
/// z_{j−1})/τ of displacement readings z_j. It has one state more than `map`, the previous reading.
/// @param map  the same loop with a velocity sensor
template <class Scalar>
LoopMap<Scalar> with_velocity_by_difference(const LoopMap<Scalar>& map) {
  const Eigen::Index n = map.size();
  LoopMap<Scalar> other = map;
  for (Matrix<Scalar, Eigen::Dynamic>* square : {&other.open_map, &other.increment}) {
    square->conservativeResizeLike(Matrix<Scalar, Eigen::Dynamic>::Zero(n + 1, n + 1));
    square->bottomLeftCorner(1, n) = map.displacement;
  }
  other.increment(n, n) = Scalar(-1);
  for (Vector<Scalar, Eigen::Dynamic>* column : {&other.command, &other.excitation})
    column->conservativeResizeLike(Vector<Scalar, Eigen::Dynamic>::Zero(n + 1));
  for (RowVector<Scalar, Eigen::Dynamic>* row : {&other.displacement, &other.conductor})
    row->conservativeResizeLike(RowVector<Scalar, Eigen::Dynamic>::Zero(n + 1));
  other.velocity = other.displacement / map.sampling.period;
  other.velocity[n] = -Scalar(1) / map.sampling.period;
  return other;
}

/// The open intervals of D (N s/m) in which all roots λ of a loop of any order have |λ| < radius.
/// They are computed as the `stable_gains` of a loop with the roots λ/radius.
/// @param map                loop from `loop_map`
/// @param proportional_gain  P (N/m), finite
/// @param radius             upper limit of |λ|, > 0
/// @throws InvalidParameter where P is not finite
template <class Scalar>
std::vector<Interval<Scalar>> differential_gains_within_radius(
    LoopMap<Scalar> map, const detail::Undeduced<Scalar>& proportional_gain,
    const detail::Undeduced<Scalar>& radius) {
  const Scalar offset = radius - Scalar(1);
  map.open_map /= Scalar(1) + offset;
  map.command /= Scalar(1) + offset;
  map.increment.diagonal().array() -= offset;
  map.increment /= Scalar(1) + offset;
  return stable_gains(map, FreeGain::differential, {proportional_gain, Scalar(0)});
}

namespace detail {

/// The sampled loop of a plant: a `SampledLoop` for two masses, a `LoopMap` for any other plant.
template <class Plant>
auto loop_of(const Plant& plant, const Sampling<double>& sampling) {
  if constexpr (has_closed_forms<Plant>) {
    validate(sampling);
    return sampled_loop(plant, sampling);
  } else {
    return loop_map(plant, sampling);
  }
}

/// The plant in a form with `Ports` (inputs and outputs): the plant itself, or `linear_plant` for
/// two masses. The loop of a plant with ports may have a delay of many samples.
template <class Plant>
decltype(auto) with_ports(const Plant& plant) {
  if constexpr (has_closed_forms<Plant>) {
    return linear_plant(plant);
  } else {
    return (plant);
  }
}

/// The roots s (1/s) of the continuous loop without delay, the limit of the sampled loop for τ → 0.
/// With zero gains they are the poles of the plant.
template <class Plant>
auto continuous_roots(const Plant& plant, const PdGains<double>& gains) {
  if constexpr (has_closed_forms<Plant>) {
    return roots(characteristic_polynomial(plant).at(gains));
  } else {
    return balanced_eigenvalues<double, Eigen::Dynamic>(
        plant.state_matrix() + plant.control_input() * ports_of(plant).feedback_row(
                                                           gains.proportional, gains.differential));
  }
}

/// The period 2π/|s| (s) of the plant's slowest mode, from its pole with the least |s| > 0.
template <class Plant>
double slowest_mode_period(const Plant& plant) {
  double slowest = std::numeric_limits<double>::infinity();
  for (const std::complex<double>& pole : continuous_roots(plant, {0.0, 0.0})) {
    if (std::abs(pole) > 0.0) slowest = std::min(slowest, std::abs(pole));
  }
  return 2.0 * pi<double> / slowest;
}

}  // namespace detail

}  // namespace holdfast
