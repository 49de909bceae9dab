#pragma once

#include <algorithm>
#include <array>

#include "holdfast/core/compiler.hpp"

namespace holdfast {

/// The quantities that a sampled loop stores besides the state z of the plant; z depends on them
/// later. The values are bits, which can be combined.
enum class Carried : unsigned {
  in_force = 1,  ///< control command (force) that acts on the plant now
  pending = 2,   ///< control command that was computed, but acts only after the processing delay
  anchor = 4,  ///< z₂ − z₁ (m) at the last reversal of the drive, the origin of the backlash gap
  reading = 8,  ///< displacement measured at the last sample
};

/// The structural rank of the product of a sampled loop's linearised maps: the rank for almost all
/// values of the nonzero entries, given which entries are zero.
///
/// This rank is the largest number of disjoint paths along nonzero entries from the inputs of the
/// first map to the outputs of the last map. It equals the size of a minimal cut, the smallest set
/// of variables that meets every path. The cuts examined consist of the plant's state z at one
/// instant and of the stored quantities (`Carried`) that affect z later. A loss of rank at special
/// values of the entries is not detected. No tolerance is involved.
/// Sources: B. Lindström, Bull. London Math. Soc. 5 (1973); K. Murota, Matrices and Matroids for
/// Systems Analysis, 2000, secs. 2.2–2.3.
/// Work: 16 comparisons for each call of a member function.
class StructuralRank {
 public:
  /// Starts a product. @param carried  bitwise OR of the `Carried` stored before the first map
  explicit StructuralRank(unsigned carried) : carried_(carried) { least_.fill(none); }

  /// Adds an instant to the product, as a possible place of the cut.
  /// @param directions  number of independent entries of z: all, or one fewer in stick (ż₁ = ż₂)
  void pass(int directions) {
    int& cut = least_[carried_];
    cut = std::min(cut, directions);
  }

  /// Begins to store a quantity that is computed from z and the stored quantities of this instant.
  void begin(Carried quantity) { carried_ |= bit(quantity); }

  /// Records that a stored quantity affects z now; the quantity remains stored.
  void act(Carried quantity) { eliminate(quantity, 1, 0); }

  /// Ends the storage of a quantity that affects z no longer.
  void end(Carried quantity) {
    eliminate(quantity, 0, 0);
    carried_ &= ~bit(quantity);
  }

  /// Turns a stored quantity into `other`, for instance a pending command into the one in force.
  void become(Carried quantity, Carried other) {
    eliminate(quantity, 0, bit(other));
    if ((carried_ & bit(quantity)) != 0) carried_ = (carried_ & ~bit(quantity)) | bit(other);
  }

  /// The structural rank of the product so far, with z and the stored quantities as outputs. Call
  /// it only after a pass().
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
