#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "holdfast/math/linalg/exponential.hpp"
#include "holdfast/math/signal/decay_measures.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast {

/// The free decay z(t) = e^{At} z(0) of the plant from rest, without control. Conductor and
/// absorber are both displaced by z₀, as after the removal of a load on the conductor.
/// @param plant         an admissible plant
/// @param displacement  z₀ (m)
/// @param time          t (s), ≥ 0
/// @throws InvalidParameter where the plant is not admissible; z₀ and t are unchecked
template <class Scalar>
Vector<Scalar, 4> free_decay_at(const TwoMass<Scalar>& plant, const Scalar& displacement,
                                const Scalar& time) {
  detail::require_admissible(plant);
  const Matrix<Scalar, 4> exponent = plant.state_matrix() * time;
  return exponential(exponent) *
         Vector<Scalar, 4>(displacement, Scalar(0), displacement, Scalar(0));
}

/// The displacements z₁ (m) of a free decay at ascending instants `times` (s). Both masses are
/// released from `displacement` (m) at the first instant. The transition matrix e^{Ah} is computed
/// again only where the interval h changes.
/// @throws InvalidParameter unless the plant is admissible and the times are finite and ascending
template <class Scalar>
std::vector<Scalar> free_decay(const TwoMass<Scalar>& plant, const Scalar& displacement,
                               const std::vector<double>& times) {
  detail::require_admissible(plant);
  holdfast::detail::require_ascending(times);
  std::vector<Scalar> displacements;
  if (times.empty()) return displacements;
  displacements.reserve(times.size());
  Vector<Scalar, 4> state(displacement, Scalar(0), displacement, Scalar(0));
  displacements.push_back(state[0]);
  const Matrix<Scalar, 4> generator = plant.state_matrix();
  Matrix<Scalar, 4> transition = Matrix<Scalar, 4>::Identity();
  double interval = 0.0;
  for (std::size_t k = 1; k < times.size(); ++k) {
    const double step = times[k] - times[k - 1];
    if (!(std::abs(step - interval) <= 1e-9 * interval)) {
      interval = step;
      const Matrix<Scalar, 4> exponent = generator * Scalar(interval);
      transition = exponential(exponent);
    }
    state = (transition * state).eval();
    displacements.push_back(state[0]);
  }
  return displacements;
}

/// Measures of a free decay, with displacements relative to the initial displacement.
template <class Scalar>
struct RelativeDecay {
  Scalar first_peak;             ///< first opposite peak over the initial displacement, < 0
  Scalar first_peak_time;        ///< time of the first opposite peak (s)
  Scalar period;                 ///< mean period of the first two cycles (s)
  Scalar logarithmic_decrement;  ///< logarithmic decrement per cycle, from the first four peaks
};

/// Zero crossings and peaks of the plant's free decay from 1 m over four periods, 400 samples each.
/// The period here is that of both masses, rigidly joined, on the conductor's spring.
/// @throws InvalidParameter where the plant is not admissible
template <class Scalar>
DecayEvents free_decay_events(const TwoMass<Scalar>& plant) {
  detail::require_admissible(plant);
  constexpr int samples_per_period = 400, periods = 4;
  const double period =
      2.0 * pi<double> *
      std::sqrt((plant.conductor_mass + plant.absorber_mass) / plant.conductor_stiffness);
  DecayRecord record;
  for (int k = 0; k <= periods * samples_per_period; ++k)
    record.times.push_back(k * period / samples_per_period);
  record.displacements = free_decay(plant, Scalar(1), record.times);
  return decay_events(record);
}

/// The measures of a free decay, accurate to round-off, for any number type. Each zero crossing or
/// peak found in samples is refined by Newton's method on the closed-form motion.
/// @param plant   the two masses, without control
/// @param events  crossings and peaks: `free_decay_events` of the same plant
/// @return nullopt for fewer than five zero crossings or four peaks in four periods (overdamped)
template <class Scalar>
std::optional<RelativeDecay<Scalar>> relative_decay(const TwoMass<Scalar>& plant,
                                                    const DecayEvents& events) {
  if (events.crossings.size() < 5 || events.peaks.size() < 4) return std::nullopt;
  const Matrix<Scalar, 4> generator = plant.state_matrix();
  // Where the component `order` of (z₁, ż₁) vanishes: Newton's method.
  const auto settled = [&](double near, int order) {
    Scalar time(near);
    for (int step = 0; step < 3; ++step) {
      const Vector<Scalar, 4> state = free_decay_at(plant, Scalar(1), time);
      const Vector<Scalar, 4> rate = generator * state;
      time -= state[order] / rate[order];
    }
    return time;
  };
  std::array<Scalar, 4> peaks;
  RelativeDecay<Scalar> decay;
  for (std::size_t k = 0; k < peaks.size(); ++k) {
    const Scalar time = settled(events.peaks[k].time, 1);
    if (k == 0) decay.first_peak_time = time;
    peaks[k] = free_decay_at(plant, Scalar(1), time)[0];
  }
  decay.first_peak = peaks[0];
  decay.period = (settled(events.crossings[4], 0) - settled(events.crossings[0], 0)) / Scalar(2);
  decay.logarithmic_decrement = logarithmic_decrement(peaks);
  return decay;
}

}  // namespace holdfast
