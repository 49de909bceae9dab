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
#include "holdfast/core/lanes.hpp"
#include "holdfast/core/select.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/math/linalg/gram_schmidt.hpp"
#include "holdfast/math/stats/batch_sums.hpp"

namespace holdfast {

/// Which exponents are computed.
enum class LyapunovScope {
  all,      ///< the whole spectrum
  largest,  ///< the first one alone, from one tangent vector
};

/// Lyapunov spectrum of the sampled loop with backlash from its contacts, a block at a time.
///
/// The exponents are those of `LyapunovSpectrum` with S and S* pushed sample by sample, but the
/// tangent vectors are multiplied by the maps of whole blocks and orthogonalised as rarely as
/// conditioning allows. Over the blocks k of a stretch B = W_k … W₁ Q = Q' R,
///
///     a = √(Σ_k ‖W_k … W₁ Q‖²) ‖R⁻¹‖
///
/// measures how far R's diagonal magnifies round-off. The length of a stretch is chosen from the
/// growth in the one before; one with a > `largest_amplification` is done again in halves, a block
/// sample by sample. The inner product is that of the balanced coordinates of
/// `ItineraryBlocks`, which the exponents are freed from when they are read. Columns that a map has
/// taken to zero are not carried on. Logarithms are taken of products of stretches, once a batch.
///
/// Work per block of six samples and vector: 25 multiply-adds (20 without processing delay); per
/// stretch a Gram–Schmidt process on 5 × 4 (5 × 5 before the first map with a null direction).
/// @tparam Number  double, or a pack: so many itineraries side by side
template <class Number>
class BlockSpectrum {
 public:
  /// The contacts of the same samples in every lane.
  using Blocks = LaneBlocks<Number>;
  /// Largest a of a stretch that is longer than a sample.
  static constexpr double largest_amplification = 5e6;
  /// Longest stretch, in blocks.
  static constexpr int most_blocks = 64;

  /// @param blocks  of the loop whose S and S* are the tangents
  /// @param scope   of `largest` the spectrum shows −∞ for all exponents but the first
  explicit BlockSpectrum(std::shared_ptr<const ItineraryBlocks> blocks,
                         LyapunovScope scope = LyapunovScope::all);

  /// Takes the contacts of the next `ItineraryBlocks::length` samples.
  void push(const Blocks& blocks) {
    pending_[static_cast<std::size_t>(count_)] = blocks;
    pending_samples_ += ItineraryBlocks::length;
    if (++count_ == planned_) close_block();
  }

  /// Forgets all but the directions of the tangent vectors after the blocks pushed and the block
  /// `open`, of any length: the exponents are those of what comes from here on.
  void restart(const Blocks& open);

  /// The spectra of all lanes over the blocks pushed and the block `open`, of any length.
  std::array<LyapunovSpectrum<double, 5>, Lanes<Number>::count> spectra(
      const Blocks& open = empty_blocks<Number>()) const;

  /// That of the first lane.
  LyapunovSpectrum<double, 5> spectrum(const Blocks& open = empty_blocks<Number>()) const {
    return spectra(open)[0];
  }

  /// Number of batches complete, for the standard errors.
  std::size_t complete_batches() const { return sums_.complete_batches(); }

 private:
  /// The basis and the logarithms of its stretches in the coordinates of the loop.
  struct Orthogonal {
    explicit Orthogonal(const BlockSpectrum& from) : alive(from.alive_) {
      basis = from.blocks_->scale().template cast<Number>().asDiagonal() * from.basis_;
      const auto stretches = orthonormalise<Number, 5>(basis, alive);
      logarithms = half_logarithms<5>(stretches.squares);
    }
    Alive<Number> alive;
    TangentBasis<Number, 5> basis;
    Vector<Number, 5> logarithms;
  };

  template <int Columns>
  static Vector<Number, Columns> half_logarithms(const Vector<Number, Columns>& squares) {
    using std::log;
    Vector<Number, Columns> result;
    for (int i = 0; i < Columns; ++i) result[i] = Number(0.5) * log(squares[i]);
    return result;
  }

  void close_with(const Blocks& open) {
    const int samples = samples_of(open[0]);
    if (samples > 0) pending_[static_cast<std::size_t>(count_++)] = open;
    pending_samples_ += samples;
    if (count_ > 0) close_block();
    take_logarithms();
  }

