#include "io/grid/grid_table.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <csignal>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>

#include "case/case_file.hpp"
#include "io/grid/netcdf_file.hpp"
#include "io/grid/netcdf_library.hpp"
#include "io/text/table.hpp"
#include "process/errors.hpp"
#include "process/interrupt.hpp"
#include "support/message_of.hpp"
#include "support/temporary_folder.hpp"

#ifdef HOLDFAST_HAS_NETCDF
#include <netcdf.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#endif

namespace holdfast::program {
namespace {

namespace fs = std::filesystem;
using tests::message_of;
using tests::read_text;
using tests::TemporaryFolder;

const double infinity = std::numeric_limits<double>::infinity();

JobContext context_for(const fs::path& output) {
  JobContext context;
  context.job = "stability";
  context.case_data = load_case(std::nullopt, {"control.sampling_period=0.004"});
  context.options = {{"--p", "-600:0:3"}, {"--radius", "true"}};
  context.output = output;
  return context;
}

/// A chart with a column of flags between two of reals.
struct Chart {
  GridAxis slow;
  GridAxis fast;
  std::vector<double> first;  // row after row, as the others
  std::vector<std::uint8_t> flags;
  std::vector<double> last;

  std::size_t cells() const { return slow.count() * fast.count(); }
  static std::vector<CellColumn> columns() {
    return {{{"amplitude_m", "m", "steady amplitude"}},
            {{"stable", "", "1: stable, 0: not", "integer"}, {"unstable", "stable"}},
            {{"exponent", "1/s", "of \"growth\", the largest"}}};
  }
};

double with_any_bits(std::mt19937_64& random) {
  const std::uint64_t bits = random();
  double value = 0.0;
  std::memcpy(&value, &bits, sizeof(value));
  return value;
}

/// Values of every kind and length, the special ones first.
Chart random_chart(GridAxis slow, GridAxis fast) {
  Chart chart{std::move(slow), std::move(fast), {}, {}, {}};
  std::mt19937_64 random(5);
  chart.last = {infinity, -infinity, std::nan(""), -std::nan(""), 0.0, -0.0, 5e-324, -2.5e-308};
  for (std::size_t i = 0; i < chart.cells(); ++i) {
    chart.first.push_back(with_any_bits(random));
    chart.flags.push_back(static_cast<std::uint8_t>(random() % 2));
    chart.last.push_back(static_cast<double>(random() % 1000) / 8.0);
  }
  chart.last.resize(chart.cells());
  return chart;
}

/// Names that a CSV file must quote; values whose digits are as long as digits get.
Chart small_chart() {
  return random_chart({{"gain, \"P\"", "N/m", "P"}, Axis{-1000.0, 200.0, 7}},
                      {{"d", "N.s/m", "D"},
                       std::vector<double>{-2.2250738585072014e-308, -1.7976931348623157e308,
                                           infinity, std::nan(""), 1e22, 0.1, -0.0}});
}

/// More cells than the writers keep in memory, and not a whole number of their blocks.
Chart large_chart() {
  return random_chart({{"gain", "N/m", "P"}, Axis{-1000.0, 200.0, 401}},
                      {{"d", "N.s/m", "D"}, Axis{-40.0, 20.0, 703}});
}

void append_rows(GridTable& table, const Chart& chart, std::size_t rows) {
  const std::size_t width = chart.fast.count();
  for (std::size_t row = 0; row < rows; ++row) {
    table.append_row({chart.first.data() + row * width, chart.flags.data() + row * width,
                      chart.last.data() + row * width});
  }
}

void write_chart(const fs::path& output, const Chart& chart) {
  GridTable table(context_for(output), chart.slow, chart.fast, Chart::columns());
  append_rows(table, chart, chart.slow.count());
  table.commit();
}

void write_table(const fs::path& output, const Chart& chart) {
  std::vector<Column> columns = {chart.slow.column, chart.fast.column};
  for (const CellColumn& column : Chart::columns()) columns.push_back(column.column);
  Table table(context_for(output), columns);
  for (std::size_t cell = 0; cell < chart.cells(); ++cell) {
    table.row(chart.slow.at(cell / chart.fast.count()), chart.fast.at(cell % chart.fast.count()),
              chart.first[cell], static_cast<int>(chart.flags[cell]), chart.last[cell]);
  }
  table.commit();
}

TEST(GridTable, AsCsvHasTheBytesOfATableAndItsMetadata) {
  for (const Chart& chart : {small_chart(), large_chart()}) {
    const TemporaryFolder one, other;
    write_chart(one / "out.csv", chart);
    write_table(other / "out.csv", chart);
    EXPECT_TRUE(read_text(one / "out.csv") == read_text(other / "out.csv"));
    EXPECT_EQ(read_text(one / "out.csv-metadata.json"), read_text(other / "out.csv-metadata.json"));
    EXPECT_EQ(one.files(), 2);
  }
}

TEST(GridTable, AnyByteButZeroIsAFlagThatIsSet) {
  const TemporaryFolder folder;
  GridTable table(context_for(folder / "out.csv"), {{"p", "", ""}, Axis{0, 0, 1}},
                  {{"d", "", ""}, Axis{0, 2, 3}}, {{{"stable", "", ""}, {"no", "yes"}}});
  const std::array<std::uint8_t, 3> flags = {0, 1, 255};
  table.append_row({flags.data()});
  table.commit();
  EXPECT_EQ(read_text(folder / "out.csv"), "p,d,stable\r\n0,0,0\r\n0,1,1\r\n0,2,1\r\n");
}

TEST(GridTable, RowsThatDoNotFitAreADefectAndSoIsAChartCutShort) {
  const TemporaryFolder folder;
  const Chart chart = small_chart();
  const auto append = [&](const std::vector<GridValues>& row) {
    GridTable table(context_for(folder / "out.csv"), chart.slow, chart.fast, Chart::columns());
    table.append_row(row);
    table.commit();
  };
  const double* reals = chart.first.data();
  const std::uint8_t* flags = chart.flags.data();
  EXPECT_THROW(append({reals, flags}), std::logic_error);
  EXPECT_THROW(append({flags, reals, reals}), std::logic_error);
  EXPECT_THROW(append({reals, flags, reals}), std::logic_error);
  const auto one_too_many = [&] {
    GridTable table(context_for(folder / "out.csv"), chart.slow, chart.fast, Chart::columns());
    append_rows(table, chart, chart.slow.count());
    table.append_row({reals, flags, reals});
  };
  EXPECT_THROW(one_too_many(), std::logic_error);
  EXPECT_EQ(folder.files(), 0);
}

TEST(GridTable, OnAFullDeviceIsAnOutputError) {
  EXPECT_THROW(write_chart("/dev/full", large_chart()), OutputError);
}

/// Every format leaves nothing behind when the job fails and when a signal comes.
TEST(GridTable, LeavesNoFileUnlessItIsWhole) {
  const TemporaryFolder folder;
  const Chart chart = large_chart();
  std::vector<std::string> names = {"out.csv"};
#ifdef HOLDFAST_HAS_NETCDF
  names.emplace_back("out.nc");
#endif
  for (const std::string& name : names) {
    const auto failing = [&] {
      GridTable table(context_for(folder / name), chart.slow, chart.fast, Chart::columns());
      append_rows(table, chart, 300);
      throw NoAnswer("the computation gives up");
    };
    EXPECT_THROW(failing(), NoAnswer) << name;
    const auto interrupted_work = [&] {
      GridTable table(context_for(folder / name), chart.slow, chart.fast, Chart::columns());
      append_rows(table, chart, 300);
      raise(SIGINT);
      append_rows(table, chart, 1);
    };
    install_signal_handlers();
    EXPECT_THROW(interrupted_work(), Interrupted) << name;
    clear_interrupt();
    EXPECT_EQ(folder.files(), 0) << name;
  }
}

TEST(Units, AreWrittenAsUdunitsLikesThem) {
  EXPECT_EQ(udunits(""), "1");
  EXPECT_EQ(udunits("m"), "m");
  EXPECT_EQ(udunits("N/m"), "N m-1");
  EXPECT_EQ(udunits("N.s/m"), "N s m-1");
  EXPECT_EQ(udunits("1/s"), "s-1");
  EXPECT_EQ(udunits("m/s2"), "m s-2");
  EXPECT_EQ(udunits("m2"), "m2");
}

TEST(NetcdfName, IsOneThatEndsInNc) {
  EXPECT_TRUE(is_netcdf_name("chart.nc"));
  EXPECT_TRUE(is_netcdf_name("folder/.nc"));
  EXPECT_FALSE(is_netcdf_name("chart.nc/chart.csv"));
  EXPECT_FALSE(is_netcdf_name("chart.nc4"));
  EXPECT_FALSE(is_netcdf_name("nc"));
  EXPECT_FALSE(is_netcdf_name(std::nullopt));
}

#ifdef HOLDFAST_HAS_NETCDF

/// The library's function of that name.
#define NETCDF(function) netcdf_function<decltype(function)>(#function)

/// A netCDF file, read by the library that others read it with.
class ReadBack {
 public:
  explicit ReadBack(const fs::path& file) {
    EXPECT_EQ(NETCDF(nc_open)(file.c_str(), NC_NOWRITE, &id_), NC_NOERR);
  }
  ~ReadBack() { NETCDF(nc_close)(id_); }
  ReadBack(const ReadBack&) = delete;
  ReadBack& operator=(const ReadBack&) = delete;
  ReadBack(ReadBack&&) = delete;
  ReadBack& operator=(ReadBack&&) = delete;

