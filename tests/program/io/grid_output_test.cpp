#include "output/grid/grid_output.hpp"

#include <sys/resource.h>

#include <nlohmann/json.hpp>

#include "case/case_file.hpp"
#include "io/file/output.hpp"
#include "output/grid/chunk_grid.hpp"
#include "output/grid/grid_attributes.hpp"
#include "output/grid/netcdf_library.hpp"
#include "output/table.hpp"
#include "process/errors.hpp"
#include "process/interrupt.hpp"
#include "program/child_process.hpp"
#include "support/message_of.hpp"
#include "support/temporary_folder.hpp"

#ifdef HOLDFAST_HAS_NETCDF
#include "program/netcdf_variable.hpp"
#endif

namespace holdfast::program {
namespace {

using tests::message_of;
using tests::read_text;
using tests::TemporaryFolder;
#ifdef HOLDFAST_HAS_NETCDF
using tests::NetcdfVariable;
#endif

constexpr double endless = std::numeric_limits<double>::infinity();
constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

/// The formats that this program can write.
std::vector<std::string> grid_formats() {
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

/// A grid with its values, column after column.
struct GridCells {
  GridLayout layout;
  std::vector<std::vector<double>> values;

  std::size_t count() const { return static_cast<std::size_t>(layout.cells()); }

  std::vector<const double*> from(std::size_t cell) const {
    std::vector<const double*> places;
    for (const std::vector<double>& column : values) places.push_back(column.data() + cell);
    return places;
  }
};

/// Random values; among the reals those that are no numbers, among the integers the largest.
GridCells random_cells(std::vector<GridAxis> axes) {
  GridCells cells{{std::move(axes), columns_of_every_kind()}, {{}, {}, {}, {}, {}}};
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
GridCells cells_over(std::size_t axes) {
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

void write_cells(const std::filesystem::path& file, const GridCells& cells, std::size_t portion) {
  GridOutput output(output_context(file), cells.layout);
  for (std::size_t cell = 0; cell < cells.count(); cell += portion) {
    const std::size_t taken = std::min(portion, cells.count() - cell);
    output.append(static_cast<std::int64_t>(taken), cells.from(cell));
  }
  output.commit();
}

/// The index along each axis of a cell.
std::vector<std::size_t> indices_of(const GridLayout& layout, std::size_t cell) {
  std::vector<std::size_t> indices(layout.axes.size());
  for (std::size_t axis = indices.size(); axis-- > 0; cell /= layout.axes[axis].count())
    indices[axis] = cell % layout.axes[axis].count();
  return indices;
}

/// The same grid cell by cell through a Table.
void write_as_table(const std::filesystem::path& file, const GridCells& cells) {
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

TEST(GridOutput, AsCsvIsTheKeysThenTheColumnsTheFirstAxisSlowest) {
  const TemporaryFolder folder;
  const GridCells cells = {{{{{"w", "m", ""}, Axis{0.0, 0.5, 2}},
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

TEST(GridOutput, AsCsvHasTheBytesOfATableAndItsMetadata) {
  for (std::size_t axes = 1; axes <= 4; ++axes) {
    const TemporaryFolder one, other;
    const GridCells cells = cells_over(axes);
    write_cells(one / "out.csv", cells, 10);
    write_as_table(other / "out.csv", cells);
    EXPECT_EQ(read_text(one / "out.csv"), read_text(other / "out.csv"));
    EXPECT_EQ(read_text(one / "out.csv-metadata.json"), read_text(other / "out.csv-metadata.json"));
    EXPECT_EQ(one.files(), 2);
  }
}

TEST(GridOutput, AsCsvIsTheSameInAnyPortions) {
  const TemporaryFolder folder;
  const GridCells cells = random_cells({numbered_axis("a", 41), numbered_axis("b", 3),
                                        numbered_axis("c", 1), numbered_axis("d", 53)});
  write_as_table(folder / "table.csv", cells);
  for (const std::size_t portion : {std::size_t{1}, std::size_t{7}, cells.count()}) {
    write_cells(folder / "out.csv", cells, portion);
    EXPECT_TRUE(read_text(folder / "out.csv") == read_text(folder / "table.csv")) << portion;
  }
}

TEST(GridOutput, CellsThatDoNotFitAreADefect) {
  const TemporaryFolder folder;
  const GridCells cells = cells_over(2);
  for (const std::string& name : grid_formats()) {
    GridOutput output(output_context(folder / name), cells.layout);
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

TEST(GridOutput, ValuesThatTheirColumnCannotHaveAreADefect) {
  const TemporaryFolder folder;
  const GridCells cells = cells_over(1);
  const auto append = [&](std::size_t column, double value) {
    GridCells altered = cells;
    altered.values[column].back() = value;
    write_cells(folder / "out.csv", altered, altered.count());
  };
  const std::map<std::size_t, std::vector<double>> refused = {
      {1, {0.5, no_number, endless, 9007199254740994.0}},
      {2, {2.0, -1.0, 0.5, no_number}},
      {3, {3.0, -1.0, 0.5, no_number}}};
  for (const auto& [column, values] : refused)
    for (const double value : values)
      EXPECT_THROW(append(column, value), std::logic_error) << value;
  EXPECT_EQ(folder.files(), 0);
}

TEST(GridOutput, LayoutsThatCannotBeWrittenAreADefect) {
  const TemporaryFolder folder;
  const auto begin = [&](GridLayout layout) {
    const GridOutput output(output_context(folder / "out.csv"), std::move(layout));
  };
  const auto with_column = [&](const std::string& datatype, std::vector<std::string> words) {
    begin({{numbered_axis("a", 2)}, {{{"x", "", "", datatype}, std::move(words)}}});
  };
  EXPECT_THROW(begin({{}, columns_of_every_kind()}), std::logic_error);
  EXPECT_THROW(begin({{{{"a", "", ""}, std::vector<double>{}}}, {}}), std::logic_error);
  const std::vector<std::pair<const char*, std::vector<std::string>>> refused = {
      {"boolean", {}},           {"double", {"no", "yes"}}, {"string", {}},
      {"string", {"two words"}}, {"string", {""}},          {"string", {129, "x"}}};
  for (const auto& [datatype, words] : refused)
    EXPECT_THROW(with_column(datatype, words), std::logic_error) << datatype;
  EXPECT_NO_THROW(with_column("string", std::vector<std::string>(128, "x")));
  EXPECT_EQ(folder.files(), 0);
}

TEST(GridLayout, CountsItsCellsUnlessTheyAreUncountable) {
  EXPECT_EQ(cells_over(4).layout.cells(), 7 * 5 * 3);
  const GridAxis long_axis = numbered_axis("a", std::int64_t{1} << 21);
  const GridLayout largest = {{long_axis, long_axis, numbered_axis("b", 1 << 20)}, {}};
  EXPECT_EQ(largest.cells(), std::int64_t{1} << 62);
  EXPECT_THROW((GridLayout{{long_axis, long_axis, long_axis}, {}}.cells()), WrongInput);
}

TEST(GridOutput, LeavesWhatThereWasUnlessItIsWhole) {
  const GridCells cells = random_cells({numbered_axis("a", 300), numbered_axis("b", 700)});
  for (const std::string& name : grid_formats()) {
    const TemporaryFolder folder;
    tests::write_text(folder / name, "older");
    const auto interrupted_work = [&] {
      GridOutput output(output_context(folder / name), cells.layout);
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

TEST(GridOutput, ThatCannotBeWrittenIsRefusedBeforeAnythingIsComputed) {
  const TemporaryFolder folder;
  for (const std::string& name : grid_formats()) {
    const auto begin = [&](const std::filesystem::path& file) {
      const GridOutput output(output_context(file), cells_over(2).layout);
    };
    EXPECT_THROW(begin(folder / ("absent/" + name)), WrongInput);
    std::filesystem::create_directory(folder / name);
    EXPECT_THROW(begin(folder / name), WrongInput);
  }
  const GridCells cells = random_cells({numbered_axis("a", 20000)});
  EXPECT_THROW(write_cells("/dev/full", cells, cells.count()), OutputError);
}

/// The values of a box that is whole along the last axes, one cell along the first ones, and
/// between them in part along one: those are what stands side by side in the order of cells.
TEST(ChunkShape, IsContiguousInTheOrderOfCellsAndAboutAsLargeAsItMayBe) {
  std::mt19937_64 random(3);
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<std::size_t> shape(1 + random() % 5);
    for (std::size_t& count : shape) count = 1 + random() % (std::size_t{1} << (random() % 20));
    const std::vector<std::size_t> chunk = chunk_shape(shape, values_in_chunk);
    std::size_t axis = 0, values = 1, cells = 1;
    while (axis < shape.size() && chunk[axis] == 1) ++axis;
    for (std::size_t behind = axis + 1; behind < shape.size(); ++behind)
      EXPECT_EQ(chunk[behind], shape[behind]);
    for (std::size_t i = 0; i < shape.size(); ++i) {
      ASSERT_GE(chunk[i], 1U);
      values *= chunk[i];
      cells = std::min(cells * shape[i], values_in_chunk);
    }
    EXPECT_LE(values, values_in_chunk);
    EXPECT_GT(2 * values, cells) << ::testing::PrintToString(shape);
  }
}

TEST(Units, AreWrittenAsUdunitsLikesThem) {
  const std::map<std::string, std::string> units = {
      {"", "1"},      {"m", "m"},       {"m2", "m2"}, {"N/m", "N m-1"}, {"N.s/m", "N s m-1"},
      {"1/s", "s-1"}, {"m/s2", "m s-2"}};
  for (const auto& [ours, theirs] : units) EXPECT_EQ(udunits(ours), theirs);
}

TEST(NetcdfName, IsOneThatEndsInNc) {
  for (const char* name : {"chart.nc", "folder/.nc"}) EXPECT_TRUE(is_netcdf_name(name)) << name;
  for (const char* name : {"chart.nc/chart.csv", "chart.nc4", "nc"})
    EXPECT_FALSE(is_netcdf_name(name)) << name;
  EXPECT_FALSE(is_netcdf_name(std::nullopt));
}

#ifdef HOLDFAST_HAS_NETCDF

/// Bit for bit, but that one nan is as good as another.
bool same_numbers(const std::vector<double>& one, const std::vector<double>& other) {
  return std::equal(one.begin(), one.end(), other.begin(), other.end(), [](double a, double b) {
    return a == b ? std::signbit(a) == std::signbit(b) : std::isnan(a) && std::isnan(b);
  });
}

/// A name as CF admits it, of a key.
std::string without_dots(std::string name) {
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
}

void expect_in_netcdf(const std::filesystem::path& file, const GridCells& cells) {
  std::vector<std::pair<std::string, std::size_t>> over;
  for (const GridAxis& axis : cells.layout.axes) {
    const NetcdfVariable coordinate(file, without_dots(axis.column.name));
    std::vector<double> expected(axis.count());
    for (std::size_t i = 0; i < expected.size(); ++i) expected[i] = axis.at(i);
    EXPECT_TRUE(same_numbers(coordinate.values(), expected)) << axis.column.name;
    over.emplace_back(without_dots(axis.column.name), axis.count());
  }
  for (std::size_t i = 0; i < cells.values.size(); ++i) {
    const std::string& name = cells.layout.columns[i].column.name;
    const NetcdfVariable variable(file, name);
    EXPECT_EQ(variable.dimensions(), over) << name;
    EXPECT_TRUE(same_numbers(variable.values(), cells.values[i])) << name;
  }
}

TEST(GridNetcdf, HoldsTheCellsOverAnyNumberOfAxes) {
  for (std::size_t axes = 1; axes <= 4; ++axes) {
    const TemporaryFolder folder;
    const GridCells cells = cells_over(axes);
    for (const std::size_t portion : {1U, 10U}) {
      write_cells(folder / "out.nc", cells, portion);
      expect_in_netcdf(folder / "out.nc", cells);
      EXPECT_EQ(folder.names(), std::vector<std::string>{"out.nc"});
    }
  }
}

/// Grids of many chunks, cut along a middle axis and along the last one.
TEST(GridNetcdf, HoldsManyChunksAndIsTheSameInAnyPortions) {
  const TemporaryFolder folder;
  for (const std::vector<std::int64_t>& shape :
       std::vector<std::vector<std::int64_t>>{{2, 120, 900}, {3, 70000}, {150, 3, 3, 201}}) {
    std::vector<GridAxis> axes;
    for (const std::int64_t count : shape)
      axes.push_back(numbered_axis("axis" + std::to_string(axes.size()), count));
    const GridCells cells = random_cells(axes);
    write_cells(folder / "whole.nc", cells, cells.count());
    expect_in_netcdf(folder / "whole.nc", cells);
    for (const std::size_t portion : {std::size_t{7}, std::size_t{65537}}) {
      write_cells(folder / "out.nc", cells, portion);
      EXPECT_TRUE(read_text(folder / "out.nc") == read_text(folder / "whole.nc")) << portion;
    }
    const NetcdfVariable variable(folder / "out.nc", "kind");
    EXPECT_EQ(variable.chunk(), chunk_shape({shape.begin(), shape.end()}, values_in_chunk));
    EXPECT_TRUE(variable.is_compressed());
  }
}

TEST(GridNetcdf, SaysWhatItsVariablesAre) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder / "out.nc";
  write_cells(file, cells_over(1), 7);
  const std::map<std::string, int> types = {{"backlash_width", NC_DOUBLE},
                                            {"steady_peak", NC_DOUBLE},
                                            {"period_samples", NC_INT64},
                                            {"attenuates", NC_BYTE},
                                            {"kind", NC_BYTE}};
  for (const auto& [name, type] : types) EXPECT_EQ(NetcdfVariable(file, name).type(), type) << name;
  const std::vector<std::array<const char*, 3>> texts = {
      {"backlash_width", "key", "backlash.width"},
      {"backlash_width", "units", "m"},
      {"backlash_width", "long_name", "r0"},
      {"steady_peak", "units", "m"},
      {"rate", "units", "s-1"},
      {"period_samples", "units", "1"},
      {"attenuates", "flag_meanings", "no yes"},
      {"kind", "flag_meanings", "periodic quasi-periodic not,\"known\""},
      {"kind", "long_name", "of motion"}};
  for (const auto& [name, attribute, text] : texts)
    EXPECT_EQ(NetcdfVariable(file, name).text(attribute), text) << name;
  EXPECT_FALSE(NetcdfVariable(file, "backlash_width").has("_FillValue"));
  EXPECT_FALSE(NetcdfVariable(file, "period_samples").has("flag_meanings"));
  const NetcdfVariable peak(file, "steady_peak");
  EXPECT_EQ(peak.format(), NC_FORMAT_NETCDF4);
  EXPECT_TRUE(std::isnan(peak.numbers("_FillValue").at(0)));
  EXPECT_EQ(NetcdfVariable(file, "attenuates").numbers("flag_values"), (std::vector<double>{0, 1}));
  EXPECT_EQ(NetcdfVariable(file, "kind").numbers("flag_values"), (std::vector<double>{0, 1, 2}));
}

TEST(GridNetcdf, CarriesTheCaseAndTheOptionsInPlaceOfAMetadataFile) {
  const TemporaryFolder folder;
  write_cells(folder / "out.nc", cells_over(2), 35);
  EXPECT_EQ(folder.names(), std::vector<std::string>{"out.nc"});
  const NetcdfVariable file(folder / "out.nc");
  EXPECT_EQ(file.text("Conventions"), "CF-1.10");
  EXPECT_EQ(file.text("title"), "holdfast sweep");
  EXPECT_EQ(file.text("source"), std::string("holdfast ") + HOLDFAST_VERSION);
  EXPECT_EQ(file.text("history"), std::string("holdfast ") + HOLDFAST_VERSION +
                                      ": holdfast sweep --axis 'backlash.width=0:0.003:7' --axis "
                                      "'initial.z1=0:1:5'");
  EXPECT_EQ(file.text("options"), R"({"--axis":["backlash.width=0:0.003:7","initial.z1=0:1:5"]})");
  const Case read = load_case_text(file.text("case"), "case", {});
  EXPECT_EQ(case_to_json(read), case_to_json(output_context("").case_data));
}

TEST(GridNetcdf, IsRefusedWhereNoFileCanBe) {
  const TemporaryFolder folder;
  std::filesystem::create_symlink("/dev/null", folder / "null.nc");
  const auto message =
      message_of<WrongInput>([&] { write_cells(folder / "null.nc", cells_over(2), 1); });
  EXPECT_NE(message.find("regular file"), std::string::npos) << message;
}

TEST(GridNetcdf, ThatFindsNoSpaceIsAnOutputErrorInTheSystemsWordsAndLeavesNothing) {
  const TemporaryFolder folder;
  const GridCells cells = random_cells({numbered_axis("a", 401), numbered_axis("b", 703)});
  const auto write_within_64_kib = [&] {
    signal(SIGXFSZ, SIG_IGN);
    const struct rlimit limit = {1 << 16, 1 << 16};
    setrlimit(RLIMIT_FSIZE, &limit);
    const auto message =
        message_of<OutputError>([&] { write_cells(folder / "out.nc", cells, 703); });
    return message.find("out.nc: File too large") != std::string::npos ? 7 : 1;
  };
  EXPECT_EQ(tests::exit_code_of_child(write_within_64_kib), 7);
  EXPECT_EQ(folder.files(), 0);
}

#else

TEST(GridNetcdf, ThatIsMissingIsNamedWithItsPackage) {
  const TemporaryFolder folder;
  const auto message =
      message_of<NoAnswer>([&] { write_cells(folder / "out.nc", cells_over(2), 1); });
  EXPECT_NE(message.find("libnetcdf-dev"), std::string::npos) << message;
  EXPECT_EQ(folder.files(), 0);
}

#endif

}  // namespace
}  // namespace holdfast::program
