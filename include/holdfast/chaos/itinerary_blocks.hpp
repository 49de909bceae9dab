#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "holdfast/control/gains.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/core/lanes.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/math/linalg/balancing.hpp"

namespace holdfast {

/// The contacts of 0 … `ContactWords::length` consecutive samples: a 1, then one binary digit a
/// sample, the first sample's highest, 1 where the force is transmitted. 1 is the empty word.
using ContactWord = std::uint8_t;

/// Number of samples of a word.
constexpr int samples_of(ContactWord word) {
  int samples = 0;
  for (unsigned rest = word; rest > 1; rest /= 2) ++samples;
  return samples;
}

/// The word of one sample more.
constexpr ContactWord followed_by(ContactWord word, bool engaged) {
  return static_cast<ContactWord>(2 * word + (engaged ? 1 : 0));
}

/// The first `samples` samples of a word that has at least as many.
constexpr ContactWord first_of(ContactWord word, int samples) {
  return static_cast<ContactWord>(word >> (samples_of(word) - samples));
}

/// The last `samples` samples of a word that has at least as many.
constexpr ContactWord last_of(ContactWord word, int samples) {
  const unsigned end = 1U << samples;
  return static_cast<ContactWord>((word & (end - 1)) | end);
}

/// The tangent maps of every word: products of two constant 5 × 5 matrices, S where the force is
/// transmitted and S* in the backlash.
///
/// The products are those of T⁻¹ S T and T⁻¹ S* T, T diagonal with powers of two that balance
/// |S| + |S*|: displacements, velocities and forces get about the same size, without rounding.
class ContactWords {
 public:
  static constexpr int length = 6;  ///< samples of the longest words
  /// A tangent map with contiguous rows.
  using Map = Eigen::Matrix<double, 5, 5, Eigen::RowMajor>;

  /// @param engaged   S
  /// @param backlash  S*
  /// @tparam Scalar  `double`; a template so that only who calls it compiles it
  template <class Scalar>
  ContactWords(const Matrix<Scalar, 5>& engaged, const Matrix<Scalar, 5>& backlash);

  /// @param tangent_loop  whose S and S* are the tangents
  /// @param gains         P (N/m) and D (N s/m)
  template <class Scalar>
  ContactWords(const SampledLoop<Scalar>& tangent_loop, const PdGains<Scalar>& gains)
      : ContactWords(tangent_loop.engaged_map(gains), tangent_loop.backlash_map()) {}

  /// T⁻¹ M T, M the product of the word's maps, the last sample's leftmost.
  const Map& map(ContactWord word) const { return maps_[word]; }

  /// Smallest rank of the word's maps, each to working precision.
  int rank(ContactWord word) const { return ranks_[word]; }
  /// The smaller of the ranks of S and S*.
  int smallest_rank() const { return std::min(ranks_[2], ranks_[3]); }
  /// The larger of them: no more exponents than this are finite.
  int largest_rank() const { return std::max(ranks_[2], ranks_[3]); }

  /// 4 where both maps ignore the last coordinate, as without a processing delay; else 5.
  int reach() const { return reach_; }
  /// The diagonal of T.
  const Vector<double, 5>& scale() const { return scale_; }

 private:
  static constexpr std::size_t words = std::size_t{2} << length;

  template <class Scalar>
  void add_contact(std::size_t word, const Matrix<Scalar, 5>& map) {
    ranks_[word] = static_cast<int>(Eigen::FullPivLU<Matrix<Scalar, 5>>(map).rank());
    maps_[word] = scale_.cwiseInverse().asDiagonal() * map * scale_.asDiagonal();
  }

  Vector<double, 5> scale_;
  std::array<Map, words> maps_;
  std::array<int, words> ranks_{};
  int reach_ = 5;
};

template <class Scalar>
ContactWords::ContactWords(const Matrix<Scalar, 5>& engaged, const Matrix<Scalar, 5>& backlash)
    : scale_(balancing<Scalar, 5>(engaged.cwiseAbs() + backlash.cwiseAbs())) {
  maps_[0] = maps_[1] = Map::Identity();
  ranks_[0] = ranks_[1] = 5;
  add_contact(2, backlash);
  add_contact(3, engaged);
  for (std::size_t word = 4; word < words; ++word) {
    maps_[word] = maps_[2 + word % 2] * maps_[word / 2];
    ranks_[word] = std::min(ranks_[2 + word % 2], ranks_[word / 2]);
  }
  reach_ = engaged.col(4).isZero(0.0) && backlash.col(4).isZero(0.0) ? 4 : 5;
}

/// Whether a word is one of the longest.
constexpr bool is_whole(ContactWord word) { return word >> ContactWords::length != 0; }

/// The words of all lanes; they have the same number of samples.
template <class Number>
using LaneWords = std::array<ContactWord, Lanes<Number>::count>;

/// The empty word in every lane.
template <class Number>
constexpr LaneWords<Number> no_contacts() {
  LaneWords<Number> words{};
  for (auto& word : words) word = 1;
  return words;
}

/// Reads the maps of the lanes' words side by side; a pack type brings its own.
template <class Number>
class LaneMaps {
 public:
  /// Refers to a map of `words`, which must outlive this.
  LaneMaps(const ContactWords& words, const LaneWords<Number>& lanes) : map_(words.map(lanes[0])) {}
  /// Entry of T⁻¹ M T, 0 ≤ row, column < 5.
  const Number& operator()(int row, int column) const { return map_(row, column); }

 private:
  const ContactWords::Map& map_;
};

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template ContactWords::ContactWords(const Matrix<double, 5>&, const Matrix<double, 5>&);
#endif

}  // namespace holdfast
