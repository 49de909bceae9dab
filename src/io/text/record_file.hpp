#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "holdfast/math/signal/decay_measures.hpp"

namespace holdfast::program {

/// A force on the conductor as it was recorded.
struct ForceRecord {
  std::vector<double> times;   // s, ascending
  std::vector<double> forces;  // N
};

/// A record in a CSV file: the columns `time_s` and, of a decay, `displacement_m`, of a force
/// `force_N`, in any order and beside any others.
///
/// Throws WrongInput, with file and line where there is one: what read_csv() refuses, no such
/// column, an empty cell, text in a number, a number that is not finite, time that does not ascend,
/// or too few instants, eight of a decay and two of a force. A decay must start displaced.
DecayRecord read_decay_file(const std::filesystem::path& file);
ForceRecord read_force_record(const std::filesystem::path& file);

/// Reads a record from a text; `name` stands for the file in messages.
DecayRecord read_decay_text(const std::string& text, const std::string& name);
ForceRecord read_force_text(const std::string& text, const std::string& name);

/// The step of time (s) that nine of ten steps do not exceed; of two instants or more.
double usual_step(const std::vector<double>& times);

/// Words on the first gap, a step of more than three usual ones; empty where there is none.
std::string gap_text(const std::vector<double>& times);

}  // namespace holdfast::program
