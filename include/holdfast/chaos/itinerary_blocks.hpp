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

/// The contacts of 0 … `ItineraryBlocks::length` consecutive samples as a binary number: a leading
/// 1, then one digit for each sample in order, 1 where the force is transmitted.
using ItineraryBlock = std::uint8_t;

/// The empty block, without any sample.
inline constexpr ItineraryBlock empty_block = 1;

/// The number of samples of a block.
constexpr int samples_of(ItineraryBlock block) {
  int samples = 0;
  for (unsigned rest = block; rest > 1; rest /= 2) ++samples;
  return samples;
}

/// A block extended by one more sample; `engaged`: whether the force is transmitted there.
constexpr ItineraryBlock followed_by(ItineraryBlock block, bool engaged) {
  return static_cast<ItineraryBlock>(2 * block + (engaged ? 1 : 0));
}

/// A block of one sample: the one with the index `sample` in `block`, 0 … samples_of(block) − 1.
constexpr ItineraryBlock sample_of(ItineraryBlock block, int sample) {
  return followed_by(empty_block, ((block >> (samples_of(block) - 1 - sample)) & 1) != 0);
}

/// The tangent maps of all blocks, for the state z and the previous force u_{j−1}. The map of a
/// block is a product of one 5 × 5 matrix per sample: S where the force is transmitted, else S*.
///
/// The maps are stored in balanced coordinates, as products of T⁻¹ S T and T⁻¹ S* T. The diagonal
/// matrix T of powers of two gives displacements, velocities and forces similar sizes.
class ItineraryBlocks {
 public:
  static constexpr int length = 6;  ///< number of samples in the longest blocks
  /// A tangent map, stored row by row.
  using Map = Eigen::Matrix<double, 5, 5, Eigen::RowMajor>;

  /// @param engaged   S, the map of [z; u_{j−1}] over a sample while the force is transmitted
  /// @param backlash  S*, the map in the backlash
  template <class Scalar>
  ItineraryBlocks(const Matrix<Scalar, 5>& engaged, const Matrix<Scalar, 5>& backlash);

  /// @param tangent_loop  loop whose maps S and S* are used
  /// @param gains         controller gains P (N/m) and D (N s/m)
  template <class Scalar>
  ItineraryBlocks(const SampledLoop<Scalar>& tangent_loop, const PdGains<Scalar>& gains)
      : ItineraryBlocks(tangent_loop.engaged_map(gains), tangent_loop.backlash_map()) {}

  /// The map T⁻¹ M T, where M is the product of the block's S and S*, the last sample's leftmost.
  const Map& map(ItineraryBlock block) const { return maps_[block]; }

  /// The smallest rank, to working precision, among the S and S* of a block; 5 for an empty block.
  int rank(ItineraryBlock block) const { return ranks_[block]; }
  /// The smaller of the ranks of S and S*.
  int smallest_rank() const { return std::min(ranks_[2], ranks_[3]); }
  /// The larger of the ranks of S and S*; at most that many Lyapunov exponents are finite.
  int largest_rank() const { return std::max(ranks_[2], ranks_[3]); }

  /// The number of coordinates in use: 4 if neither S nor S* depends on the last, u_{j−1}; else 5.
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

/// Whether a block has the largest number of samples.
constexpr bool is_whole(ItineraryBlock block) { return block >> ItineraryBlocks::length != 0; }

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template ItineraryBlocks::ItineraryBlocks(const Matrix<double, 5>&,
                                                 const Matrix<double, 5>&);
#endif

}  // namespace holdfast
