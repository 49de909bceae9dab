#pragma once

#include <algorithm>
#include <array>

#include "holdfast/core/compiler.hpp"

namespace holdfast {

/// The quantities, besides the plant's state z, that a sampled loop stores until they affect z.
enum class Carried : unsigned {
  in_force = 1,  ///< the command in force
  pending = 2,   ///< the command computed but not yet in force
  anchor = 4,    ///< position of the gap: z₂ − z₁ (m) at the last reversal of the drive
  reading = 8,   ///< the displacement read at the last sample
};

/// The structural rank of a product of linearised maps: its rank for almost every choice of the
/// nonzero entries, given which entries are zero.
///
/// This rank is the largest number of disjoint paths along nonzero entries from the inputs of the
/// first map to the outputs of the last. It equals the size of a minimal cut, the smallest set of
/// variables that meets every path. A cut consists of z at one instant and of the quantities stored
/// at this instant that affect z later. A loss of rank at special values of the entries is not
/// detected. No tolerance is involved.
/// Sources: B. Lindström, Bull. London Math. Soc. 5 (1973); K. Murota, Matrices and Matroids for
/// Systems Analysis, 2000, secs. 2.2–2.3.
/// Work: 16 comparisons for each call of a member function.
class StructuralRank {
 public:
  /// Starts a product. @param carried  bitwise OR of the quantities stored before the first map
  explicit StructuralRank(unsigned carried) : carried_(carried) { least_.fill(none); }

  /// Adds an instant. @param directions  number of independent entries of z: 4, or 3 if sticking
  void pass(int directions) {
    int& cut = least_[carried_];
    cut = std::min(cut, directions);
  }

  /// Begins to store a quantity that depends on z and on the quantities stored at this instant.
  void begin(Carried quantity) { carried_ |= bit(quantity); }

  /// Lets a stored quantity affect z; the quantity remains stored.
  void act(Carried quantity) { eliminate(quantity, 1, 0); }

  /// Ends the storage of a quantity that will not affect z any more.
  void end(Carried quantity) {
    eliminate(quantity, 0, 0);
    carried_ &= ~bit(quantity);
  }

  /// Renames a stored quantity to `other`; it remains stored.
  void become(Carried quantity, Carried other) {
    eliminate(quantity, 0, bit(other));
    if ((carried_ & bit(quantity)) != 0) carried_ = (carried_ & ~bit(quantity)) | bit(other);
  }

  /// The product's rank so far, with z and the stored quantities as outputs; call after pass().
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

  /// Replaces `quantity` by `other` (bit; 0: none) in sets that contain it; adds `cost` to the cut.
  void eliminate(Carried quantity, int cost, unsigned other) {
    for (unsigned set = 0; set < sets; ++set) {
      if ((set & bit(quantity)) == 0 || least_[set] == none) continue;
      int& cut = least_[(set & ~bit(quantity)) | other];
      cut = std::min(cut, least_[set] + cost);
      least_[set] = none;
    }
  }

  unsigned carried_;
  std::array<int, sets> least_;  // smallest cut for each set of quantities that may still act
};

}  // namespace holdfast
