#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>

#include "holdfast/chaos/itinerary_blocks.hpp"
#include "holdfast/chaos/lyapunov_spectrum.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/math/linalg/gram_schmidt.hpp"
#include "holdfast/math/stats/batch_sums.hpp"

namespace holdfast {

/// Selects which Lyapunov exponents are computed.
enum class LyapunovScope {
  all,      ///< the whole spectrum
  largest,  ///< only the largest exponent, from one tangent vector
};

/// Computes the Lyapunov spectrum of the sampled loop with backlash from blocks of samples.
///
/// A block (`ItineraryBlock`) records at which of up to six successive samples the drive transmits
/// its force. The tangent map of a sample is S if the force is transmitted, else S*
/// (`SampledLoop`). The exponents equal those of `LyapunovSpectrum` with these maps. To save work,
/// the maps W_k of whole blocks multiply the tangent vectors, the columns of Q. After K blocks the
/// vectors are orthogonalised: W_K … W₁ Q = Q' R with orthonormal Q' and triangular R. The number
///
///     a = √(Σ_k ‖W_k … W₁ Q‖²) ‖R⁻¹‖,   k = 1 … K   (Frobenius norms)
///
/// measures how much round-off is amplified in the diagonal of R. The next K is chosen from it. If
/// a > `largest_amplification`, the K blocks are computed again in two halves. A single block is
/// then computed sample by sample. The vectors are orthogonalised in balanced coordinates
/// (`ItineraryBlocks`); spectrum() converts the result to the coordinates of the loop. Tangent
/// vectors that a singular map makes zero are dropped; their exponents are −∞.
///
/// Work per block and per tangent vector: 25 multiply-adds (20 without processing delay). Work per
/// orthogonalisation: that of a 5 × 4 matrix (5 × 5 until a tangent vector is dropped).
template <class Scalar>
class BlockSpectrum {
 public:
  /// The largest amplification a of round-off with which blocks are accepted without splitting.
  static constexpr double largest_amplification = 5e6;
  /// The largest number K of blocks between two orthogonalisations.
  static constexpr int most_blocks = 64;

  /// @param blocks  tangent maps of all blocks of samples, for the loop; not null
  /// @param scope   exponents to compute; with `largest`, spectrum() gives −∞ for all others
  explicit BlockSpectrum(std::shared_ptr<const ItineraryBlocks> blocks,
                         LyapunovScope scope = LyapunovScope::all);

  /// Adds the next complete block, which contains `ItineraryBlocks::length` samples.
  void push(ItineraryBlock block) {
    pending_[static_cast<std::size_t>(count_)] = block;
    pending_samples_ += ItineraryBlocks::length;
    if (++count_ == planned_) close_block();
  }

  /// Adds the incomplete block `open`. Then restarts the averages with the present tangent vectors.
  void restart(ItineraryBlock open);

  /// The Lyapunov spectrum over all blocks since the last restart and the incomplete block `open`.
  LyapunovSpectrum<double, 5> spectrum(ItineraryBlock open = empty_block) const;

 private:
  /// The tangent vectors, orthonormalised in the loop's own coordinates, with their ln |R_ii|.
  struct Orthogonal {
    explicit Orthogonal(const BlockSpectrum& from) : alive(from.alive_) {
      basis = from.blocks_->scale().asDiagonal() * from.basis_;
      const auto stretches = orthonormalise<Scalar, 5>(basis, alive);
      logarithms = half_logarithms<5>(stretches.squares);
    }
    Alive alive;
    TangentBasis<Scalar, 5> basis;
    Vector<Scalar, 5> logarithms;
  };

  template <int Columns>
  static Vector<Scalar, Columns> half_logarithms(const Vector<Scalar, Columns>& squares) {
    Vector<Scalar, Columns> result;
    for (int i = 0; i < Columns; ++i) result[i] = 0.5 * std::log(squares[i]);
    return result;
  }

  void close_with(ItineraryBlock open) {
    const int samples = samples_of(open);
    if (samples > 0) pending_[static_cast<std::size_t>(count_++)] = open;
    pending_samples_ += samples;
    if (count_ > 0) close_block();
    take_logarithms();
  }

  void close_block();

