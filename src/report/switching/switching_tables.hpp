#pragma once

#include <string>
#include <vector>

#include "process/job_context.hpp"
#include "report/switching/switching_figures.hpp"
#include "report/switching/switching_study.hpp"

namespace holdfast::program {

/// Tables of the report's part about switching, FOLDER/data/NAME.csv with metadata. All throw what
/// Table throws.
/// @param context  its output is the report's folder

/// A row a motion; its columns are those that MotionColumn numbers.
void write_motions(const JobContext& context, const std::string& name,
                   const std::vector<StudiedMotion>& motions);

/// A row a phase, the strips one after the other.
void write_strips(const JobContext& context, const std::string& name,
                  const std::vector<ContactStrip>& strips);

/// A row an instant: time, then Δz, command and transmitted force of either motion.
void write_window(const JobContext& context, const std::string& name, const MotionWindow& exact,
                  const MotionWindow& sampled);

}  // namespace holdfast::program