  int format() const {
    int format = 0;
    EXPECT_EQ(NETCDF(nc_inq_format)(id_, &format), NC_NOERR);
    return format;
  }

  int variable(const std::string& name) const {
    int number = -1;
    EXPECT_EQ(NETCDF(nc_inq_varid)(id_, name.c_str(), &number), NC_NOERR) << name;
    return number;
  }

  int type(const std::string& name) const {
    nc_type type = NC_NAT;
    EXPECT_EQ(NETCDF(nc_inq_vartype)(id_, variable(name), &type), NC_NOERR);
    return type;
  }

  /// Names and lengths of a variable's dimensions, the slowest first.
  std::vector<std::pair<std::string, std::size_t>> dimensions(const std::string& name) const {
    int count = 0;
    EXPECT_EQ(NETCDF(nc_inq_varndims)(id_, variable(name), &count), NC_NOERR);
    std::vector<int> numbers(static_cast<std::size_t>(count));
    EXPECT_EQ(NETCDF(nc_inq_vardimid)(id_, variable(name), numbers.data()), NC_NOERR);
    std::vector<std::pair<std::string, std::size_t>> found;
    for (const int number : numbers) {
      std::array<char, NC_MAX_NAME + 1> text{};
      std::size_t length = 0;
      EXPECT_EQ(NETCDF(nc_inq_dim)(id_, number, text.data(), &length), NC_NOERR);
      found.emplace_back(text.data(), length);
    }
    return found;
  }