  LyapunovSpectrum<double, 5> read(const Orthogonal& orthogonal, std::size_t lane) const {
    const auto of_lane = [lane](const Number& pack) { return detail::lane_of(pack, lane); };
    const Vector<Number, 5> remainder = remainder_ + orthogonal.logarithms;
    LyapunovSpectrum<double, 5>::State state{orthogonal.basis.unaryExpr(of_lane), sums_.lane(lane),
                                             remainder.unaryExpr(of_lane), 0};
    state.sums.add(logarithms_.unaryExpr(of_lane), samples_);
    for (const auto& alive : alive_)
      if (of_lane(select(alive, Number(1), Number(0))) > 0) ++state.finite;
    return LyapunovSpectrum<double, 5>(state);
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

  /// Takes a stretch of blocks, in halves where round-off would grow too much, and one block sample
  /// by sample.
  template <int Reach, int Columns>
  void advance(const Blocks* blocks, int count) {
    using Basis = TangentBasis<Number, Columns>;
    Basis basis = basis_.template leftCols<Columns>();
    Eigen::Array<Number, 1, Columns> sizes = Eigen::Array<Number, 1, Columns>::Constant(Number(0));
    Alive<Number> alive = alive_;
    for (int k = 0; k < count; ++k) {
      multiply<Reach, Columns>(LaneMaps<Number>(*blocks_, blocks[k]), basis);
      for (int row = 0; row < 5; ++row) sizes += basis.row(row).array() * basis.row(row).array();
      if (columns_ > blocks_->smallest_rank()) mark_null_columns(blocks[k], alive);
    }
    const Stretches<Number, Columns> stretches = orthonormalise<Number, Columns>(basis, alive);
    const Number squared = sizes.sum() * stretches.inverse;
    const bool accurate = all(squared <= Number(largest_amplification * largest_amplification)) &&
                          within_range<Columns>(stretches.squares);
    if (accurate || (count == 1 && samples_of(blocks[0][0]) == 1)) {
      commit<Columns>(basis, alive, stretches.squares);
      learn(accurate ? largest_lane(squared) : 0.0, count);
    } else {
      split<Reach, Columns>(blocks, count);
      allowed_ = std::max(1.0, 0.5 * count);
    }
  }

  /// basis ← map · basis.
  template <int Reach, int Columns>
  static void multiply(const LaneMaps<Number>& map, TangentBasis<Number, Columns>& basis) {
    Eigen::Matrix<Number, 1, Columns> rows[5];
    for (int i = 0; i < 5; ++i) {
      rows[i] = map(i, 0) * basis.row(0);
      for (int k = 1; k < Reach; ++k) rows[i] += map(i, k) * basis.row(k);
    }
    for (int i = 0; i < 5; ++i) basis.row(i) = rows[i];
  }

  template <int Reach, int Columns>
  void split(const Blocks* blocks, int count) {
    if (count > 1) {
      advance<Reach, Columns>(blocks, count / 2);
      advance<Reach, Columns>(blocks + count / 2, count - count / 2);
      return;
    }
    for (int sample = 0; sample < samples_of(blocks[0][0]); ++sample) {
      Blocks alone;
      for (std::size_t lane = 0; lane < alone.size(); ++lane)
        alone[lane] = sample_of(blocks[0][lane], sample);
      advance<Reach, Columns>(&alone, 1);
    }
  }

  /// Marks the columns beyond the rank of a block's maps.
  void mark_null_columns(const Blocks& blocks, Alive<Number>& alive) const {
    typename Lanes<Number>::Value ranks[Lanes<Number>::count];
    for (std::size_t lane = 0; lane < blocks.size(); ++lane)
      ranks[lane] = blocks_->rank(blocks[lane]);
    const Number rank = Lanes<Number>::load(ranks);
    for (int i = blocks_->smallest_rank(); i < columns_; ++i) {
      auto& column = alive[static_cast<std::size_t>(i)];
      column = column & (rank > Number(static_cast<double>(i)));
    }
  }

  template <int Columns>
  void commit(const TangentBasis<Number, Columns>& basis, const Alive<Number>& alive,
              const Vector<Number, Columns>& squares) {
    basis_.template leftCols<Columns>() = basis;
    alive_ = alive;
    const Vector<Number, Columns> products =
        products_.template head<Columns>().cwiseProduct(squares);
    if (within_range<Columns>(products)) {
      products_.template head<Columns>() = products;
    } else {
      take_logarithms();
      logarithms_.template head<Columns>() += half_logarithms<Columns>(squares);
    }
  }

  /// Whether squared lengths are far from overflow and from losing digits to underflow.
  template <int Columns>
  static bool within_range(const Vector<Number, Columns>& squares) {
    Number smallest = squares[0], largest = squares[0];
    for (int i = 1; i < Columns; ++i) {
      smallest = select(squares[i] < smallest, Number(squares[i]), smallest);
      largest = select(squares[i] > largest, Number(squares[i]), largest);
    }
    return all(smallest > Number(1e-200)) && all(largest < Number(1e200));
  }

  void take_logarithms() {
    logarithms_ += half_logarithms<5>(products_);
    products_ = Vector<Number, 5>::Constant(Number(1));
  }

  static double largest_lane(const Number& number) {
    double values[Lanes<Number>::count];
    Lanes<Number>::store(number, values);
    return *std::max_element(std::begin(values), std::end(values));
  }

  /// Sets how many blocks may come between two orthogonalisations, from those just done.
  void learn(double squared_amplification, int count) {
    constexpr double at_start = 16.0;  // ‖I₄‖² ‖I₄‖²
    const double blocks = count;
    const double growth = std::log2(std::max(squared_amplification / at_start, 1.1)) / blocks;
    const double room = std::log2(0.8 * largest_amplification * largest_amplification / at_start);
    allowed_ = std::min(std::max(1.0, std::floor(room / growth)), 2.0 * blocks);
  }

  /// Divides what is left of a batch into equal stretches.
  void plan() {
    const auto blocks_left = (sums_.steps_left() - samples_) / ItineraryBlocks::length;
    const double left = std::max(1.0, static_cast<double>(blocks_left));
    const double most = std::min(allowed_, static_cast<double>(most_blocks));
    planned_ = static_cast<int>(std::ceil(left / std::ceil(left / most)));
  }

  std::shared_ptr<const ItineraryBlocks> blocks_;
  Eigen::Matrix<Number, 5, 5, Eigen::RowMajor> basis_ =
      Eigen::Matrix<double, 5, 5, Eigen::RowMajor>::Identity().cast<Number>();
  Alive<Number> alive_;
  int columns_;  // that are carried
  std::array<Blocks, most_blocks> pending_{};
  int count_ = 0;  // blocks pending
  int pending_samples_ = 0;
  int planned_ = 1;       // blocks of the present stretch
  double allowed_ = 1.0;  // blocks that conditioning seems to allow
  Vector<Number, 5> products_ = Vector<Number, 5>::Constant(Number(1));  // of R_ii²
  Vector<Number, 5> logarithms_ = Vector<Number, 5>::Constant(Number(0));
  std::int64_t samples_ = 0;  // since the last complete batch
  BatchSums<Number, 5> sums_;
  Vector<Number, 5> remainder_;  // −ln of the stretches from balanced coordinates at the start
};

template <class Number>
BlockSpectrum<Number>::BlockSpectrum(std::shared_ptr<const ItineraryBlocks> blocks,
                                     LyapunovScope scope)
    : blocks_(std::move(blocks)), sums_(ItineraryBlocks::length) {
  const int wanted = scope == LyapunovScope::largest ? 1 : 5;
  columns_ = std::min(wanted, blocks_->largest_rank());
  const Number one(1), zero(0);
  for (int i = 0; i < 5; ++i)
    alive_[static_cast<std::size_t>(i)] = i < columns_ ? one > zero : one < zero;
  remainder_ = -blocks_->scale().array().log().matrix().template cast<Number>();
}

template <class Number>
void BlockSpectrum<Number>::restart(const Blocks& open) {
  close_with(open);
  remainder_ = -Orthogonal(*this).logarithms;
  sums_ = BatchSums<Number, 5>(ItineraryBlocks::length);
  logarithms_ = Vector<Number, 5>::Constant(Number(0));
  samples_ = 0;
  plan();
}

template <class Number>
std::array<LyapunovSpectrum<double, 5>, Lanes<Number>::count> BlockSpectrum<Number>::spectra(
    const Blocks& open) const {
  BlockSpectrum closed = *this;
  closed.close_with(open);
  const Orthogonal orthogonal(closed);
  std::array<LyapunovSpectrum<double, 5>, Lanes<Number>::count> result;
  for (std::size_t lane = 0; lane < result.size(); ++lane)
    result[lane] = closed.read(orthogonal, lane);
  return result;
}

template <class Number>
void BlockSpectrum<Number>::close_block() {
  if (blocks_->reach() == 4) {
    advance_columns<4>();
  } else {
    advance_columns<5>();
  }
  samples_ += pending_samples_;
  count_ = 0;
  pending_samples_ = 0;
  while (columns_ > 1 && !any(alive_[static_cast<std::size_t>(columns_ - 1)])) --columns_;
  if (samples_ >= sums_.steps_left()) {
    take_logarithms();
    sums_.add(logarithms_, samples_);
    logarithms_ = Vector<Number, 5>::Constant(Number(0));
    samples_ = 0;
  }
  plan();
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template class BlockSpectrum<double>;
#endif

}  // namespace holdfast
