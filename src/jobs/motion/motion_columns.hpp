#pragma once

#include <vector>

#include "holdfast/contact/contact_mode.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/motion/implemented_loop.hpp"
#include "io/text/csv.hpp"
#include "io/text/table.hpp"

namespace holdfast::program {

/// The columns of a motion at its samples: those of `simulate` and of an orbit's trace. Where the
/// contact may change between the samples its mode is told too.
inline std::vector<Column> motion_columns(Switching switching = Switching::sampled) {
  std::vector<Column> columns = {
      {"time_s", "s", "t = j tau"},
      {"z1_m", "m", "displacement of the conductor, positive downward"},
      {"v1_m_per_s", "m/s", "velocity of the conductor"},
      {"z2_m", "m", "displacement of the absorber, positive downward"},
      {"v2_m_per_s", "m/s", "velocity of the absorber"},
      {"control_force_N", "N", "force decided at this sample; 0 in the backlash"},
      {"in_backlash", "", "1: the drive is in its backlash, 0: it transmits", "integer"}};
  if (switching == Switching::exact) {
    columns[5].description = "force transmitted from this sample on; 0 in the gap";
    columns[6].description = "1: the drive crosses its gap or sticks, 0: it is engaged";
    columns.push_back({"mode", "", "from this sample on: engaged, gap or stick", "string"});
  }
  return columns;
}

/// One sample of a motion.
struct MotionRow {
  double time;  // s
  Vector<double, 4> state;
  double force;  // N
  ContactMode mode;
};

/// Writes it under motion_columns(switching).
inline void write_motion_row(Table& table, Switching switching, const MotionRow& row) {
  const auto& z = row.state;
  const int in_backlash = row.mode == ContactMode::engaged ? 0 : 1;
  if (switching == Switching::exact)
    table.row(row.time, z[0], z[1], z[2], z[3], row.force, in_backlash, word_for(row.mode));
  else
    table.row(row.time, z[0], z[1], z[2], z[3], row.force, in_backlash);
}

}  // namespace holdfast::program
