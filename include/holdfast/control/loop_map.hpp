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
/// A delay δ = (k − 1) τ + δ′, 0 < δ′ ≤ τ, keeps k = max(1, ⌈δ/τ⌉) commands on their way. With
/// y_j = [x_j; u_{j−k}; …; u_{j−1}], N + k numbers,
///
///     y_{j+1} = (S₀ + s K) y_j + c_y F_j,   K = P h_z + D h_v
///
/// where S₀ holds A_d, Γ₁ and Γ₀ of δ′ and the shift of the commands, s says how u_j enters, and
/// h_z, h_v read what is measured. k = 1 is S of `SampledLoop`. All |λ(S₀ + s K)| < 1 ⇔
/// asymptotically stable.
template <class Scalar>
struct LoopMap {
  Sampling<Scalar> sampling;                  ///< τ and δ; δ may exceed τ
  Eigen::Index held_commands;                 ///< k, ≥ 1
  Matrix<Scalar, Eigen::Dynamic> open_map;    ///< S₀, (N + k) × (N + k)
  Matrix<Scalar, Eigen::Dynamic> increment;   ///< S₀ − I, to full relative accuracy for any τ
  Vector<Scalar, Eigen::Dynamic> command;     ///< s, (N + k) × 1 per newton of u_j
  Vector<Scalar, Eigen::Dynamic> excitation;  ///< c_y, (N + k) × 1 per newton of F_j, held
  RowVector<Scalar, Eigen::Dynamic> displacement;  ///< h_z, 1 × (N + k): what P multiplies
  RowVector<Scalar, Eigen::Dynamic> velocity;      ///< h_v, 1 × (N + k): what D multiplies
  RowVector<Scalar, Eigen::Dynamic> conductor;     ///< reads z (m) of the conductor, 1 × (N + k)

  /// N + k.
  Eigen::Index size() const { return open_map.rows(); }

  /// S₀ + s (P h_z + D h_v), (N + k) × (N + k).
  Matrix<Scalar, Eigen::Dynamic> closed_map(const PdGains<Scalar>& gains) const {
    return open_map + command * (gains.proportional * displacement + gains.differential * velocity);
  }

  /// S₀ − I + s (P h_z + D h_v), (N + k) × (N + k): its eigenvalues are λ − 1.
  Matrix<Scalar, Eigen::Dynamic> closed_increment(const PdGains<Scalar>& gains) const {
    return increment +
           command * (gains.proportional * displacement + gains.differential * velocity);
  }
};

/// k = max(1, ⌈δ/τ⌉), the commands on their way; a delay of a whole number of samples, up to the
/// round-off of decimal numbers, keeps just that many.
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

/// The map that keeps k commands, (k − 1) τ ≤ δ ≤ k τ: where δ is a whole number of samples, that
/// of either side of it.
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

/// The map of a plant's loop over a sampling period.
/// @param plant     any order; its ports say what is measured
/// @param sampling  τ > 0 and δ ≥ 0, which may exceed τ by up to 1000 samples
/// @throws InvalidParameter where the sampling is another or the state matrix is not finite
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
