#include "cli/program.hpp"
#include "cli/sweep/stopped_sweep.hpp"

namespace holdfast::tests {
namespace {

using program::CsvTable;

TEST(SweepJob, ColumnsAreTheKeysThenTheMetricsAsAskedAndTheFirstAxisIsSlowest) {
  const CsvTable table = table_of(
      "sweep --axis initial.z1=1e-3,-2e-3 --axis backlash.width=0:0.002:3 --duration 0.2"
      " --metric outcome --metric force_peak --metric attenuates");
  EXPECT_EQ(table.names(), (std::vector<std::string>{"initial.z1", "backlash.width", "outcome",
                                                     "force_peak", "attenuates"}));
  ASSERT_EQ(table.rows(), 6U);
  for (std::size_t row = 0; row < 6; ++row) {
    EXPECT_EQ(table.number(row, "initial.z1"), row < 3 ? 1e-3 : -2e-3);
    EXPECT_EQ(table.number(row, "backlash.width"), 0.001 * static_cast<double>(row % 3));
    EXPECT_EQ(table.text(row, "outcome"), "computed");
  }
  EXPECT_EQ(table_of("sweep --axis initial.z1=0 --duration 0.2").names(),
            (std::vector<std::string>{"initial.z1", "steady_peak", "ratio_to_uncontrolled",
                                      "attenuates", "outcome"}));
}

TEST(SweepJob, ThreadsAndTilesDoNotChangeAnyByte) {
  const std::string sweep = mixed_sweep +
                            " --metric steady_peak --metric steady_rms --metric force_rms --metric "
                            "reversals_per_s --metric ratio_to_uncontrolled --metric outcome";
  const std::string bytes = printed_by(sweep);
  EXPECT_EQ(lines_of(bytes).size(), 61U);
  for (const std::string way : {" --threads 1", " --threads 2", " --threads 5", " --chunk 1",
                                " --chunk 7", " --chunk 1000"}) {
    EXPECT_EQ(printed_by(sweep + way), bytes) << way;
  }
}

/// The values of an axis of five, as the table writes them, with commas between.
std::string values_of_axis(const CsvTable& table, const std::string& key) {
  std::string values;
  for (std::size_t row = 0; row < table.rows(); ++row)
    values += (row == 0 ? "" : ",") + table.text(row, key);
  return values;
}

TEST(SweepJob, AnAxisIsTheListOfItsValues) {
  const std::string key = "control.sampling_period";
  for (const std::string axis : {"0.001:0.005:5", "log:0.001:0.016:5"}) {
    const std::string sweep = "sweep --duration 1 --axis " + key + "=";
    const std::string bytes = printed_by(sweep + axis);
    const CsvTable table = program::parse_csv(bytes, axis);
    ASSERT_EQ(table.rows(), 5U);
    EXPECT_EQ(printed_by(sweep + values_of_axis(table, key)), bytes) << axis;
  }
}

TEST(SweepJob, ADryRunOfAHundredMillionCellsComputesNothingAndLeavesNothing) {
  const TemporaryFolder folder;
  const std::string sweep =
      "sweep --axis initial.z1=0:0.001:10000 --axis initial.z2=0:0.001:10000 --dry-run";
  const CsvTable table = table_of(sweep + " --output '" + (folder / "sweep.csv").string() + "'");
  EXPECT_EQ(table.names(), (std::vector<std::string>{"quantity", "value", "unit"}));
  EXPECT_EQ(value_of(table, "cells"), 1e8);
  EXPECT_GE(value_of(table, "chunks"), 1.0);
  EXPECT_LE(value_of(table, "chunks"), 1e8);
  // 20 s at 1 ms, the first sample and the last one counted.
  EXPECT_GE(value_of(table, "samples"), 1e8 * 20001.0);
  EXPECT_EQ(value_of(table_of(sweep + " --chunk 1000"), "chunks"), 1e5);
  EXPECT_EQ(value_of(table_of(sweep + " --chunk 10000000"), "chunks"), 10.0);
  EXPECT_TRUE(folder.names().empty());
}

long peak_memory_of(const std::string& cells) {
  const TemporaryFolder folder;
  RunningProgram sweep(words_of(
      "sweep --threads 2 --chunk 4096 --duration 0.004 --axis initial.z1=0:0.001:" + cells +
      " --metric first_peak --metric steady_peak --metric steady_rms --metric engaged_fraction"
      " --metric force_peak --metric force_rms --metric reversals_per_s --metric absorber_stroke"
      " --metric outcome --output " +
      (folder / "sweep.csv").string()));
  const Ending ending = sweep.wait();
  EXPECT_EQ(ending.exit_code, 0) << ending.errors;
  return ending.peak_memory_kib;
}

TEST(SweepJob, MemoryDoesNotGrowWithTheNumberOfCells) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer keeps freed memory back";
#endif
  const auto some = static_cast<double>(peak_memory_of("300000"));
  const auto many = static_cast<double>(peak_memory_of("1000000"));
  EXPECT_LE(many, 1.2 * some);
}

TEST(SweepJob, SaysOfEachCellThatDivergesThatItDoes) {
  const Outcome outcome = run_holdfast(
      "sweep --axis control.differential_gain=-200:-50:4 --axis backlash.width=0.0005:0.003:3 "
      "--metric verdict --metric steady_peak --metric outcome --duration 20");
  const CsvTable table = program::parse_csv(outcome.output, "sweep");
  int diverging = 0;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const bool diverges = table.text(row, "verdict") == "diverges";
    diverging += diverges ? 1 : 0;
    EXPECT_EQ(table.text(row, "outcome") == "diverges", diverges) << row;
    EXPECT_EQ(std::isinf(table.number(row, "steady_peak")), diverges) << row;
  }
  EXPECT_GT(diverging, 2);
  expect_holds(outcome.errors, {std::to_string(diverging) + " diverge"});
}

}  // namespace
}  // namespace holdfast::tests
