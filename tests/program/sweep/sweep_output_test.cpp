#include "sweep/sweep_output.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <limits>
#include <random>
#include <stdexcept>

#include "case/case_file.hpp"
#include "io/grid/cell_blocks.hpp"
#include "io/grid/netcdf_file.hpp"
#include "io/grid/netcdf_library.hpp"
#include "io/text/table.hpp"
#include "process/errors.hpp"
#include "process/interrupt.hpp"
#include "support/message_of.hpp"
#include "support/temporary_folder.hpp"

#ifdef HOLDFAST_HAS_NETCDF
#include <netcdf.h>
#endif

namespace holdfast::program {
namespace {

using tests::message_of;
using tests::read_text;
using tests::TemporaryFolder;

constexpr double endless = std::numeric_limits<double>::infinity();
constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

/// The formats that this program can write.
std::vector<std::string> sweep_formats() {
#ifdef HOLDFAST_HAS_NETCDF
  return {"out.csv", "out.nc"};
#else
  return {"out.csv"};
#endif
}

JobContext output_context(const std::filesystem::path& output) {
  JobContext context;
  context.job = "sweep";
  context.case_data = load_case(std::nullopt, {"control.sampling_period=0.004"});
  context.options = {{"--axis", "backlash.width=0:0.003:7"}, {"--axis", "initial.z1=0:1:5"}};
  context.output = output;
  return context;
}

/// A column of each kind, with a word that CSV must quote.
std::vector<CellColumn> columns_of_every_kind() {
  return {{{"steady_peak", "m", "largest |z1|"}, {}},
          {{"period_samples", "", "0: none", "integer"}, {}},
          {{"attenuates", "", "1: it does", "integer"}, {"no", "yes"}},
          {{"kind", "", "of motion", "string"}, {"periodic", "quasi-periodic", "not,\"known\""}},
          {{"rate", "1/s", "of reversals"}, {}}};
}

/// A sweep with its values, column after column.
struct SweepCells {
  SweepLayout layout;
  std::vector<std::vector<double>> values;

  std::size_t count() const { return static_cast<std::size_t>(layout.cells()); }

