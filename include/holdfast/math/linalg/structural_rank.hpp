#pragma once

#include <algorithm>
#include <array>

#include "holdfast/core/compiler.hpp"

namespace holdfast {

/// Numbers that a loop carries beside the state z of its plant, unchanged until it acts.
enum class Carried : unsigned {
  in_force = 1,  ///< the command in force
  pending = 2,   ///< the command decided, which is not in force yet
  anchor = 4,    ///< where the gap lies
  reading = 8,   ///< the displacement read at the last sample
};

/// How many directions a product of tangent maps leaves, by what acts on what alone.
///
/// The maps of a loop have zeros in known places. For almost every choice of the other entries the
/// rank of their product is the number of disjoint paths from its inputs to its outputs, or the
/// fewest variables that cut all paths. Every cut consists of the independent directions of z at
/// some instant, four, or three while the drive sticks, and of those carried quantities that act
/// later. Of the cuts with the same set of quantities whose future is not known yet only the
/// cheapest is kept.
///
/// No tolerance takes part; a coincidence of the entries themselves is not seen.
/// Sources: B. Lindström, Bull. London Math. Soc. 5 (1973); K. Murota, Matrices and Matroids for
/// Systems Analysis, 2000, secs. 2.2–2.3.
/// Work: 16 comparisons for each call.
class StructuralRank {
 public:
  /// @param carried  which quantities are inputs of the first map beside z, by their bits
  explicit StructuralRank(unsigned carried) : carried_(carried) { least_.fill(none); }

  /// An instant at which z has so many independent directions.
  void pass(int directions) {
    int& cut = least_[carried_];
    cut = std::min(cut, directions);
  }

  /// A quantity becomes a function of what is known at this instant.
  void begin(Carried quantity) { carried_ |= bit(quantity); }

  /// A quantity acts on z, and may go on doing so.
  void act(Carried quantity) { eliminate(quantity, 1, 0); }

  /// A quantity is given up.
  void end(Carried quantity) {
    eliminate(quantity, 0, 0);
    carried_ &= ~bit(quantity);
  }

  /// A quantity is given up, and lives on in another one that is new.
  void become(Carried quantity, Carried other) {
    eliminate(quantity, 0, bit(other));
    if ((carried_ & bit(quantity)) != 0) carried_ = (carried_ & ~bit(quantity)) | bit(other);
  }

  /// The rank, all that is carried at this instant counting as output.
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

  /// Takes a quantity out of all sets that hold it, at a cost, or puts another one in its place.
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
