#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "holdfast/control/gains.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/math/linalg/balancing.hpp"

namespace holdfast {

/// The contacts at 0 … `ItineraryBlocks::length` successive samples as a binary number: a leading
/// 1, then a digit per sample, earliest first: 1 if the drive transmits its force, else 0.
using ItineraryBlock = std::uint8_t;

/// The block that contains no sample.
inline constexpr ItineraryBlock empty_block = 1;

/// The number of samples of a block.
constexpr int samples_of(ItineraryBlock block) {
  int samples = 0;
  for (unsigned rest = block; rest > 1; rest /= 2) ++samples;
  return samples;
}

/// A block extended by one sample. `engaged`: whether the force is transmitted at that sample.
constexpr ItineraryBlock followed_by(ItineraryBlock block, bool engaged) {
  return static_cast<ItineraryBlock>(2 * block + (engaged ? 1 : 0));
}

/// Extracts one sample of a block as a block of its own; `sample` = 0 … samples_of(block) − 1.
constexpr ItineraryBlock sample_of(ItineraryBlock block, int sample) {
  return followed_by(empty_block, ((block >> (samples_of(block) - 1 - sample)) & 1) != 0);
}

/// The tangent maps of all blocks (`ItineraryBlock`), for deviations of [z; u_{j−1}]: the state
/// z = [z₁, ż₁, z₂, ż₂] of the two masses and the drive's force at the previous sample. The map of
/// a block is the product of its samples' 5 × 5 maps: S where the force is transmitted, S* in the
/// backlash (`SampledLoop`). The maps are stored in balanced coordinates, as products of T⁻¹ S T
/// and T⁻¹ S* T. T is diagonal; its powers of two give all coordinates similar sizes.
class ItineraryBlocks {
 public:
  static constexpr int length = 6;  ///< largest number of samples in a block
  /// The type of a tangent map, stored row by row.
  using Map = Eigen::Matrix<double, 5, 5, Eigen::RowMajor>;

  /// @param engaged   map S over one sampling period in which the force is transmitted
  /// @param backlash  map S* over one sampling period in the backlash
  template <class Scalar>
  ItineraryBlocks(const Matrix<Scalar, 5>& engaged, const Matrix<Scalar, 5>& backlash);

  /// @param tangent_loop  loop whose maps S and S* are used
  /// @param gains         controller gains P (N/m) and D (N s/m)
  template <class Scalar>
  ItineraryBlocks(const SampledLoop<Scalar>& tangent_loop, const PdGains<Scalar>& gains)
      : ItineraryBlocks(tangent_loop.engaged_map(gains), tangent_loop.backlash_map()) {}

  /// The map T⁻¹ M T of a block. M is the product of its samples' maps, the last sample leftmost.
  const Map& map(ItineraryBlock block) const { return maps_[block]; }

  /// The smallest rank (to working precision) of the maps S, S* of a block's samples; 5 if empty.
  int rank(ItineraryBlock block) const { return ranks_[block]; }
  /// The smaller of the ranks of S and S*.
  int smallest_rank() const { return std::min(ranks_[2], ranks_[3]); }
  /// The larger of the ranks of S and S*; at most that many Lyapunov exponents are finite.
  int largest_rank() const { return std::max(ranks_[2], ranks_[3]); }

  /// The number of coordinates the maps depend on: 4 if column 5 of S and S* is zero, else 5.
  int reach() const { return reach_; }
  /// The diagonal of the balancing matrix T.
  const Vector<double, 5>& scale() const { return scale_; }

 private:
  static constexpr std::size_t blocks = std::size_t{2} << length;

  template <class Scalar>
  void add_contact(std::size_t block, const Matrix<Scalar, 5>& map) {
    ranks_[block] = static_cast<int>(Eigen::FullPivLU<Matrix<Scalar, 5>>(map).rank());
    maps_[block] = scale_.cwiseInverse().asDiagonal() * map * scale_.asDiagonal();
  }

  Vector<double, 5> scale_;
  std::array<Map, blocks> maps_;
  std::array<int, blocks> ranks_{};
  int reach_ = 5;
};

template <class Scalar>
ItineraryBlocks::ItineraryBlocks(const Matrix<Scalar, 5>& engaged,
                                 const Matrix<Scalar, 5>& backlash)
    : scale_(balancing<Scalar, 5>(engaged.cwiseAbs() + backlash.cwiseAbs())) {
  maps_[0] = maps_[1] = Map::Identity();
  ranks_[0] = ranks_[1] = 5;
  add_contact(2, backlash);
  add_contact(3, engaged);
  for (std::size_t block = 4; block < blocks; ++block) {
    maps_[block] = maps_[2 + block % 2] * maps_[block / 2];
    ranks_[block] = std::min(ranks_[2 + block % 2], ranks_[block / 2]);
  }
  reach_ = engaged.col(4).isZero(0.0) && backlash.col(4).isZero(0.0) ? 4 : 5;
}

/// Whether a block is complete: it has `ItineraryBlocks::length` samples.
constexpr bool is_whole(ItineraryBlock block) { return block >> ItineraryBlocks::length != 0; }

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template ItineraryBlocks::ItineraryBlocks(const Matrix<double, 5>&,
                                                 const Matrix<double, 5>&);
#endif

}  // namespace holdfast
