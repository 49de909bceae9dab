#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "holdfast/math/signal/decay_measures.hpp"

namespace holdfast::program {

/// A recorded force on the conductor.
struct ForceRecord {
  std::vector<double> times;   // s, ascending
  std::vector<double> forces;  // N
};

/// Reads a record from a CSV file. Its columns are `time_s` and `displacement_m` for a decay,
/// `time_s` and `force_N` for a force; their order and further columns do not matter.
///
/// Throws WrongInput, with file and line if possible, in the cases of read_csv(), and for a missing
/// column, an empty cell, a cell that is not a finite number, times that do not ascend, fewer than
/// eight rows of a decay or two of a force, or a decay with an initial displacement of 0.
DecayRecord read_decay_file(const std::filesystem::path& file);
ForceRecord read_force_record(const std::filesystem::path& file);

/// Reads a record from a text; messages give `name` as the file.
DecayRecord read_decay_text(const std::string& text, const std::string& name);
ForceRecord read_force_text(const std::string& text, const std::string& name);

/// The time step (s) that nine tenths of the steps do not exceed; needs at least two instants.
double usual_step(const std::vector<double>& times);

/// Message about the first gap, a step of more than three usual_step(); empty if there is none.
std::string gap_text(const std::vector<double>& times);

}  // namespace holdfast::program
