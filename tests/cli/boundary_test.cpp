#include "cli/program.hpp"

namespace holdfast::tests {
namespace {

using program::CsvTable;

/// Whether the loop with these gains is stable, by the chart of one cell.
bool is_stable_cell(double p, double d, const std::string& more) {
  return cell_of("stability", p, d, more).number(0, "stable") == 1.0;
}

TEST(Boundary, StableIntervalsAreOfTheGainsThatAreGiven) {
  const CsvTable table = table_of("boundary --stable-interval --p -557,-100 --continuous");
  ASSERT_EQ(table.rows(), 2U);
  EXPECT_NEAR(table.number(0, "lower"), -33.7, 0.05) << "Kollár 2022, Fig. 3";
  EXPECT_EQ(table.number(0, "other_gain"), -557.0);
  EXPECT_EQ(table.number(1, "other_gain"), -100.0);
  const CsvTable of_p = table_of("boundary --stable-interval --d -13 --continuous");
  ASSERT_EQ(of_p.rows(), 1U);
  EXPECT_EQ(of_p.text(0, "gain"), "proportional_gain");
  const CsvTable slow =
      table_of("boundary --stable-interval --p -557 --set control.sampling_period=0.01");
  ASSERT_EQ(slow.rows(), 1U);
  EXPECT_NEAR(slow.number(0, "lower"), -15.5, 0.05) << "Kollár 2022, Fig. 4a";
}

TEST(Boundary, AGainWithoutAStableIntervalIsWarnedOf) {
  const Outcome outcome = run_holdfast("boundary --stable-interval --p -557,500 --continuous");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(program::parse_csv(outcome.output, "intervals").rows(), 1U);
  EXPECT_EQ(outcome.error_lines(), 1U);
  expect_holds(outcome.errors, {"no D stabilises the loop at P = 500 N/m"});
  EXPECT_EQ(
      run_holdfast("boundary --stable-interval --p -557,500 --continuous --quiet").error_lines(),
      0U);
}

TEST(Boundary, SaysWhereNoGainStabilises) {
  expect_refused(
      "boundary --stable-interval --set control.sampling_period=0.05 --set "
      "control.differential_gain=-500",
      {"no D stabilises"}, 1);
  // Kollár 2022, Fig. 4b: at 50 ms no D stabilises the loop at P = −557.
  const TemporaryFolder folder;
  expect_refused(
      "boundary --stable-interval --p -557 --set control.sampling_period=0.05 --output '" +
          (folder / "intervals.csv").string() + "'",
      {}, 1);
  EXPECT_TRUE(folder.names().empty());
}

TEST(Boundary, RegionsFillTheWindowStableFirst) {
  const std::string more = " --set control.sampling_period=0.01";
  const CsvTable table = table_of("boundary --regions --p -1000:200 --d -40:20" + more);
  ASSERT_GT(table.rows(), 2U);
  double sum = 0.0, before = 0.0;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const double unstable = table.number(row, "unstable_roots");
    EXPECT_GE(unstable, before);
    before = unstable;
    sum += table.number(row, "area");
    const double p = table.number(row, "proportional_gain");
    const double d = table.number(row, "differential_gain");
    EXPECT_EQ(is_stable_cell(p, d, more), unstable == 0.0) << "row " << row;
    EXPECT_TRUE(table.number(row, "proportional_min") < p &&
                p < table.number(row, "proportional_max"));
    EXPECT_TRUE(table.number(row, "differential_min") < d &&
                d < table.number(row, "differential_max"));
  }
  EXPECT_EQ(table.number(0, "unstable_roots"), 0.0);
  EXPECT_NEAR(sum, 1200.0 * 60.0, 1e-6);
}

TEST(Boundary, RegionsOfTheContinuousLoopAreKnownToo) {
  const CsvTable table = table_of("boundary --regions --continuous");
  ASSERT_EQ(table.rows(), 2U);
  EXPECT_EQ(table.number(0, "unstable_roots"), 0.0);
  EXPECT_EQ(table.number(1, "unstable_roots"), 2.0);
}

TEST(Boundary, RefusesOptionsThatDoNotGoTogether) {
  for (const std::string arguments :
       {"--regions --stable-interval", "--d -40:20", "--regions --p 3:3", "--regions --d 5",
        "--regions --d 2:1", "--stable-interval --p -1000:200", "--stable-interval --d inf"}) {
    expect_refused("boundary " + arguments, {});
  }
}

}  // namespace
}  // namespace holdfast::tests
