#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "case/job_context.hpp"
#include "holdfast/contact/contact.hpp"
#include "holdfast/core/types.hpp"

namespace holdfast::program {

/// Question to a map.
struct MotionCellsQuestion {
  std::vector<std::string> axes;  ///< KEY=MIN:MAX:COUNT, two
  std::int64_t largest_period;    ///< of a motion, samples
  Switching switching;
  bool each_motion;                                 ///< a row for each motion of each cell
  std::vector<Vector<double, 4>> more_starts = {};  ///< beside the case's initial state
};

/// Writes the periodic motions of a case of two masses in the cells of a plane of two keys: what
/// the case's initial state comes to, and how many coexist.
/// Throws WrongInput where the keys or their ranges are not admissible.
void write_motion_cells(const JobContext& context, const MotionCellsQuestion& question);

}  // namespace holdfast::program