  template <int Reach>
  void advance_columns() {
    if (columns_ == 1) {
      advance<Reach, 1>(pending_.data(), count_);
    } else if (columns_ <= 4) {
      advance<Reach, 4>(pending_.data(), count_);
    } else {
      advance<Reach, 5>(pending_.data(), count_);
    }
  }

  /// Advances the tangent vectors over a stretch of blocks. Where round-off would grow too much,
  /// the stretch is split into halves or, if it is a single block, into its samples.
  template <int Reach, int Columns>
  void advance(const ItineraryBlock* blocks, int count) {
    using Basis = TangentBasis<Scalar, Columns>;
    Basis basis = basis_.template leftCols<Columns>();
    Eigen::Array<Scalar, 1, Columns> sizes = Eigen::Array<Scalar, 1, Columns>::Zero();
    Alive alive = alive_;
    for (int k = 0; k < count; ++k) {
      multiply<Reach, Columns>(blocks_->map(blocks[k]), basis);
      for (int row = 0; row < 5; ++row) sizes += basis.row(row).array() * basis.row(row).array();
      if (columns_ > blocks_->smallest_rank()) mark_null_columns(blocks[k], alive);
    }
    const Stretches<Scalar, Columns> stretches = orthonormalise<Scalar, Columns>(basis, alive);
    const Scalar squared = sizes.sum() * stretches.inverse;
    const bool accurate = squared <= largest_amplification * largest_amplification &&
                          within_range<Columns>(stretches.squares);
    if (accurate || (count == 1 && samples_of(blocks[0]) == 1)) {
      commit<Columns>(basis, alive, stretches.squares);
      learn(accurate ? squared : 0.0, count);
    } else {
      split<Reach, Columns>(blocks, count);
      allowed_ = std::max(1.0, 0.5 * count);
    }
  }

  template <int Reach, int Columns>
  static void multiply(const ItineraryBlocks::Map& map, TangentBasis<Scalar, Columns>& basis) {
    Eigen::Matrix<Scalar, 1, Columns> rows[5];
    for (int i = 0; i < 5; ++i) {
      rows[i] = map(i, 0) * basis.row(0);
      for (int k = 1; k < Reach; ++k) rows[i] += map(i, k) * basis.row(k);
    }
    for (int i = 0; i < 5; ++i) basis.row(i) = rows[i];
  }

  template <int Reach, int Columns>
  void split(const ItineraryBlock* blocks, int count) {
    if (count > 1) {
      advance<Reach, Columns>(blocks, count / 2);
      advance<Reach, Columns>(blocks + count / 2, count - count / 2);
      return;
    }
    for (int sample = 0; sample < samples_of(blocks[0]); ++sample) {
      const ItineraryBlock alone = sample_of(blocks[0], sample);
      advance<Reach, Columns>(&alone, 1);
    }
  }

  void mark_null_columns(ItineraryBlock block, Alive& alive) const {
    for (int i = blocks_->rank(block); i < columns_; ++i)
      alive[static_cast<std::size_t>(i)] = false;
  }

  template <int Columns>
  void commit(const TangentBasis<Scalar, Columns>& basis, const Alive& alive,
              const Vector<Scalar, Columns>& squares) {
    basis_.template leftCols<Columns>() = basis;
    alive_ = alive;
    const Vector<Scalar, Columns> products =
        products_.template head<Columns>().cwiseProduct(squares);
    if (within_range<Columns>(products)) {
      products_.template head<Columns>() = products;
    } else {
      take_logarithms();
      logarithms_.template head<Columns>() += half_logarithms<Columns>(squares);
    }
  }

  /// Whether squared lengths are safe from overflow and from loss of digits by underflow.
  template <int Columns>
  static bool within_range(const Vector<Scalar, Columns>& squares) {
    Scalar smallest = squares[0], largest = squares[0];
    for (int i = 1; i < Columns; ++i) {
      smallest = std::min(smallest, squares[i]);
      largest = std::max(largest, squares[i]);
    }
    return smallest > 1e-200 && largest < 1e200;
  }

  void take_logarithms() {
    logarithms_ += half_logarithms<5>(products_);
    products_ = Vector<Scalar, 5>::Ones();
  }

