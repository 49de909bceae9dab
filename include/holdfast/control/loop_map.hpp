#pragma once

#include <algorithm>
#include <cmath>

#include "holdfast/control/gains.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/plant/linear_plant.hpp"
#include "holdfast/plant/ports.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast {

/// The sampled loop of a plant of order N as one linear map over a sampling period, for any delay.
///
/// A delay δ needs k = max(1, ⌈δ/τ⌉) delayed commands, the control forces u_{j−k} … u_{j−1}. They
/// and the plant's state x_j are the loop's state y_j = [x_j; u_{j−k}; …; u_{j−1}]:
///
///     y_{j+1} = (S₀ + s K) y_j + c_y F_j,   K = P h_z + D h_v
///
/// S₀ contains A_d and Γ₁ of `SampledLoop` for the delay δ − (k − 1) τ, and the shift of the
/// commands. The columns s and c_y are the inputs of u_j and of the excitation F_j. Γ₀ is in s for
/// k = 1 and in S₀ for k > 1. The rows h_z and h_v give the measured displacement and velocity. The
/// loop is asymptotically stable if and only if all eigenvalues λ of S₀ + s K have |λ| < 1. For two
/// masses and k = 1, S₀ + s K is the map S of `SampledLoop`.
template <class Scalar>
struct LoopMap {
  Sampling<Scalar> sampling;                  ///< period τ and delay δ; δ may exceed τ
  Eigen::Index held_commands;                 ///< number k of delayed commands, ≥ 1
  Matrix<Scalar, Eigen::Dynamic> open_map;    ///< map S₀ without feedback, (N + k) × (N + k)
  Matrix<Scalar, Eigen::Dynamic> increment;   ///< S₀ − I, accurate even for small τ
  Vector<Scalar, Eigen::Dynamic> command;     ///< input column s per newton of u_j, (N + k) × 1
  Vector<Scalar, Eigen::Dynamic> excitation;  ///< column c_y per newton of held F_j, (N + k) × 1
  RowVector<Scalar, Eigen::Dynamic> displacement;  ///< row h_z, measured displacement (m)
  RowVector<Scalar, Eigen::Dynamic> velocity;      ///< row h_v, measured velocity (m/s)
  RowVector<Scalar, Eigen::Dynamic> conductor;     ///< row of the conductor's displacement (m)

  /// The number of states N + k.
  Eigen::Index size() const { return open_map.rows(); }

  /// Map S₀ + s (P h_z + D h_v) of the closed loop, (N + k) × (N + k).
  Matrix<Scalar, Eigen::Dynamic> closed_map(const PdGains<Scalar>& gains) const {
    return open_map + command * (gains.proportional * displacement + gains.differential * velocity);
  }

  /// The matrix closed_map − I, (N + k) × (N + k), accurate even for small τ.
  Matrix<Scalar, Eigen::Dynamic> closed_increment(const PdGains<Scalar>& gains) const {
    return increment +
           command * (gains.proportional * displacement + gains.differential * velocity);
  }
};

/// The number k = max(1, ⌈δ/τ⌉) of delayed commands for the delay δ and the sampling period τ. A
/// ratio δ/τ within a relative 10⁻¹² of a whole number counts as that number.
/// @throws InvalidParameter unless τ > 0 and 0 ≤ δ ≤ 10⁹ τ
inline int held_commands(const Sampling<double>& sampling) {
  require_positive("sampling period tau", sampling.period, "s");
  require_within("processing delay", sampling.processing_delay, "s", 0.0, 1e9 * sampling.period);
  const double ratio = sampling.processing_delay / sampling.period;
  const double whole = std::round(ratio);
  const double samples = std::abs(ratio - whole) <= 1e-12 * whole ? whole : std::ceil(ratio);
  return samples > 1.0 ? static_cast<int>(samples) : 1;
}

namespace detail {

/// The map with k delayed commands, (k − 1) τ ≤ δ ≤ k τ. For whole δ/τ there are two such k.
template <class Plant, class Scalar>
LoopMap<Scalar> loop_map_keeping(const Plant& plant, const Sampling<Scalar>& sampling, int k) {
  const Scalar past = std::min(
      sampling.period,
      std::max(Scalar(0), Scalar(sampling.processing_delay - Scalar(k - 1) * sampling.period)));
  const auto loop = sampled_loop(plant, {sampling.period, past});
  const auto ports = ports_of(plant);
  const Eigen::Index n = loop.transition.rows(), size = n + k;

  const auto row = [&](const auto& of) {
    RowVector<Scalar, Eigen::Dynamic> result = RowVector<Scalar, Eigen::Dynamic>::Zero(size);
    result.head(n) = of;
    return result;
  };
  LoopMap<Scalar> map;
  map.sampling = sampling;
  map.held_commands = k;
  map.open_map = Matrix<Scalar, Eigen::Dynamic>::Zero(size, size);
  map.open_map.topLeftCorner(n, n) = loop.transition;
  map.open_map.col(n).head(n) = loop.previous_force;
  for (Eigen::Index i = 0; i + 1 < k; ++i) map.open_map(n + i, n + i + 1) = Scalar(1);
  map.command = Vector<Scalar, Eigen::Dynamic>::Zero(size);
  map.command[size - 1] = Scalar(1);
  if (k == 1) {
    map.command.head(n) = loop.present_force;
  } else {
    map.open_map.col(n + 1).head(n) = loop.present_force;
  }
  map.increment = map.open_map - Matrix<Scalar, Eigen::Dynamic>::Identity(size, size);
  map.increment.topLeftCorner(n, n) = loop.increment;
  map.excitation = row(loop.held_excitation.transpose()).transpose();
  map.displacement = row(ports.measured_displacement);
  map.velocity = row(ports.measured_velocity);
  map.conductor = row(ports.displacement);
  return map;
}

}  // namespace detail

/// The map of a plant's sampled loop over one sampling period, for any delay.
/// @param plant     plant of any order; `ports_of(plant)` gives its measured quantities
/// @param sampling  period τ (s), > 0, and delay δ (s), 0 ≤ δ ≤ 1000 τ
/// @throws InvalidParameter where τ or δ is out of range, or the plant is not admissible
template <class Plant, class Scalar = ScalarOf<Plant>>
LoopMap<Scalar> loop_map(const Plant& plant, const Sampling<detail::Undeduced<Scalar>>& sampling) {
  require_positive("sampling period tau", static_cast<double>(sampling.period), "s");
  require_within("processing delay", static_cast<double>(sampling.processing_delay), "s", 0.0,
                 1000.0 * static_cast<double>(sampling.period));
  return detail::loop_map_keeping<Plant, Scalar>(
      plant, sampling,
      held_commands(
          {static_cast<double>(sampling.period), static_cast<double>(sampling.processing_delay)}));
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template LoopMap<double> loop_map(const TwoMass<double>&, const Sampling<double>&);
extern template LoopMap<double> loop_map(const LinearPlant<double>&, const Sampling<double>&);
#endif

}  // namespace holdfast
