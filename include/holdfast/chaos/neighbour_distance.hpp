#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "holdfast/chaos/classification.hpp"
#include "holdfast/core/errors.hpp"

namespace holdfast {

/// Computes the final distance of a nearby motion y from a motion x, as a share of the extent: the
/// mean of |x_i − y_i| over the last quarter of the samples, divided by max x_i − min x_i. i is the
/// coordinate with the largest quotient. After the transient y starts at the state of x, but with
/// the conductor's displacement z₁ increased by `neighbour_start` times the extent of z₁.
///
/// The result shows sensitive dependence on the initial state without tangent maps: it grows to the
/// order of 1 if nearby motions separate exponentially, and stays small on an invariant torus.
/// @param motion     SampledMotion, EventMotion or ModalMotion before a sample; passed by value
/// @param transient  samples left out at the start, ≥ 2; their second half gives the extent of z₁
/// @param samples    number of samples of both motions after the transient, ≥ 4
/// @return the distance; nullopt where z₁ is constant or a state is not finite
/// @throws InvalidParameter where `transient` or `samples` is too small
template <class Motion>
std::optional<double> neighbour_distance(Motion motion, std::int64_t transient,
                                         std::int64_t samples) {
  require_within("transient", static_cast<double>(transient), "samples", 2.0, 1e15);
  require_within("number of samples", static_cast<double>(samples), "", 4.0, 1e15);
  double lowest = motion.readings().displacement(motion.state()), highest = lowest;
  for (std::int64_t j = 0; j < transient; ++j) {
    motion.sense();
    motion.advance();
    const double z = motion.readings().displacement(motion.state());
    lowest = 2 * j < transient ? z : std::min(lowest, z);
    highest = 2 * j < transient ? z : std::max(highest, z);
  }
  if (!(highest > lowest) || !std::isfinite(highest - lowest)) return std::nullopt;
  Motion neighbour = motion;
  neighbour.displace_conductor(neighbour_start * (highest - lowest));
  auto low = motion.state(), high = low;
  auto apart = (0.0 * low).eval();
  const std::int64_t kept = samples / 4;
  for (std::int64_t j = 0; j < samples; ++j) {
    for (Motion* const one : {&motion, &neighbour}) {
      one->sense();
      one->advance();
    }
    low = low.cwiseMin(motion.state());
    high = high.cwiseMax(motion.state());
    if (j >= samples - kept) apart += (motion.state() - neighbour.state()).cwiseAbs();
  }
  const auto extent = (high - low).array().eval();
  const auto largest = low.cwiseAbs().cwiseMax(high.cwiseAbs()).array().eval();
  const auto mean = (apart.array() / static_cast<double>(kept)).eval();
  const double share = (extent > 1e-13 * largest).select(mean / extent, 0.0).maxCoeff();
  return std::isfinite(share) ? std::optional<double>(share) : std::nullopt;
}

}  // namespace holdfast