  /// Sets the largest number of blocks in a stretch from the amplification a in the last stretch.
  void learn(double squared_amplification, int count) {
    constexpr double at_start = 16.0;  // ‖I₄‖² ‖I₄‖²
    const double blocks = count;
    const double growth = std::log2(std::max(squared_amplification / at_start, 1.1)) / blocks;
    const double room = std::log2(0.8 * largest_amplification * largest_amplification / at_start);
    allowed_ = std::min(std::max(1.0, std::floor(room / growth)), 2.0 * blocks);
  }

  /// Plans the next stretch so that the rest of the batch is cut into stretches of equal length.
  void plan() {
    const auto blocks_left = (sums_.steps_left() - samples_) / ItineraryBlocks::length;
    const double left = std::max(1.0, static_cast<double>(blocks_left));
    const double most = std::min(allowed_, static_cast<double>(most_blocks));
    planned_ = static_cast<int>(std::ceil(left / std::ceil(left / most)));
  }

  std::shared_ptr<const ItineraryBlocks> blocks_;
  TangentBasis<Scalar, 5> basis_ = TangentBasis<Scalar, 5>::Identity();
  Alive alive_;
  int columns_;  // number of tangent vectors still carried
  std::array<ItineraryBlock, most_blocks> pending_{};
  int count_ = 0;  // blocks pending
  int pending_samples_ = 0;
  int planned_ = 1;       // blocks of the present stretch
  double allowed_ = 1.0;  // blocks that conditioning seems to allow
  Vector<Scalar, 5> products_ = Vector<Scalar, 5>::Ones();  // of R_ii²
  Vector<Scalar, 5> logarithms_ = Vector<Scalar, 5>::Zero();
  std::int64_t samples_ = 0;  // since the last complete batch
  BatchSums<Scalar, 5> sums_;
  Vector<Scalar, 5> remainder_;  // −ln of the stretches from balanced coordinates at the start
};

template <class Scalar>
BlockSpectrum<Scalar>::BlockSpectrum(std::shared_ptr<const ItineraryBlocks> blocks,
                                     LyapunovScope scope)
    : blocks_(std::move(blocks)), sums_(ItineraryBlocks::length) {
  const int wanted = scope == LyapunovScope::largest ? 1 : 5;
  columns_ = std::min(wanted, blocks_->largest_rank());
  for (int i = 0; i < 5; ++i) alive_[static_cast<std::size_t>(i)] = i < columns_;
  remainder_ = -blocks_->scale().array().log().matrix();
}

template <class Scalar>
void BlockSpectrum<Scalar>::restart(ItineraryBlock open) {
  close_with(open);
  remainder_ = -Orthogonal(*this).logarithms;
  sums_ = BatchSums<Scalar, 5>(ItineraryBlocks::length);
  logarithms_ = Vector<Scalar, 5>::Zero();
  samples_ = 0;
  plan();
}

template <class Scalar>
LyapunovSpectrum<double, 5> BlockSpectrum<Scalar>::spectrum(ItineraryBlock open) const {
  BlockSpectrum closed = *this;
  closed.close_with(open);
  const Orthogonal orthogonal(closed);
  LyapunovSpectrum<double, 5>::State state{orthogonal.basis, closed.sums_,
                                           closed.remainder_ + orthogonal.logarithms, 0};
  state.sums.add(closed.logarithms_, closed.samples_);
  state.finite = static_cast<int>(std::count(closed.alive_.begin(), closed.alive_.end(), true));
  return LyapunovSpectrum<double, 5>(state);
}

template <class Scalar>
void BlockSpectrum<Scalar>::close_block() {
  if (blocks_->reach() == 4) {
    advance_columns<4>();
  } else {
    advance_columns<5>();
  }
  samples_ += pending_samples_;
  count_ = 0;
  pending_samples_ = 0;
  while (columns_ > 1 && !alive_[static_cast<std::size_t>(columns_ - 1)]) --columns_;
  if (samples_ >= sums_.steps_left()) {
    take_logarithms();
    sums_.add(logarithms_, samples_);
    logarithms_ = Vector<Scalar, 5>::Zero();
    samples_ = 0;
  }
  plan();
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template class BlockSpectrum<double>;
#endif

}  // namespace holdfast
