#pragma once

#include <algorithm>
#include <array>

#include "holdfast/core/compiler.hpp"

namespace holdfast {

/// The quantities that a loop stores beside the state z of its plant until they affect z.
enum class Carried : unsigned {
  in_force = 1,  ///< the command in force
  pending = 2,   ///< the command that is computed but not in force yet
  anchor = 4,    ///< position of the gap: Δz (m) at the last reversal of the drive
  reading = 8,   ///< the displacement read at the last sample
};

/// The rank of a product of tangent maps from their zero pattern alone (structural rank).
///
/// The maps of a loop have zeros in known places. For almost every choice of the other entries the
/// rank of their product is the number of disjoint paths from its inputs to its outputs, which is
/// the smallest number of variables that cut all paths. Every cut consists of the independent
/// directions of z at some instant (four, or three in stick) and of the stored quantities that act
/// later. For each set of quantities that may still act only the smallest cut is kept.
///
/// No tolerance is involved; a coincidence of the entries themselves is not detected.
/// Sources: B. Lindström, Bull. London Math. Soc. 5 (1973); K. Murota, Matrices and Matroids for
/// Systems Analysis, 2000, secs. 2.2–2.3.
/// Work: 16 comparisons for each call.
class StructuralRank {
 public:
  /// @param carried  stored quantities that are inputs of the first map in addition to z, as bits
  explicit StructuralRank(unsigned carried) : carried_(carried) { least_.fill(none); }

  /// Adds an instant at which z has the given number of independent directions.
  void pass(int directions) {
    int& cut = least_[carried_];
    cut = std::min(cut, directions);
  }

  /// Begins to store a quantity, which depends on z and on the quantities stored at this instant.
  void begin(Carried quantity) { carried_ |= bit(quantity); }

  /// Lets a stored quantity affect z; the quantity remains stored.
  void act(Carried quantity) { eliminate(quantity, 1, 0); }

  /// Ends the storage of a quantity that will not affect z any more.
  void end(Carried quantity) {
    eliminate(quantity, 0, 0);
    carried_ &= ~bit(quantity);
  }

  /// Renames a stored quantity to `other`, under which it stays stored.
  void become(Carried quantity, Carried other) {
    eliminate(quantity, 0, bit(other));
    if ((carried_ & bit(quantity)) != 0) carried_ = (carried_ & ~bit(quantity)) | bit(other);
  }

  /// The rank of the product so far; its outputs are z and the quantities stored at this instant.
  int rank() const {
    int least = none;
    for (unsigned set = 0; set < sets; ++set) least = std::min(least, least_[set] + size_of(set));
    return least;
  }

 private:
  static constexpr unsigned sets = 16;
  static constexpr int none = 99;

  static constexpr unsigned bit(Carried quantity) { return static_cast<unsigned>(quantity); }
  static constexpr int size_of(unsigned set) {
    return static_cast<int>((set & 1U) + (set >> 1U & 1U) + (set >> 2U & 1U) + (set >> 3U & 1U));
  }

  /// Replaces a quantity by `other` (bits; 0: none) in all sets and raises their cuts by `cost`.
  void eliminate(Carried quantity, int cost, unsigned other) {
    for (unsigned set = 0; set < sets; ++set) {
      if ((set & bit(quantity)) == 0 || least_[set] == none) continue;
      int& cut = least_[(set & ~bit(quantity)) | other];
      cut = std::min(cut, least_[set] + cost);
      least_[set] = none;
    }
  }

  unsigned carried_;
  std::array<int, sets> least_;  // by the set of carried quantities that may yet act
};

}  // namespace holdfast
