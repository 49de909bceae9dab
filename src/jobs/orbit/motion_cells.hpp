#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "case/job_context.hpp"
#include "holdfast/contact/contact.hpp"
#include "holdfast/core/types.hpp"

namespace holdfast::program {

/// Options of a map of periodic motions over two keys.
struct MotionCellsQuestion {
  std::vector<std::string> axes;  ///< two texts KEY=MIN:MAX:COUNT
  std::int64_t largest_period;    ///< longest period searched (samples)
  Switching switching;
  std::vector<Vector<double, 4>> more_starts = {};  ///< further initial states
};

/// Writes the periodic motions of a two-mass case in each cell of a grid over two keys: the motion
/// from the case's initial state, and the number of coexisting motions.
/// Throws WrongInput where the keys or their ranges are not admissible.
void write_motion_cells(const JobContext& context, const MotionCellsQuestion& question);

}  // namespace holdfast::program
