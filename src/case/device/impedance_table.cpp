#include "case/device/impedance_table.hpp"

#include <algorithm>
#include <cmath>

#include "holdfast/core/types.hpp"
#include "io/file/input.hpp"
#include "io/text/csv.hpp"
#include "io/text/text.hpp"
#include "process/errors.hpp"

namespace holdfast::program {
namespace {

constexpr const char* frequency_column = "frequency_Hz";
constexpr const char* magnitude_column = "magnitude_N_s_per_m";
constexpr const char* phase_column = "phase_deg";

/// A row, whose faults name file and line.
class Row {
 public:
  Row(const CsvTable& table, std::size_t row, const std::string& name)
      : table_(table), row_(row), name_(name) {}

  double number(const char* column) const {
    if (trimmed(table_.text(row_, column)).empty())
      throw fault(std::string(column) + " is missing");
    const double value = table_.number(row_, column);
    if (!std::isfinite(value)) throw fault(column, value, "must be finite");
    return value;
  }

  WrongInput fault(const std::string& message) const {
    return WrongInput(name_ + ":" + std::to_string(table_.line(row_)) + ": " + message);
  }
  WrongInput fault(const char* column, double value, const std::string& message) const {
    return fault(std::string(column) + " = " + format_number(value) + ": " + message);
  }

 private:
  const CsvTable& table_;
  std::size_t row_;
  const std::string& name_;
};

/// A phase of 90 degrees, of a mere mass, has a cosine that rounds to either side of 0.
void require_passive(const Row& row, double frequency, double magnitude, double phase) {
  constexpr double tolerance = 1e-9;
  const double share = std::cos(phase * pi<double> / 180.0);
  if (magnitude == 0.0 || share >= -tolerance) return;
  throw row.fault("at " + format_number(frequency) + " Hz the real part of the impedance is " +
                  format_rounded(magnitude * share) +
                  " N s/m, so that the device would give power, which no passive one does; is "
                  "phase_deg that of the force over the velocity, and not over displacement or "
                  "acceleration, nor of the force that acts back?");
}

void append(ImpedanceTable& impedance, const Row& row) {
  const double frequency = row.number(frequency_column);
  const double magnitude = row.number(magnitude_column);
  const double phase = row.number(phase_column);
  if (!(frequency > 0.0)) throw row.fault(frequency_column, frequency, "must be above 0 Hz");
  if (!impedance.frequency.empty() && frequency <= impedance.frequency.back())
    throw row.fault(std::string(frequency_column) + " = " + format_number(frequency) +
                    " does not come after " + format_number(impedance.frequency.back()) +
                    " of the row before");
  if (magnitude < 0.0) throw row.fault(magnitude_column, magnitude, "must be at least 0 N s/m");
  if (std::abs(phase) > 360.0)
    throw row.fault(phase_column, phase, "must be at least -360 and at most 360 degrees");
  require_passive(row, frequency, magnitude, phase);
  impedance.frequency.push_back(frequency);
  impedance.magnitude.push_back(magnitude);
  impedance.phase_deg.push_back(phase);
}

}  // namespace

ImpedanceTable read_impedance_text(const std::string& text, const std::string& name) {
  CsvTable table = parse_csv(text, name);
  table.require({frequency_column, magnitude_column, phase_column});
  if (table.rows() < 2)
    throw WrongInput(name + ": a table of impedance needs 2 rows at least, here are " +
                     std::to_string(table.rows()));
  ImpedanceTable impedance;
  for (std::size_t row = 0; row < table.rows(); ++row) append(impedance, Row(table, row, name));
  return impedance;
}

ImpedanceTable read_impedance_table(const std::filesystem::path& file) {
  return read_impedance_text(read_input(file), file.string());
}

std::vector<std::string> phase_doubts(const Case& the_case) {
  constexpr double turn = 2.0 * pi<double>, noticeable = 0.5;
  std::vector<std::string> doubts;
  for (const case_tables::Device& device : the_case.devices) {
    if (device.table == nullptr) continue;
    double largest = 0.0;
    for (const double phase : device.table->phase_deg) largest = std::max(largest, std::abs(phase));
    if (largest >= noticeable && largest <= turn)
      doubts.push_back(device.file + ": no phase_deg is beyond " + format_rounded(largest) +
                       ", as if the device were a mere dashpot; are they in radians?");
  }
  return doubts;
}

}  // namespace holdfast::program