  bool has_attribute(const std::string& variable_name, const std::string& name) const {
    std::size_t length = 0;
    return NETCDF(nc_inq_attlen)(id_, variable(variable_name), name.c_str(), &length) == NC_NOERR;
  }

  /// Of a variable, or of the file where the variable's name is empty.
  std::string text(const std::string& variable_name, const std::string& name) const {
    const int number = variable_name.empty() ? NC_GLOBAL : variable(variable_name);
    std::size_t length = 0;
    EXPECT_EQ(NETCDF(nc_inq_attlen)(id_, number, name.c_str(), &length), NC_NOERR) << name;
    std::string found(length, ' ');
    EXPECT_EQ(NETCDF(nc_get_att_text)(id_, number, name.c_str(), found.data()), NC_NOERR);
    return found;
  }

  template <class Value>
  std::vector<Value> attribute(const std::string& variable_name, const std::string& name) const {
    std::size_t length = 0;
    EXPECT_EQ(NETCDF(nc_inq_attlen)(id_, variable(variable_name), name.c_str(), &length), NC_NOERR);
    std::vector<Value> found(length);
    EXPECT_EQ(NETCDF(nc_get_att)(id_, variable(variable_name), name.c_str(), found.data()),
              NC_NOERR);
    return found;
  }

  template <class Value>
  std::vector<Value> values(const std::string& name) const {
    std::size_t count = 1;
    for (const auto& dimension : dimensions(name)) count *= dimension.second;
    std::vector<Value> found(count);
    EXPECT_EQ(NETCDF(nc_get_var)(id_, variable(name), found.data()), NC_NOERR);
    return found;
  }

