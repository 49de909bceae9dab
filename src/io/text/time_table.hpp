#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "io/text/csv.hpp"
#include "process/errors.hpp"

namespace holdfast::program {

/// A quantity at ascending times.
struct TimeSeries {
  std::vector<double> times;   // s
  std::vector<double> values;  // of the column that was asked for
};

/// A CSV table with the column `time_s` and others over it, in any order, whose faults name file
/// and line.
class TimeTable {
 public:
  /// Throws what parse_csv() throws; `name` stands for the file in messages.
  TimeTable(const std::string& text, const std::string& name);

  /// One column over time. Throws WrongInput: fewer rows than that (`what` names the table, as "a
  /// decay record"), no such column, an empty cell, text in a number, a number that is not finite,
  /// time that does not ascend.
  TimeSeries series(const std::string& column, std::size_t fewest_rows,
                    const std::string& what) const;

  /// A fault of one row, for the caller to throw.
  WrongInput fault(std::size_t row, const std::string& message) const;

 private:
  double number(std::size_t row, const std::string& column) const;

  CsvTable table_;
  std::string name_;
};

}  // namespace holdfast::program
