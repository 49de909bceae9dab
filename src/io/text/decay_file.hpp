#pragma once

#include <filesystem>
#include <string>

#include "holdfast/math/signal/decay_measures.hpp"

namespace holdfast::program {

/// A decay record from a CSV file with the columns `time_s` and `displacement_m`, in any order and
/// beside any others.
///
/// Throws WrongInput, with file and line where there is one: what read_csv() refuses, no such
/// column, an empty cell, text in a number, a number that is not finite, time that does not ascend,
/// a gap (a step of more than one and a half times the median step), fewer than eight instants, or
/// a first displacement of 0.
DecayRecord read_decay_file(const std::filesystem::path& file);

/// The same from a text; `name` stands for the file in messages.
DecayRecord read_decay_text(const std::string& text, const std::string& name);

}  // namespace holdfast::program