 private:
  int id_ = 0;
};

bool same_bits(const std::vector<double>& one, const std::vector<double>& other) {
  return one.size() == other.size() &&
         std::memcmp(one.data(), other.data(), one.size() * sizeof(double)) == 0;
}

TEST(Netcdf, HoldsTheChartBitForBit) {
  const TemporaryFolder folder;
  const Chart chart = large_chart();
  write_chart(folder / "out.nc", chart);
  const ReadBack file(folder / "out.nc");
  const std::vector<std::pair<std::string, std::size_t>> over = {{"gain", 401}, {"d", 703}};
  for (const std::string name : {"amplitude_m", "stable", "exponent"})
    EXPECT_EQ(file.dimensions(name), over) << name;
  EXPECT_TRUE(same_bits(file.values<double>("amplitude_m"), chart.first));
  EXPECT_TRUE(same_bits(file.values<double>("exponent"), chart.last));
  const auto flags = file.values<std::uint8_t>("stable");
  EXPECT_TRUE(flags == chart.flags);
  for (const GridAxis& axis : {chart.slow, chart.fast}) {
    const std::string& name = axis.column.name;
    EXPECT_EQ(file.dimensions(name),
              (std::vector<std::pair<std::string, std::size_t>>{{name, axis.count()}}));
    const auto values = file.values<double>(name);
    for (std::size_t i = 0; i < axis.count(); ++i) EXPECT_EQ(values[i], axis.at(i));
  }
}

TEST(Netcdf, SaysWhatItsVariablesAre) {
  const TemporaryFolder folder;
  write_chart(folder / "out.nc", large_chart());
  const ReadBack file(folder / "out.nc");
  EXPECT_EQ(file.format(), NC_FORMAT_NETCDF4);
  EXPECT_EQ(file.text("gain", "units"), "N m-1");
  EXPECT_EQ(file.text("gain", "long_name"), "P");
  EXPECT_EQ(file.text("d", "units"), "N s m-1");
  EXPECT_EQ(file.text("amplitude_m", "units"), "m");
  EXPECT_EQ(file.text("exponent", "units"), "s-1");
  EXPECT_EQ(file.text("exponent", "long_name"), "of \"growth\", the largest");
  EXPECT_EQ(file.type("amplitude_m"), NC_DOUBLE);
  EXPECT_TRUE(std::isnan(file.attribute<double>("amplitude_m", "_FillValue").at(0)));
  EXPECT_FALSE(file.has_attribute("gain", "_FillValue"));
  EXPECT_EQ(file.type("stable"), NC_BYTE);
  EXPECT_EQ(file.attribute<signed char>("stable", "flag_values"), (std::vector<signed char>{0, 1}));
  EXPECT_EQ(file.text("stable", "flag_meanings"), "unstable stable");
}

TEST(Netcdf, CarriesTheCaseAndTheOptionsInPlaceOfAMetadataFile) {
  const TemporaryFolder folder;
  write_chart(folder / "out.nc", large_chart());
  EXPECT_EQ(folder.names(), std::vector<std::string>{"out.nc"});
  const ReadBack file(folder / "out.nc");
  EXPECT_EQ(file.text("", "Conventions"), "CF-1.10");
  EXPECT_EQ(file.text("", "title"), "holdfast stability");
  EXPECT_EQ(file.text("", "source"), std::string("holdfast ") + HOLDFAST_VERSION);
  EXPECT_EQ(file.text("", "options"), R"({"--p":"-600:0:3","--radius":"true"})");
  const Case read = load_case_text(file.text("", "case"), "case", {});
  EXPECT_EQ(case_to_json(read), case_to_json(context_for("").case_data));
}

TEST(Netcdf, TheSameChartGivesTheSameBytes) {
  const TemporaryFolder folder;
  write_chart(folder / "one.nc", large_chart());
  write_chart(folder / "other.nc", large_chart());
  EXPECT_TRUE(read_text(folder / "one.nc") == read_text(folder / "other.nc"));
}

TEST(Netcdf, OfOneCellIsAChartToo) {
  const TemporaryFolder folder;
  const Chart chart =
      random_chart({{"p", "", ""}, Axis{2, 2, 1}}, {{"d", "", ""}, std::vector<double>{3.0}});
  write_chart(folder / "out.nc", chart);
  EXPECT_TRUE(same_bits(ReadBack(folder / "out.nc").values<double>("amplitude_m"), chart.first));
}

TEST(Netcdf, ReplacesAnOlderFileAndIsRefusedWhereNoFileCanBe) {
  const TemporaryFolder folder;
  tests::write_text(folder / "out.nc", "older");
  write_chart(folder / "out.nc", large_chart());
  EXPECT_EQ(ReadBack(folder / "out.nc").format(), NC_FORMAT_NETCDF4);
  fs::create_symlink("/dev/null", folder / "null.nc");
  const auto message =
      message_of<WrongInput>([&] { write_chart(folder / "null.nc", large_chart()); });
  EXPECT_NE(message.find("regular file"), std::string::npos) << message;
  EXPECT_THROW(write_chart(folder / "absent/out.nc", large_chart()), WrongInput);
}

TEST(Netcdf, ThatFindsNoSpaceIsAnOutputErrorInTheSystemsWordsAndLeavesNothing) {
  const TemporaryFolder folder;
  const auto write_within_64_kib = [&] {
    signal(SIGXFSZ, SIG_IGN);
    const struct rlimit limit = {1 << 16, 1 << 16};
    setrlimit(RLIMIT_FSIZE, &limit);
    const auto message =
        message_of<OutputError>([&] { write_chart(folder / "out.nc", large_chart()); });
    return message.find("out.nc: File too large") != std::string::npos ? 7 : 1;
  };
  const pid_t child = fork();
  if (child == 0) _exit(write_within_64_kib());
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 7) << status;
  EXPECT_EQ(folder.files(), 0);
}

#else

TEST(Netcdf, ThatIsMissingIsNamedWithItsPackage) {
  const TemporaryFolder folder;
  const auto message = message_of<NoAnswer>([&] { write_chart(folder / "out.nc", small_chart()); });
  EXPECT_NE(message.find("libnetcdf-dev"), std::string::npos) << message;
  EXPECT_EQ(folder.files(), 0);
}

#endif

}  // namespace
}  // namespace holdfast::program
