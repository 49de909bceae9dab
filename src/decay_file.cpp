#include "decay_file.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "csv.hpp"
#include "errors.hpp"
#include "input.hpp"
#include "text.hpp"

namespace holdfast::program {
namespace {

/// The checks of a table that shall be a decay record, each naming file and line.
class DecayTable {
 public:
  DecayTable(CsvTable table, std::string name) : table_(std::move(table)), name_(std::move(name)) {}

  DecayRecord record() const {
    constexpr std::size_t fewest = 8;
    if (table_.rows() < fewest)
      throw WrongInput(name_ + ": a decay record needs 8 rows at least, here are " +
                       std::to_string(table_.rows()));
    DecayRecord record;
    for (std::size_t row = 0; row < table_.rows(); ++row) {
      record.times.push_back(number(row, "time_s"));
      record.displacements.push_back(number(row, "displacement_m"));
      if (row > 0 && record.times[row] <= record.times[row - 1])
        throw fault(row, "time_s = " + format_number(record.times[row]) + " does not come after " +
                             format_number(record.times[row - 1]) + " of the row before");
    }
    if (record.displacements.front() == 0.0)
      throw fault(0, "displacement_m = 0: the decay must start displaced");
    refuse_gaps(record.times);
    return record;
  }

 private:
  WrongInput fault(std::size_t row, const std::string& message) const {
    return WrongInput(name_ + ":" + std::to_string(table_.line(row)) + ": " + message);
  }

  double number(std::size_t row, const std::string& column) const {
    if (trimmed(table_.text(row, column)).empty()) throw fault(row, column + " is missing");
    const double value = table_.number(row, column);
    if (!std::isfinite(value))
      throw fault(row, column + " = " + format_number(value) + ": must be finite");
    return value;
  }

  void refuse_gaps(const std::vector<double>& times) const {
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

  CsvTable table_;
  std::string name_;
};

}  // namespace

DecayRecord read_decay_text(const std::string& text, const std::string& name) {
  return DecayTable(parse_csv(text, name), name).record();
}

DecayRecord read_decay_file(const std::filesystem::path& file) {
  return read_decay_text(read_input(file), file.string());
}

}  // namespace holdfast::program
