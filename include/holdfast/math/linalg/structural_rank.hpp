#pragma once

#include <algorithm>
#include <array>

#include "holdfast/core/compiler.hpp"

namespace holdfast {

/// The quantities that a loop stores beside the state z of its plant until they act.
enum class Carried : unsigned {
  in_force = 1,  ///< the command in force
  pending = 2,   ///< the command decided, which is not in force yet
  anchor = 4,    ///< position of the gap
  reading = 8,   ///< the displacement read at the last sample
};

/// The rank of a product of tangent maps from their zero pattern alone (structural rank).
///
/// The maps of a loop have zeros in known places. For almost every choice of the other entries the
/// rank of their product is the number of disjoint paths from its inputs to its outputs, which is
/// the smallest number of variables that cut all paths. Every cut consists of the independent
/// directions of z at some instant (four, or three in stick) and of the stored quantities that act
/// later. Among the cuts with the same set of quantities that may still act only the smallest is
/// kept.
///
/// No tolerance is involved; a coincidence of the entries themselves is not detected.
/// Sources: B. Lindström, Bull. London Math. Soc. 5 (1973); K. Murota, Matrices and Matroids for
/// Systems Analysis, 2000, secs. 2.2–2.3.
/// Work: 16 comparisons for each call.
class StructuralRank {
 public:
  /// @param carried  stored quantities that are inputs of the first map beside z, as bits
  explicit StructuralRank(unsigned carried) : carried_(carried) { least_.fill(none); }

  /// Adds an instant at which z has the given number of independent directions.
  void pass(int directions) {
    int& cut = least_[carried_];
    cut = std::min(cut, directions);
  }

  /// Begins to store a quantity, a function of z and of the quantities stored at this instant.
  void begin(Carried quantity) { carried_ |= bit(quantity); }

  /// Lets a quantity act on z; it may act again later.
  void act(Carried quantity) { eliminate(quantity, 1, 0); }

  /// Ends the storage of a quantity.
  void end(Carried quantity) {
    eliminate(quantity, 0, 0);
    carried_ &= ~bit(quantity);
  }

  /// Renames a stored quantity: it is continued as another quantity.
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

  /// Removes a quantity from all sets that contain it, at `cost`, or replaces it by `other` (bits).
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
