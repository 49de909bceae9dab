#pragma once

#include <vector>

#include "holdfast/motion/event_motion.hpp"
#include "jobs/columns.hpp"
#include "output/table.hpp"

namespace holdfast::program {

/// Columns of a motion at its samples, for `simulate` and `orbit --trace`. With exact switching a
/// column for the contact mode is added.
inline std::vector<Column> motion_columns(Switching switching = Switching::sampled) {
  return columns_of(switching == Switching::exact ? "motion between samples" : "motion");
}

/// Writes a sample of a motion under motion_columns(switching).
inline void write_motion_row(Table& table, Switching switching, const EventSample& row) {
  const auto& z = row.state;
  const int in_backlash = row.mode == ContactMode::engaged ? 0 : 1;
  if (switching == Switching::exact)
    table.row(row.time, z[0], z[1], z[2], z[3], row.control_force, in_backlash, word_for(row.mode));
  else
    table.row(row.time, z[0], z[1], z[2], z[3], row.control_force, in_backlash);
}

}  // namespace holdfast::program
