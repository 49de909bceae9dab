#pragma once

#include <string>
#include <vector>

namespace holdfast::program {

/// A force on the conductor as it was recorded.
struct ForceRecord {
  std::vector<double> times;   // s, ascending
  std::vector<double> forces;  // N
};

/// The record in a CSV file with the columns `time_s` and `force_N`, in any order and beside any
/// others.
///
/// Throws WrongInput, with file and line where there is one: what read_csv() refuses, no such
/// column, an empty cell, text in a number, a number that is not finite, time that does not ascend,
/// or fewer than two instants.
ForceRecord read_force_record(const std::string& path);

/// The same from a text; `name` stands for the file in messages.
ForceRecord read_force_text(const std::string& text, const std::string& name);

}  // namespace holdfast::program