  std::vector<const double*> from(std::size_t cell) const {
    std::vector<const double*> places;
    for (const std::vector<double>& column : values) places.push_back(column.data() + cell);
    return places;
  }
};

/// Random values; among the reals those that are no numbers, among the integers the largest.
SweepCells random_cells(std::vector<GridAxis> axes) {
  SweepCells cells{{std::move(axes), columns_of_every_kind()}, {{}, {}, {}, {}, {}}};
  std::mt19937_64 random(11);
  constexpr std::array<double, 5> special = {endless, -endless, no_number, -0.0, 5e-324};
  constexpr std::array<double, 3> whole = {9007199254740992.0, -9007199254740992.0, 4000.0};
  for (std::size_t cell = 0; cell < cells.count(); ++cell) {
    cells.values[0].push_back(std::ldexp(static_cast<double>(random()), -70));
    cells.values[1].push_back(whole[random() % whole.size()]);
    cells.values[2].push_back(static_cast<double>(random() % 2));
    cells.values[3].push_back(static_cast<double>(random() % 3));
    cells.values[4].push_back(special[random() % special.size()]);
  }
  return cells;
}

/// The first so many of four axes of every kind.
SweepCells cells_over(std::size_t axes) {
  const std::vector<GridAxis> all = {
      {{"backlash.width", "m", "r0"}, Axis{0.0, 0.003, 7}},
      {{"excitation.frequency", "Hz", "f"}, LogAxis{0.1, 100.0, 5}},
      {{"gain, \"P\"", "N/m", "P"}, std::vector<double>{-557.0, 1e22, -2.2250738585072014e-308}},
      {{"initial.z1", "m", "z1"}, Axis{0.25, 0.25, 1}}};
  return random_cells({all.begin(), all.begin() + static_cast<std::ptrdiff_t>(axes)});
}

GridAxis numbered_axis(const std::string& name, std::int64_t count) {
  return {{name, "", ""}, Axis{0.0, static_cast<double>(count - 1), count}};
}

void write_cells(const std::filesystem::path& file, const SweepCells& cells, std::size_t portion) {
  SweepOutput output(output_context(file), cells.layout);
  for (std::size_t cell = 0; cell < cells.count(); cell += portion) {
    const std::size_t taken = std::min(portion, cells.count() - cell);
    output.append(static_cast<std::int64_t>(taken), cells.from(cell));
  }
  output.commit();
}

/// The index along each axis of a cell.
std::vector<std::size_t> indices_of(const SweepLayout& layout, std::size_t cell) {
  std::vector<std::size_t> indices(layout.axes.size());
  for (std::size_t axis = indices.size(); axis-- > 0; cell /= layout.axes[axis].count())
    indices[axis] = cell % layout.axes[axis].count();
  return indices;
}

/// The same sweep cell by cell through a Table.
void write_as_table(const std::filesystem::path& file, const SweepCells& cells) {
  std::vector<Column> columns;
  for (const GridAxis& axis : cells.layout.axes) columns.push_back(axis.column);
  for (const CellColumn& column : cells.layout.columns) columns.push_back(column.column);
  Table table(output_context(file), columns);
  for (std::size_t cell = 0; cell < cells.count(); ++cell) {
    const std::vector<std::size_t> indices = indices_of(cells.layout, cell);
    for (std::size_t axis = 0; axis < indices.size(); ++axis)
      table.writer().cell(cells.layout.axes[axis].at(indices[axis]));
    table.writer().cell(cells.values[0][cell]);
    table.writer().cell(std::llround(cells.values[1][cell]));
    table.writer().cell(std::llround(cells.values[2][cell]));
    table.writer().cell(
        cells.layout.columns[3].words[static_cast<std::size_t>(cells.values[3][cell])]);
    table.writer().cell(cells.values[4][cell]);
    table.writer().end_row();
  }
  table.commit();
}

TEST(SweepOutput, AsCsvIsTheKeysThenTheColumnsTheFirstAxisSlowest) {
  const TemporaryFolder folder;
  const SweepCells cells = {{{{{"w", "m", ""}, Axis{0.0, 0.5, 2}},
                              {{"f", "Hz", ""}, LogAxis{1.0, 4.0, 2}},
                              {{"gain, P", "", ""}, std::vector<double>{-5.0, 1e22}}},
                             {{{"peak", "m", ""}, {}},
                              {{"period", "", "", "integer"}, {}},
                              {{"better", "", "", "integer"}, {"no", "yes"}},
                              {{"kind", "", "", "string"}, {"periodic", "a,\"b\""}}}},
                            {{0.25, 1.0, -2.5, endless, -endless, no_number, 1e-7, 3.0},
                             {1000.0, 0.0, -1.0, 9007199254740992.0, 4.0, 5.0, 6.0, 1e15},
                             {0.0, 1.0, 1.0, 0.0, 0.0, 1.0, 0.0, 1.0},
                             {0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0}}};
  write_cells(folder / "out.csv", cells, 8);
  const std::string text = read_text(folder / "out.csv");
  EXPECT_EQ(text,
            "w,f,\"gain, P\",peak,period,better,kind\r\n"
            "0,1,-5,0.25,1000,0,periodic\r\n"
            "0,1,1e+22,1,0,1,\"a,\"\"b\"\"\"\r\n"
            "0,4,-5,-2.5,-1,1,periodic\r\n"
            "0,4,1e+22,inf,9007199254740992,0,periodic\r\n"
            "0.5,1,-5,-inf,4,0,\"a,\"\"b\"\"\"\r\n"
            "0.5,1,1e+22,nan,5,1,periodic\r\n"
            "0.5,4,-5,1e-07,6,0,periodic\r\n"
            "0.5,4,1e+22,3,1000000000000000,1,periodic\r\n");
  const CsvTable table = parse_csv(text, "out.csv");
  EXPECT_EQ(table.rows(), 8U);
  EXPECT_EQ(table.numbers("period"), cells.values[1]);
  EXPECT_EQ(table.text(4, "kind"), "a,\"b\"");
}

TEST(SweepOutput, AsCsvHasTheBytesOfATableAndItsMetadata) {
  for (std::size_t axes = 1; axes <= 4; ++axes) {
    const TemporaryFolder one, other;
    const SweepCells cells = cells_over(axes);
    write_cells(one / "out.csv", cells, 10);
    write_as_table(other / "out.csv", cells);
    EXPECT_EQ(read_text(one / "out.csv"), read_text(other / "out.csv"));
    EXPECT_EQ(read_text(one / "out.csv-metadata.json"), read_text(other / "out.csv-metadata.json"));
    EXPECT_EQ(one.files(), 2);
  }
}

TEST(SweepOutput, AsCsvIsTheSameInAnyPortions) {
  const TemporaryFolder folder;
  const SweepCells cells = random_cells({numbered_axis("a", 41), numbered_axis("b", 3),
                                         numbered_axis("c", 1), numbered_axis("d", 53)});
  write_as_table(folder / "table.csv", cells);
  for (const std::size_t portion : {std::size_t{1}, std::size_t{7}, cells.count()}) {
    write_cells(folder / "out.csv", cells, portion);
    EXPECT_TRUE(read_text(folder / "out.csv") == read_text(folder / "table.csv")) << portion;
  }
}

TEST(SweepOutput, CellsThatDoNotFitAreADefect) {
  const TemporaryFolder folder;
  const SweepCells cells = cells_over(2);
  for (const std::string& name : sweep_formats()) {
    SweepOutput output(output_context(folder / name), cells.layout);
    EXPECT_THROW(output.append(36, cells.from(0)), std::logic_error);
    EXPECT_THROW(output.append(-1, cells.from(0)), std::logic_error);
    EXPECT_THROW(output.append(1, {cells.values[0].data()}), std::logic_error);
    EXPECT_THROW(output.append(1, std::vector<const double*>(5, nullptr)), std::logic_error);
    output.append(34, cells.from(0));
    EXPECT_THROW(output.append(2, cells.from(33)), std::logic_error);
    EXPECT_THROW(output.commit(), std::logic_error);
    output.append(0, cells.from(0));
    output.append(1, cells.from(34));
    output.commit();
    EXPECT_TRUE(std::filesystem::exists(folder / name));
  }
}

TEST(SweepOutput, ValuesThatTheirColumnCannotHaveAreADefect) {
  const TemporaryFolder folder;
  const SweepCells cells = cells_over(1);
  const auto append = [&](std::size_t column, double value) {
    SweepCells altered = cells;
    altered.values[column].back() = value;
    write_cells(folder / "out.csv", altered, altered.count());
  };
  for (const double value : {0.5, no_number, endless, 9007199254740994.0})
    EXPECT_THROW(append(1, value), std::logic_error) << value;
  for (const double value : {2.0, -1.0, 0.5, no_number})
    EXPECT_THROW(append(2, value), std::logic_error) << value;
  for (const double value : {3.0, -1.0, 0.5, no_number})
    EXPECT_THROW(append(3, value), std::logic_error) << value;
  EXPECT_EQ(folder.files(), 0);
}

TEST(SweepOutput, LayoutsThatCannotBeWrittenAreADefect) {
  const TemporaryFolder folder;
  const auto begin = [&](SweepLayout layout) {
    const SweepOutput output(output_context(folder / "out.csv"), std::move(layout));
  };
  const auto with_column = [&](const std::string& datatype, std::vector<std::string> words) {
    begin({{numbered_axis("a", 2)}, {{{"x", "", "", datatype}, std::move(words)}}});
  };
  EXPECT_THROW(begin({{}, columns_of_every_kind()}), std::logic_error);
  EXPECT_THROW(begin({{{{"a", "", ""}, std::vector<double>{}}}, {}}), std::logic_error);
  EXPECT_THROW(with_column("boolean", {}), std::logic_error);
  EXPECT_THROW(with_column("double", {"no", "yes"}), std::logic_error);
  EXPECT_THROW(with_column("string", {}), std::logic_error);
  EXPECT_THROW(with_column("string", {"two words"}), std::logic_error);
  EXPECT_THROW(with_column("string", {""}), std::logic_error);
  EXPECT_THROW(with_column("string", std::vector<std::string>(129, "x")), std::logic_error);
  EXPECT_NO_THROW(with_column("string", std::vector<std::string>(128, "x")));
  EXPECT_EQ(folder.files(), 0);
}

TEST(SweepLayout, CountsItsCellsUnlessTheyAreUncountable) {
  EXPECT_EQ(cells_over(4).layout.cells(), 7 * 5 * 3);
  const GridAxis long_axis = numbered_axis("a", std::int64_t{1} << 21);
  const SweepLayout largest = {{long_axis, long_axis, numbered_axis("b", 1 << 20)}, {}};
  EXPECT_EQ(largest.cells(), std::int64_t{1} << 62);
  EXPECT_THROW((SweepLayout{{long_axis, long_axis, long_axis}, {}}.cells()), WrongInput);
}

TEST(SweepOutput, LeavesWhatThereWasUnlessItIsWhole) {
  const SweepCells cells = random_cells({numbered_axis("a", 300), numbered_axis("b", 700)});
  for (const std::string& name : sweep_formats()) {
    const TemporaryFolder folder;
    tests::write_text(folder / name, "older");
    const auto interrupted_work = [&] {
      SweepOutput output(output_context(folder / name), cells.layout);
      output.append(150000, cells.from(0));
      raise(SIGINT);
      output.append(1, cells.from(150000));
    };
    install_signal_handlers();
    EXPECT_THROW(interrupted_work(), Interrupted) << name;
    clear_interrupt();
    EXPECT_EQ(folder.names(), std::vector<std::string>{name});
    EXPECT_EQ(read_text(folder / name), "older");
    write_cells(folder / name, cells, cells.count());
    EXPECT_NE(read_text(folder / name), "older");
  }
}

TEST(SweepOutput, ThatCannotBeWrittenIsRefusedBeforeAnythingIsComputed) {
  const TemporaryFolder folder;
  for (const std::string& name : sweep_formats()) {
    const auto begin = [&](const std::filesystem::path& file) {
      const SweepOutput output(output_context(file), cells_over(2).layout);
    };
    EXPECT_THROW(begin(folder / ("absent/" + name)), WrongInput);
    std::filesystem::create_directory(folder / name);
    EXPECT_THROW(begin(folder / name), WrongInput);
  }
  const SweepCells cells = random_cells({numbered_axis("a", 20000)});
  EXPECT_THROW(write_cells("/dev/full", cells, cells.count()), OutputError);
}

/// The values of a box that is whole along the last axes, one cell along the first ones, and
/// between them in part along one: those are what stands side by side in the order of cells.
TEST(ChunkShape, IsContiguousInTheOrderOfCellsAndAboutAsLargeAsItMayBe) {
  std::mt19937_64 random(3);
  for (int trial = 0; trial < 300; ++trial) {
    NetcdfFile::Shape shape(1 + random() % 5);
    for (std::size_t& count : shape) count = 1 + random() % (std::size_t{1} << (random() % 20));
    const NetcdfFile::Shape chunk = chunk_shape(shape, values_in_block);
    std::size_t axis = 0, values = 1, cells = 1;
    while (axis < shape.size() && chunk[axis] == 1) ++axis;
    for (std::size_t behind = axis + 1; behind < shape.size(); ++behind)
      EXPECT_EQ(chunk[behind], shape[behind]);
    for (std::size_t i = 0; i < shape.size(); ++i) {
      ASSERT_GE(chunk[i], 1U);
      values *= chunk[i];
      cells = std::min(cells * shape[i], values_in_block);
    }
    EXPECT_LE(values, values_in_block);
    EXPECT_GT(2 * values, cells) << ::testing::PrintToString(shape);
  }
}

#ifdef HOLDFAST_HAS_NETCDF

/// The library's function of that name.
#define NETCDF(function) netcdf_function<decltype(function)>(#function)

/// A variable of a netCDF file, read by the library that others read it with.
class SweepVariable {
 public:
  SweepVariable(const std::filesystem::path& file, const std::string& name) {
    EXPECT_EQ(NETCDF(nc_open)(file.c_str(), NC_NOWRITE, &file_), NC_NOERR);
    EXPECT_EQ(NETCDF(nc_inq_varid)(file_, name.c_str(), &number_), NC_NOERR) << name;
  }
  ~SweepVariable() { NETCDF(nc_close)(file_); }
  SweepVariable(const SweepVariable&) = delete;
  SweepVariable& operator=(const SweepVariable&) = delete;
  SweepVariable(SweepVariable&&) = delete;
  SweepVariable& operator=(SweepVariable&&) = delete;

