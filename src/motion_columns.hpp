#pragma once

#include <vector>

#include "csv.hpp"

namespace holdfast::program {

/// The columns of a motion at its samples: those of `simulate` and of an orbit's trace.
inline std::vector<Column> motion_columns() {
  return {{"time_s", "s", "t = j tau"},
          {"z1_m", "m", "displacement of the conductor, positive downward"},
          {"v1_m_per_s", "m/s", "velocity of the conductor"},
          {"z2_m", "m", "displacement of the absorber, positive downward"},
          {"v2_m_per_s", "m/s", "velocity of the absorber"},
          {"control_force_N", "N", "force decided at this sample; 0 in the backlash"},
          {"in_backlash", "", "1: the drive is in its backlash, 0: it transmits", "integer"}};
}

}  // namespace holdfast::program
