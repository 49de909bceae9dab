#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "case/case.hpp"

namespace holdfast::program {

/// The impedance of a device as it was measured at its clamp: force over velocity, whose phase is
/// by how much the force is ahead.
struct ImpedanceTable {
  std::vector<double> frequency;  // ascending
  std::vector<double> magnitude;  // N s/m
  std::vector<double> phase_deg;
  int projected = 0;              // rows whose real part was below 0 and is taken as 0
  double least_real_share = 0.0;  // theirs, of the magnitude
};

/// A table in a CSV file: the columns `frequency`, `magnitude_N_s_per_m` and `phase_deg`, in any
/// order and beside any others.
///
/// Throws WrongInput, with file and line where there is one: what read_csv() refuses, no such
/// column, an empty cell, text in a number, a number that is not finite, a frequency that is not
/// above 0 or does not ascend, a magnitude below 0, a phase beyond 360 degrees, fewer than two
/// rows, and an impedance whose real part is below 0 by more than 2 % of its magnitude, since no
/// passive device gives power. Below 0 by less, as about a degree of phase makes it, it is 0.
ImpedanceTable read_impedance_table(const std::filesystem::path& file);

/// Reads a table from a text; `name` stands for the file in messages.
ImpedanceTable read_impedance_text(const std::string& text, const std::string& name);

/// Doubts about each measured device: a line where real parts were taken as 0, and one where its
/// phases are probably in radians, since none is beyond 2 pi though some are beyond half of one.
std::vector<std::string> impedance_doubts(const Case& the_case);

}  // namespace holdfast::program
