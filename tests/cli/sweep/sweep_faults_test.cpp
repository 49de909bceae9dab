#include "cli/program.hpp"

namespace holdfast::tests {
namespace {

using program::CsvTable;

/// Seven of its 22 cells diverge and eleven have a delay above the sampling period.
const std::string failing_sweep =
    "sweep --axis control.processing_delay=0,0.2 --axis "
    "control.differential_gain=-13,-12,-11,-10,1000,2000,3000,4000,5000,6000,7000"
    " --duration 2 --metric first_peak --metric steady_peak --metric steady_rms"
    " --metric ratio_to_uncontrolled --metric force_peak --metric force_rms"
    " --metric absorber_stroke --metric engaged_fraction --metric reversals_per_s"
    " --metric largest_exponent --metric attenuates --metric period_samples --metric verdict"
    " --metric outcome";

void expect_failed_cell(const CsvTable& table, std::size_t row, const std::string& word,
                        const std::string& peak) {
  for (const std::string name : {"steady_peak", "steady_rms", "ratio_to_uncontrolled", "force_peak",
                                 "force_rms", "absorber_stroke"}) {
    EXPECT_EQ(table.text(row, name), peak) << name << " of row " << row;
  }
  for (const std::string name : {"engaged_fraction", "reversals_per_s", "largest_exponent"})
    EXPECT_EQ(table.text(row, name), "nan") << name << " of row " << row;
  for (const std::string name : {"attenuates", "period_samples"})
    EXPECT_EQ(table.text(row, name), "0") << name << " of row " << row;
  for (const std::string name : {"verdict", "outcome"})
    EXPECT_EQ(table.text(row, name), word) << name << " of row " << row;
}

TEST(SweepJob, CellsThatDivergeOrAreNotAdmissibleSaySoAndStopNothing) {
  const Outcome outcome = run_holdfast(failing_sweep);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  const CsvTable table = program::parse_csv(outcome.output, "sweep");
  ASSERT_EQ(table.rows(), 22U);
  for (std::size_t row = 0; row < 4; ++row) {
    EXPECT_EQ(table.text(row, "outcome"), "computed");
    EXPECT_EQ(table.text(row, "verdict"), "periodic");
    EXPECT_TRUE(std::isfinite(table.number(row, "largest_exponent")));
  }
  for (std::size_t row = 4; row < 11; ++row) expect_failed_cell(table, row, "diverges", "inf");
  for (std::size_t row = 11; row < 22; ++row) expect_failed_cell(table, row, "invalid", "nan");
  for (std::size_t row = 11; row < 22; ++row) EXPECT_EQ(table.text(row, "first_peak"), "nan");
}

TEST(SweepJob, OneWarningCountsTheCellsThatFailedUnlessItShallBeQuiet) {
  const Outcome outcome = run_holdfast(failing_sweep);
  EXPECT_EQ(outcome.error_lines(), 1U) << outcome.errors;
  expect_holds(outcome.errors, {"holdfast: warning: ", "7", "11", "control.processing_delay"});
  const Outcome quiet = run_holdfast(failing_sweep + " --quiet");
  EXPECT_EQ(quiet.errors, "");
  EXPECT_EQ(quiet.output, outcome.output);
}

TEST(SweepJob, RefusesAxesThatAreNone) {
  expect_refused("sweep ", {"--axis"});
  expect_refused("sweep --axis backlash.widht=0:1:2", {"backlash.width"});
  expect_refused("sweep --axis backlash.width", {"KEY="});
  expect_refused("sweep --axis backlash.width=", {"backlash.width="});
  expect_refused("sweep --axis backlash.width=0:1", {"0:1"});
  expect_refused("sweep --axis backlash.width=0:1:0", {"0:1:0"});
  expect_refused("sweep --axis backlash.width=1:0:3", {"1:0:3"});
  expect_refused("sweep --axis backlash.width=0,wide", {"wide"});
  expect_refused("sweep --axis backlash.width=0,,1", {"0,,1"});
  expect_refused("sweep --axis backlash.width=log:0:1:3", {"log:0:1:3"});
  expect_refused("sweep --axis backlash.width=log:-1:1:3", {"log:-1:1:3"});
  expect_refused("sweep --axis excitation.hold=sampled,exact", {"excitation.hold has no numbers"});
  expect_refused("sweep --axis wind.speed=1,2", {"[wind]"});
  expect_refused("sweep --axis initial.z1=0:1:2 --axis initial.z1=2,3", {"initial.z1"});
  expect_refused("sweep --axis initial.z1=0:1:1000000000 --axis initial.z2=0:1:1000000000",
                 {"cells"});
}

TEST(SweepJob, RefusesOtherOptionsThatCannotBe) {
  const std::string axis = "sweep --axis initial.z1=0:1:2 ";
  expect_refused(axis + "--metric steady_pek", {"steady_peak"});
  expect_refused(axis + "--metric force_peak --metric force_peak", {"force_peak"});
  expect_refused(axis + "--resume", {"--output"});
  expect_refused(axis + "--duration -1", {"duration"});
  expect_refused(axis + "--duration nan", {"duration"});
  expect_refused(axis + "--chunk -1", {"chunk"});
  expect_refused(axis + "--max-period 0", {"max-period"});
  expect_refused(axis + "--output /no/such/folder/sweep.csv", {"sweep.csv"});
}

}  // namespace
}  // namespace holdfast::tests
