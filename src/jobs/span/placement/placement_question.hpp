#pragma once

#include <cstddef>

#include "holdfast/core/axis.hpp"

namespace holdfast::program {

/// What a device is placed for.
enum class PlacementGoal {
  strain,  ///< the least of the largest strains in the wind over a band
  ratio,   ///< the most of the least inverse standing-wave ratios over a band
  modes    ///< the most of the least damping ratios of some modes
};

/// What is asked of the placement of one device of a case.
struct PlacementQuestion {
  std::size_t device = 0;  ///< its number from 1; 0: the absorber with its computer
  PlacementGoal goal = PlacementGoal::strain;
  Axis frequencies{5.0, 60.0, 56};    ///< Hz, of the band
  int first_mode = 1, last_mode = 1;  ///< of the goal `modes`
  bool moves_position = true;         ///< else it stays where it is
  double margin = 0.5;                ///< modulus margin that gains must keep, 0 … 1
  bool is_absorber() const { return device == 0; }
};

}  // namespace holdfast::program
