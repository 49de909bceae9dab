#include "case/device/impedance_table.hpp"

#include <algorithm>
#include <cmath>

#include "holdfast/core/types.hpp"
#include "io/file/whole_file.hpp"
#include "io/text/csv.hpp"
#include "process/errors.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

constexpr const char* frequency_column = "frequency_Hz";
constexpr const char* magnitude_column = "magnitude_N_s_per_m";
constexpr const char* phase_column = "phase_deg";

/// Least admissible Re Z/|Z|, for measured phases with errors of about a degree.
constexpr double smallest_real_share = -0.02;

/// Size of a cosine that counts as 0: at 90 degrees, as of a mass, it rounds to either side of 0.
constexpr double round_off = 1e-9;

double real_share(double phase) { return std::cos(phase * pi<double> / 180.0); }

void require_passive(const CsvTable& table, std::size_t row, double magnitude, double phase) {
  const double share = real_share(phase);
  if (magnitude == 0.0 || share >= smallest_real_share) return;
  throw table.fault(
      row, "at " + format_number(table.number(row, frequency_column)) +
               " Hz the real part of the impedance is " + format_rounded(magnitude * share) +
               " N s/m, below 0, but a passive device gives no power; phase_deg must be the phase "
               "by which the force on the device leads its velocity (not its displacement or "
               "acceleration, and not the phase of the reaction force)");
}

/// Sets the real part of an impedance to 0 if it is below 0.
void project(ImpedanceTable& impedance, std::size_t row) {
  double& phase = impedance.phase_deg[row];
  const double share = real_share(phase);
  if (share >= -round_off || impedance.magnitude[row] == 0.0) return;
  ++impedance.projected;
  impedance.least_real_share = std::min(impedance.least_real_share, share);
  const double imaginary = std::sin(phase * pi<double> / 180.0);
  impedance.magnitude[row] *= std::abs(imaginary);
  phase = std::copysign(90.0, imaginary);
}

void append(ImpedanceTable& impedance, const CsvTable& table, std::size_t row) {
  const double magnitude = table.finite(row, magnitude_column);
  const double phase = table.finite(row, phase_column);
  const auto refuse = [&](const char* column, double value, const char* message) {
    throw table.fault(row, std::string(column) + " = " + format_number(value) + ": " + message);
  };
  if (magnitude < 0.0) refuse(magnitude_column, magnitude, "must be at least 0 N s/m");
  if (std::abs(phase) > 360.0)
    refuse(phase_column, phase, "must be at least -360 and at most 360 degrees");
  require_passive(table, row, magnitude, phase);
  impedance.magnitude.push_back(magnitude);
  impedance.phase_deg.push_back(phase);
  project(impedance, row);
}

}  // namespace

ImpedanceTable read_impedance_text(const std::string& text, const std::string& name) {
  CsvTable table = parse_csv(text, name);
  table.require({frequency_column, magnitude_column, phase_column});
  table.require_rows(2, "a table of impedance");
  ImpedanceTable impedance{table.ascending(frequency_column), {}, {}};
  if (!(impedance.frequency.front() > 0.0))
    throw table.fault(0, std::string(frequency_column) + " = " +
                             format_number(impedance.frequency.front()) + ": must be above 0 Hz");
  for (std::size_t row = 0; row < table.rows(); ++row) append(impedance, table, row);
  return impedance;
}

ImpedanceTable read_impedance_table(const std::filesystem::path& file) {
  return read_impedance_text(read_input(file), file.string());
}

std::vector<std::string> impedance_doubts(const Case& the_case) {
  constexpr double turn = 2.0 * pi<double>, noticeable = 0.5;
  std::vector<std::string> doubts;
  for (const case_tables::Device& device : the_case.devices) {
    if (device.table == nullptr) continue;
    if (device.table->projected > 0)
      doubts.push_back(
          device.file + ": " + std::to_string(device.table->projected) +
          " row(s) have an impedance with a real part below 0, by up to " +
          format_rounded(-100.0 * device.table->least_real_share) +
          " % of its magnitude, a usual error of phases; these real parts are set to 0");
    double largest = 0.0;
    for (const double phase : device.table->phase_deg) largest = std::max(largest, std::abs(phase));
    if (largest >= noticeable && largest <= turn)
      doubts.push_back(device.file + ": phase_deg never exceeds " + format_rounded(largest) +
                       " degrees, as for a pure dashpot; are the phases in radians?");
  }
  return doubts;
}

}  // namespace holdfast::program