  int type() const {
    nc_type type = NC_NAT;
    EXPECT_EQ(NETCDF(nc_inq_vartype)(file_, number_, &type), NC_NOERR);
    return type;
  }

  /// Names and lengths, the slowest first.
  std::vector<std::pair<std::string, std::size_t>> dimensions() const {
    int count = 0;
    std::array<int, NC_MAX_VAR_DIMS> numbers{};
    EXPECT_EQ(NETCDF(nc_inq_varndims)(file_, number_, &count), NC_NOERR);
    EXPECT_EQ(NETCDF(nc_inq_vardimid)(file_, number_, numbers.data()), NC_NOERR);
    std::vector<std::pair<std::string, std::size_t>> found;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      std::array<char, NC_MAX_NAME + 1> name{};
      std::size_t length = 0;
      EXPECT_EQ(NETCDF(nc_inq_dim)(file_, numbers[i], name.data(), &length), NC_NOERR);
      found.emplace_back(name.data(), length);
    }
    return found;
  }

  bool has(const std::string& attribute) const {
    std::size_t length = 0;
    return NETCDF(nc_inq_attlen)(file_, number_, attribute.c_str(), &length) == NC_NOERR;
  }

  std::string attribute(const std::string& name) const {
    std::size_t length = 0;
    EXPECT_EQ(NETCDF(nc_inq_attlen)(file_, number_, name.c_str(), &length), NC_NOERR) << name;
    std::string text(length, ' ');
    EXPECT_EQ(NETCDF(nc_get_att_text)(file_, number_, name.c_str(), text.data()), NC_NOERR);
    return text;
  }

