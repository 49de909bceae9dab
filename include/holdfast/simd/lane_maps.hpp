#pragma once

#include <cstddef>
#include <utility>

#include "holdfast/chaos/itinerary_blocks.hpp"
#include "holdfast/simd/pack.hpp"

namespace holdfast {

/// The maps of as many blocks as a pack has lanes, entry by entry side by side.
template <class Architecture>
class LaneMaps<xsimd::batch<double, Architecture>> {
  using Number = xsimd::batch<double, Architecture>;

 public:
  /// Refers to maps of `blocks`, which must outlive this; one block a lane.
  LaneMaps(const ItineraryBlocks& blocks, const LaneBlocks<Number>& lanes) {
    for (std::size_t lane = 0; lane < Number::size; ++lane)
      maps_[lane] = blocks.map(lanes[lane]).data();
  }

  /// The entry of every lane's T⁻¹ M T, 0 ≤ row, column < 5.
  Number operator()(int row, int column) const {
    return entry(static_cast<std::size_t>(5 * row + column),
                 std::make_index_sequence<Number::size>());
  }

 private:
  template <std::size_t... Lane>
  Number entry(std::size_t index, std::index_sequence<Lane...> /*lanes*/) const {
    return Number{maps_[Lane][index]...};
  }

  const double* maps_[Number::size];
};

}  // namespace holdfast
