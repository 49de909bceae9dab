#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "case/case.hpp"

namespace holdfast::program {

/// The impedance of a device, force divided by velocity, measured at its clamp. The phase is
/// positive if the force leads the velocity.
struct ImpedanceTable {
  std::vector<double> frequency;  // Hz, ascending
  std::vector<double> magnitude;  // N s/m
  std::vector<double> phase_deg;
  int projected = 0;              // number of rows whose real part was below 0 and is set to 0
  double least_real_share = 0.0;  // least real part of these rows / magnitude, <= 0
};

/// Reads a CSV file with columns `frequency_Hz`, `magnitude_N_s_per_m`, `phase_deg` in any order.
///
/// Throws WrongInput with the file and, if any, the line: for what read_csv() refuses, a missing
/// column, an empty cell, text in a number, a number that is not finite, a frequency that is not
/// above 0 or does not ascend, a magnitude below 0, a phase beyond ±360 degrees, fewer than two
/// rows, and a real part below −2 % of the magnitude, since no passive device gives power. A
/// smaller negative real part, an error of about a degree of phase, is set to 0.
ImpedanceTable read_impedance_table(const std::filesystem::path& file);

/// Reads the table from a text; `name` replaces the file name in messages.
ImpedanceTable read_impedance_text(const std::string& text, const std::string& name);

/// Doubts about measured devices: a line for real parts that were set to 0, and a line for phases
/// that are probably in radians, the largest being between 0.5 and 2 pi.
std::vector<std::string> impedance_doubts(const Case& the_case);

}  // namespace holdfast::program