  std::vector<signed char> flag_values() const {
    std::size_t length = 0;
    EXPECT_EQ(NETCDF(nc_inq_attlen)(file_, number_, "flag_values", &length), NC_NOERR);
    std::vector<signed char> found(length);
    EXPECT_EQ(NETCDF(nc_get_att_schar)(file_, number_, "flag_values", found.data()), NC_NOERR);
    return found;
  }

  std::vector<std::size_t> chunk() const {
    int storage = 0;
    std::vector<std::size_t> shape(dimensions().size());
    EXPECT_EQ(NETCDF(nc_inq_var_chunking)(file_, number_, &storage, shape.data()), NC_NOERR);
    EXPECT_EQ(storage, NC_CHUNKED);
    return shape;
  }

  bool is_compressed() const {
    int shuffle = 0, deflate = 0, level = 0;
    EXPECT_EQ(NETCDF(nc_inq_var_deflate)(file_, number_, &shuffle, &deflate, &level), NC_NOERR);
    return deflate != 0;
  }

  /// Of a variable of any type; each of its numbers is a double.
  std::vector<double> values() const {
    std::size_t count = 1;
    for (const auto& dimension : dimensions()) count *= dimension.second;
    std::vector<double> found(count);
    EXPECT_EQ(NETCDF(nc_get_var_double)(file_, number_, found.data()), NC_NOERR);
    return found;
  }

