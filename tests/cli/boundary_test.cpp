#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "cli/program.hpp"
#include "csv.hpp"

namespace holdfast::tests {
namespace {

program::CsvTable boundary_table(const std::string& arguments) {
  const Outcome outcome = run_holdfast(arguments);
  EXPECT_EQ(outcome.exit_code, 0) << arguments << '\n' << outcome.errors;
  return program::parse_csv(outcome.output, arguments);
}

/// Whether the loop with these gains is stable, by the chart of one cell.
bool is_stable_cell(double p, double d, const std::string& more) {
  const auto text = [](double value) {
    return std::to_string(value) + ":" + std::to_string(value) + ":1";
  };
  const auto table = boundary_table("stability --p=" + text(p) + " --d=" + text(d) + more);
  return table.number(0, "stable") == 1.0;
}

void expect_end_between_stable_and_not(const program::CsvTable& table, std::size_t row,
                                       const std::string& end, const std::string& more) {
  const double value = table.number(row, end), other = table.number(row, "other_gain");
  if (!std::isfinite(value)) return;
  const bool d_varies = table.text(row, "gain") == "differential_gain";
  const double inward = (end == "lower" ? 1e-4 : -1e-4) * std::max(1.0, std::abs(value));
  for (const double step : {inward, -inward}) {
    const bool stable = d_varies ? is_stable_cell(other, value + step, more)
                                 : is_stable_cell(value + step, other, more);
    EXPECT_EQ(stable, step == inward) << more << ' ' << value << ' ' << step;
  }
}

TEST(Boundary, StableIntervalsEndWhereTheChartSaysSo) {
  for (const std::string more : {"", " --continuous"}) {
    const auto table = boundary_table("boundary --stable-interval" + more);
    ASSERT_GE(table.rows(), 2U);
    for (std::size_t row = 0; row < table.rows(); ++row) {
      const bool d_varies = table.text(row, "gain") == "differential_gain";
      EXPECT_EQ(table.number(row, "other_gain"), d_varies ? -557.0 : -13.0);
      expect_end_between_stable_and_not(table, row, "lower", more);
      expect_end_between_stable_and_not(table, row, "upper", more);
    }
  }
}

TEST(Boundary, SaysWhereNoGainStabilises) {
  const Outcome outcome = run_holdfast(
      "boundary --stable-interval --set control.sampling_period=0.05 --set "
      "control.differential_gain=-500");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(outcome.error_lines(), 1U);
  EXPECT_NE(outcome.errors.find("no D stabilises"), std::string::npos) << outcome.errors;
}

}  // namespace
}  // namespace holdfast::tests
