#include "io/text/time_table.hpp"

#include <cmath>

#include "io/text/text.hpp"

namespace holdfast::program {

TimeTable::TimeTable(const std::string& text, const std::string& name)
    : table_(parse_csv(text, name)), name_(name) {}

TimeSeries TimeTable::series(const std::string& column, std::size_t fewest_rows,
                             const std::string& what) const {
  if (table_.rows() < fewest_rows)
    throw WrongInput(name_ + ": " + what + " needs " + std::to_string(fewest_rows) +
                     " rows at least, here are " + std::to_string(table_.rows()));
  TimeSeries series;
  for (std::size_t row = 0; row < table_.rows(); ++row) {
    series.times.push_back(number(row, "time_s"));
    series.values.push_back(number(row, column));
    if (row > 0 && series.times[row] <= series.times[row - 1])
      throw fault(row, "time_s = " + format_number(series.times[row]) + " does not come after " +
                           format_number(series.times[row - 1]) + " of the row before");
  }
  return series;
}

WrongInput TimeTable::fault(std::size_t row, const std::string& message) const {
  return WrongInput(name_ + ":" + std::to_string(table_.line(row)) + ": " + message);
}

double TimeTable::number(std::size_t row, const std::string& column) const {
  if (trimmed(table_.text(row, column)).empty()) throw fault(row, column + " is missing");
  const double value = table_.number(row, column);
  if (!std::isfinite(value))
    throw fault(row, column + " = " + format_number(value) + ": must be finite");
  return value;
}

}  // namespace holdfast::program