 private:
  int file_ = 0;
  int number_ = -1;
};

/// Bit for bit, but that one nan is as good as another.
bool same_numbers(const std::vector<double>& one, const std::vector<double>& other) {
  return std::equal(one.begin(), one.end(), other.begin(), other.end(), [](double a, double b) {
    return a == b ? std::signbit(a) == std::signbit(b) : std::isnan(a) && std::isnan(b);
  });
}

void expect_in_netcdf(const std::filesystem::path& file, const SweepCells& cells) {
  std::vector<std::pair<std::string, std::size_t>> over;
  for (const GridAxis& axis : cells.layout.axes) {
    const SweepVariable coordinate(file, axis.column.name);
    std::vector<double> expected(axis.count());
    for (std::size_t i = 0; i < expected.size(); ++i) expected[i] = axis.at(i);
    EXPECT_TRUE(same_numbers(coordinate.values(), expected)) << axis.column.name;
    over.emplace_back(axis.column.name, axis.count());
  }
  for (std::size_t i = 0; i < cells.values.size(); ++i) {
    const std::string& name = cells.layout.columns[i].column.name;
    const SweepVariable variable(file, name);
    EXPECT_EQ(variable.dimensions(), over) << name;
    EXPECT_TRUE(same_numbers(variable.values(), cells.values[i])) << name;
  }
}

TEST(SweepNetcdf, HoldsTheCellsOverAnyNumberOfAxes) {
  for (std::size_t axes = 1; axes <= 4; ++axes) {
    const TemporaryFolder folder;
    const SweepCells cells = cells_over(axes);
    write_cells(folder / "out.nc", cells, 10);
    expect_in_netcdf(folder / "out.nc", cells);
    EXPECT_EQ(folder.names(), std::vector<std::string>{"out.nc"});
  }
}

/// Grids of many chunks, cut along a middle axis and along the last one.
TEST(SweepNetcdf, HoldsManyChunksAndIsTheSameInAnyPortions) {
  const TemporaryFolder folder;
  for (const std::vector<std::int64_t>& shape :
       std::vector<std::vector<std::int64_t>>{{2, 120, 900}, {3, 70000}, {150, 3, 3, 201}}) {
    std::vector<GridAxis> axes;
    for (const std::int64_t count : shape)
      axes.push_back(numbered_axis("axis" + std::to_string(axes.size()), count));
    const SweepCells cells = random_cells(axes);
    write_cells(folder / "whole.nc", cells, cells.count());
    expect_in_netcdf(folder / "whole.nc", cells);
    for (const std::size_t portion : {std::size_t{7}, std::size_t{65537}}) {
      write_cells(folder / "out.nc", cells, portion);
      EXPECT_TRUE(read_text(folder / "out.nc") == read_text(folder / "whole.nc")) << portion;
    }
    const SweepVariable variable(folder / "out.nc", "kind");
    EXPECT_EQ(variable.chunk(), chunk_shape({shape.begin(), shape.end()}, std::size_t{1} << 16));
    EXPECT_TRUE(variable.is_compressed());
  }
}

TEST(SweepNetcdf, HoldsCellsThatComeOneByOne) {
  const TemporaryFolder folder;
  const SweepCells cells = cells_over(3);
  write_cells(folder / "out.nc", cells, 1);
  expect_in_netcdf(folder / "out.nc", cells);
}

TEST(SweepNetcdf, SaysWhatItsVariablesAre) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder / "out.nc";
  write_cells(file, cells_over(1), 7);
  const SweepVariable width(file, "backlash.width"), peak(file, "steady_peak"),
      period(file, "period_samples"), attenuates(file, "attenuates"), kind(file, "kind");
  EXPECT_EQ(width.type(), NC_DOUBLE);
  EXPECT_EQ(width.attribute("units"), "m");
  EXPECT_EQ(width.attribute("long_name"), "r0");
  EXPECT_FALSE(width.has("_FillValue"));
  EXPECT_EQ(peak.type(), NC_DOUBLE);
  EXPECT_EQ(peak.attribute("units"), "m");
  EXPECT_TRUE(peak.has("_FillValue"));
  EXPECT_EQ(SweepVariable(file, "rate").attribute("units"), "s-1");
  EXPECT_EQ(period.type(), NC_INT64);
  EXPECT_EQ(period.attribute("units"), "1");
  EXPECT_FALSE(period.has("flag_meanings"));
  EXPECT_EQ(attenuates.type(), NC_BYTE);
  EXPECT_EQ(attenuates.flag_values(), (std::vector<signed char>{0, 1}));
  EXPECT_EQ(attenuates.attribute("flag_meanings"), "no yes");
  EXPECT_EQ(kind.type(), NC_BYTE);
  EXPECT_EQ(kind.flag_values(), (std::vector<signed char>{0, 1, 2}));
  EXPECT_EQ(kind.attribute("flag_meanings"), "periodic quasi-periodic not,\"known\"");
  EXPECT_EQ(kind.attribute("long_name"), "of motion");
}

#else

TEST(SweepNetcdf, ThatIsMissingIsNamedWithItsPackage) {
  const TemporaryFolder folder;
  const auto message =
      message_of<NoAnswer>([&] { write_cells(folder / "out.nc", cells_over(2), 1); });
  EXPECT_NE(message.find("libnetcdf-dev"), std::string::npos) << message;
  EXPECT_EQ(folder.files(), 0);
}

#endif

}  // namespace
}  // namespace holdfast::program
