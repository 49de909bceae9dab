#include "io/text/record_file.hpp"

#include <algorithm>

#include "io/file/whole_file.hpp"
#include "io/text/csv.hpp"
#include "process/errors.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

/// Parses a table with the columns time_s and `column`; throws WrongInput for too few rows.
CsvTable record_of(const std::string& text, const std::string& name, const std::string& column,
                   std::size_t fewest_rows, const std::string& what) {
  CsvTable table = parse_csv(text, name);
  table.require({"time_s", column});
  table.require_rows(fewest_rows, what);
  return table;
}

std::vector<double> finite(const CsvTable& table, const std::string& column) {
  std::vector<double> values;
  for (std::size_t row = 0; row < table.rows(); ++row) values.push_back(table.finite(row, column));
  return values;
}

}  // namespace

DecayRecord read_decay_text(const std::string& text, const std::string& name) {
  const CsvTable table = record_of(text, name, "displacement_m", 8, "a decay record");
  DecayRecord record{table.ascending("time_s"), finite(table, "displacement_m")};
  if (record.displacements.front() == 0.0)
    throw table.fault(0, "displacement_m = 0: a decay must start with a displacement other than 0");
  return record;
}

ForceRecord read_force_text(const std::string& text, const std::string& name) {
  const CsvTable table = record_of(text, name, "force_N", 2, "a force record");
  return {table.ascending("time_s"), finite(table, "force_N")};
}

DecayRecord read_decay_file(const std::filesystem::path& file) {
  return read_decay_text(read_input(file), file.string());
}

ForceRecord read_force_record(const std::filesystem::path& file) {
  return read_force_text(read_input(file), file.string());
}

double usual_step(const std::vector<double>& times) {
  std::vector<double> steps;
  for (std::size_t k = 1; k < times.size(); ++k) steps.push_back(times[k] - times[k - 1]);
  const auto most = steps.begin() + static_cast<std::ptrdiff_t>(9 * steps.size() / 10);
  std::nth_element(steps.begin(), most, steps.end());
  return *most;
}

std::string gap_text(const std::vector<double>& times) {
  constexpr double wide = 3.0;
  const double usual = usual_step(times);
  for (std::size_t k = 1; k < times.size(); ++k) {
    const double step = times[k] - times[k - 1];
    if (step > wide * usual)
      return "a gap of " + format_rounded(step) + " s after " + format_rounded(times[k - 1]) +
             " s, while rows are usually up to " + format_rounded(usual) + " s apart";
  }
  return "";
}

}  // namespace holdfast::program
