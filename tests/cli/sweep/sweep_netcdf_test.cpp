#include "cli/program.hpp"

#ifdef HOLDFAST_HAS_NETCDF

#include "cli/sweep/stopped_sweep.hpp"
#include "program/netcdf_variable.hpp"

namespace holdfast::tests {
namespace {

using program::CsvTable;

void expect_same_number(double one, double other, const std::string& name) {
  EXPECT_TRUE(one == other || (std::isnan(one) && std::isnan(other)))
      << name << ": " << one << " and " << other;
}

TEST(SweepJob, ItsNetcdfFileHoldsTheValuesOfTheTable) {
  const std::string sweep = mixed_sweep +
                            " --metric steady_peak --metric attenuates --metric period_samples"
                            " --metric verdict --metric outcome";
  const TemporaryFolder folder;
  const std::string file = (folder / "sweep.nc").string();
  EXPECT_EQ(printed_by(sweep + " --output '" + file + "'"), "");
  EXPECT_EQ(folder.names(), std::vector<std::string>{"sweep.nc"});
  const CsvTable table = program::parse_csv(printed_by(sweep), "sweep");
  ASSERT_EQ(table.rows(), 60U);
  for (const std::string name : {"steady_peak", "attenuates", "period_samples"}) {
    const auto values = NetcdfVariable(file, name).values();
    for (std::size_t row = 0; row < 60; ++row)
      expect_same_number(values[row], table.number(row, name), name);
  }
  for (const std::string name : {"verdict", "outcome"}) {
    const auto words = NetcdfVariable(file, name).words();
    for (std::size_t row = 0; row < 60; ++row) EXPECT_EQ(words[row], table.text(row, name)) << name;
  }
  const auto periods = NetcdfVariable(file, "control_sampling_period").values();
  const auto widths = NetcdfVariable(file, "backlash_width").values();
  EXPECT_EQ(NetcdfVariable(file, "backlash_width").text("key"), "backlash.width");
  const std::string history = NetcdfVariable(file).text("history");
  expect_holds(history, {"holdfast sweep --axis 'control.sampling_period=0.001,0.004'"});
  for (std::size_t row = 0; row < 60; ++row) {
    EXPECT_EQ(periods[row / 30], table.number(row, "control.sampling_period"));
    EXPECT_EQ(widths[row % 5], table.number(row, "backlash.width"));
  }
}

TEST(SweepJob, ItsNetcdfFileIsTheSameForAnyChunkAndThreads) {
  const TemporaryFolder folder;
  const auto written = [&](const std::string& name, const std::string& way) {
    const std::string file = (folder / name).string();
    EXPECT_EQ(printed_by(mixed_sweep + way + " --output '" + file + "'"), "");
    return read_text(file);
  };
  const std::string bytes = written("one.nc", "");
  EXPECT_TRUE(written("other.nc", " --threads 1 --chunk 7") == bytes);
  EXPECT_TRUE(written("third.nc", " --threads 5 --chunk 1") == bytes);
}

}  // namespace
}  // namespace holdfast::tests

#endif
