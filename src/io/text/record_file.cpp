#include "io/text/record_file.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "io/file/input.hpp"
#include "io/text/csv.hpp"
#include "io/text/text.hpp"
#include "process/errors.hpp"

namespace holdfast::program {
namespace {

/// One column over the times of a CSV table, whose faults name file and line.
class Record {
 public:
  /// @param what  names the table where it has too few rows
  Record(const std::string& text, const std::string& name, const std::string& column,
         std::size_t fewest_rows, const std::string& what)
      : table_(parse_csv(text, name)), name_(name) {
    table_.require({"time_s", column});
    if (table_.rows() < fewest_rows)
      throw WrongInput(name_ + ": " + what + " needs " + std::to_string(fewest_rows) +
                       " rows at least, here are " + std::to_string(table_.rows()));
    for (std::size_t row = 0; row < table_.rows(); ++row) {
      times.push_back(number(row, "time_s"));
      values.push_back(number(row, column));
      if (row > 0 && times[row] <= times[row - 1])
        throw fault(row, "time_s = " + format_number(times[row]) + " does not come after " +
                             format_number(times[row - 1]) + " of the row before");
    }
  }

  WrongInput fault(std::size_t row, const std::string& message) const {
    return WrongInput(name_ + ":" + std::to_string(table_.line(row)) + ": " + message);
  }

  void refuse_gaps() const {
    std::vector<double> steps;
    for (std::size_t k = 1; k < times.size(); ++k) steps.push_back(times[k] - times[k - 1]);
    const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
    std::nth_element(steps.begin(), middle, steps.end());
    const double usual = *middle;
    for (std::size_t row = 1; row < times.size(); ++row) {
      const double step = times[row] - times[row - 1];
      if (step <= 1.5 * usual) continue;
      throw fault(row, "a gap of " + format_rounded(step) +
                           " s before this row, where the rows usually are " +
                           format_rounded(usual) + " s apart");
    }
  }

  std::vector<double> times, values;

 private:
  double number(std::size_t row, const std::string& column) const {
    if (trimmed(table_.text(row, column)).empty()) throw fault(row, column + " is missing");
    const double value = table_.number(row, column);
    if (!std::isfinite(value))
      throw fault(row, column + " = " + format_number(value) + ": must be finite");
    return value;
  }

  CsvTable table_;
  std::string name_;
};

}  // namespace

DecayRecord read_decay_text(const std::string& text, const std::string& name) {
  Record record(text, name, "displacement_m", 8, "a decay record");
  if (record.values.front() == 0.0)
    throw record.fault(0, "displacement_m = 0: the decay must start displaced");
  record.refuse_gaps();
  return {std::move(record.times), std::move(record.values)};
}

ForceRecord read_force_text(const std::string& text, const std::string& name) {
  Record record(text, name, "force_N", 2, "a force record");
  return {std::move(record.times), std::move(record.values)};
}

DecayRecord read_decay_file(const std::filesystem::path& file) {
  return read_decay_text(read_input(file), file.string());
}

ForceRecord read_force_record(const std::filesystem::path& file) {
  return read_force_text(read_input(file), file.string());
}

}  // namespace holdfast::program
