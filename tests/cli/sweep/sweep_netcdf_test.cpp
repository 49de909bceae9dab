#include <gtest/gtest.h>

#include "cli/program.hpp"

#ifdef HOLDFAST_HAS_NETCDF

#include <netcdf.h>

#include <cmath>
#include <string>
#include <vector>

#include "cli/running_program.hpp"
#include "io/grid/netcdf_library.hpp"
#include "io/text/csv.hpp"

namespace holdfast::tests {
namespace {

using program::CsvTable;

/// Cells with and without backlash, of unequal numbers of samples, one that diverges and some that
/// are not admissible.
const std::string gridded_sweep =
    "sweep --axis control.sampling_period=0.001,0.004 --axis control.differential_gain=-13,900"
    " --axis control.processing_delay=0:0.0015:3 --axis backlash.width=0:0.002:5 --duration 1.5";

std::string printed_by(const std::string& arguments) {
  const Outcome outcome = run_holdfast(arguments);
  EXPECT_EQ(outcome.exit_code, 0) << arguments << '\n' << outcome.errors;
  return outcome.output;
}

/// The sweep's netCDF file, read by the library that others read it with.
class SweptFile {
 public:
  explicit SweptFile(const std::string& file) {
    EXPECT_EQ(call<decltype(nc_open)>("nc_open")(file.c_str(), NC_NOWRITE, &id_), NC_NOERR);
  }
  ~SweptFile() { call<decltype(nc_close)>("nc_close")(id_); }
  SweptFile(const SweptFile&) = delete;
  SweptFile& operator=(const SweptFile&) = delete;
  SweptFile(SweptFile&&) = delete;
  SweptFile& operator=(SweptFile&&) = delete;

  /// Every type of number converted to doubles.
  std::vector<double> numbers(const std::string& name, std::size_t count) const {
    std::vector<double> values(count);
    EXPECT_EQ(
        call<decltype(nc_get_var_double)>("nc_get_var_double")(id_, variable(name), values.data()),
        NC_NOERR)
        << name;
    return values;
  }

  /// Flags in words.
  std::vector<std::string> words(const std::string& name, std::size_t count) const {
    std::size_t length = 0;
    EXPECT_EQ(call<decltype(nc_inq_attlen)>("nc_inq_attlen")(id_, variable(name), "flag_meanings",
                                                             &length),
              NC_NOERR);
    std::string meanings(length, ' ');
    EXPECT_EQ(call<decltype(nc_get_att_text)>("nc_get_att_text")(id_, variable(name),
                                                                 "flag_meanings", meanings.data()),
              NC_NOERR);
    const std::vector<std::string> known = words_of(meanings);
    std::vector<std::string> found;
    for (const double flag : numbers(name, count))
      found.push_back(known.at(static_cast<std::size_t>(flag)));
    return found;
  }

 private:
  template <class Function>
  static Function* call(const char* name) {
    return program::netcdf_function<Function>(name);
  }

  int variable(const std::string& name) const {
    int number = -1;
    EXPECT_EQ(call<decltype(nc_inq_varid)>("nc_inq_varid")(id_, name.c_str(), &number), NC_NOERR)
        << name;
    return number;
  }

  int id_ = 0;
};

void expect_same_number(double one, double other, const std::string& name) {
  EXPECT_TRUE(one == other || (std::isnan(one) && std::isnan(other)))
      << name << ": " << one << " and " << other;
}

TEST(SweepJob, ItsNetcdfFileHoldsTheValuesOfTheTable) {
  const std::string sweep = gridded_sweep +
                            " --metric steady_peak --metric attenuates --metric period_samples"
                            " --metric verdict --metric outcome";
  const TemporaryFolder folder;
  const std::string file = (folder / "sweep.nc").string();
  EXPECT_EQ(printed_by(sweep + " --output '" + file + "'"), "");
  EXPECT_EQ(folder.names(), std::vector<std::string>{"sweep.nc"});
  const CsvTable table = program::parse_csv(printed_by(sweep), "sweep");
  ASSERT_EQ(table.rows(), 60U);
  const SweptFile swept(file);
  for (const std::string name : {"steady_peak", "attenuates", "period_samples"}) {
    const auto values = swept.numbers(name, 60);
    for (std::size_t row = 0; row < 60; ++row)
      expect_same_number(values[row], table.number(row, name), name);
  }
  for (const std::string name : {"verdict", "outcome"}) {
    const auto words = swept.words(name, 60);
    for (std::size_t row = 0; row < 60; ++row) EXPECT_EQ(words[row], table.text(row, name)) << name;
  }
  const auto periods = swept.numbers("control.sampling_period", 2);
  const auto widths = swept.numbers("backlash.width", 5);
  for (std::size_t row = 0; row < 60; ++row) {
    EXPECT_EQ(periods[row / 30], table.number(row, "control.sampling_period"));
    EXPECT_EQ(widths[row % 5], table.number(row, "backlash.width"));
  }
}

TEST(SweepJob, ItsNetcdfFileIsTheSameForAnyTileAndThreads) {
  const TemporaryFolder folder;
  const auto written = [&](const std::string& name, const std::string& way) {
    const std::string file = (folder / name).string();
    EXPECT_EQ(printed_by(gridded_sweep + way + " --output '" + file + "'"), "");
    return read_text(file);
  };
  const std::string bytes = written("one.nc", "");
  EXPECT_TRUE(written("other.nc", " --threads 1 --tile 7") == bytes);
  EXPECT_TRUE(written("third.nc", " --threads 5 --tile 1") == bytes);
}

}  // namespace
}  // namespace holdfast::tests

#endif
