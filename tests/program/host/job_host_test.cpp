#include "host/job_host.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "case/case_file.hpp"
#include "holdfast/stability/chart/chart.hpp"
#include "jobs/charts/chart_rows.hpp"
#include "jobs/columns.hpp"
#include "output/grid/grid_output.hpp"
#include "output/table.hpp"
#include "process/exit.hpp"
#include "process/interrupt.hpp"
#include "process/progress.hpp"
#include "support/temporary_folder.hpp"

namespace holdfast::program {
namespace {

using tests::TemporaryFolder;

const std::vector<Column> columns = {
    {"time_s", "s", "time"}, {"count", "", "how many", "integer"}, {"kind", "", "which", "string"}};

JobContext builtin_context() {
  JobContext context;
  context.job = "simulate";
  context.case_data = load_case(std::nullopt, {});
  return context;
}

TEST(JobHost, TakesTablesInPlaceOfText) {
  JobHost host;
  const HostScope here(host);
  testing::internal::CaptureStdout();
  Table table(builtin_context(), columns);
  table.expect(3);
  table.row(0.5, 1, "gap");
  table.row(1.5, 2, std::string("stick"));
  CsvWriter& writer = table.writer();
  writer.cell(2.5), writer.cell(3), writer.cell("gap");
  writer.end_row();
  EXPECT_TRUE(host.tables.empty());
  table.commit();
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  ASSERT_EQ(host.tables.size(), 1u);
  std::vector<ReceivedColumn>& received = host.tables.front().columns;
  EXPECT_EQ(received[0].numbers(), (std::vector<double>{0.5, 1.5, 2.5}));
  EXPECT_EQ(received[1].whole_numbers(), (std::vector<std::int64_t>{1, 2, 3}));
  EXPECT_EQ(received[2].words(), (std::vector<std::string>{"gap", "stick"}));
  EXPECT_EQ(received[2].whole_numbers(), (std::vector<std::int64_t>{0, 1, 0}));
  EXPECT_NE(host.tables.front().origin.find("\"job\":\"simulate\""), std::string::npos);
}

TEST(JobHost, RefusesRowsOfAnotherWidth) {
  JobHost host;
  const HostScope here(host);
  Table table(builtin_context(), columns);
  EXPECT_THROW(table.row(0.5, 1), std::logic_error);
  Table other(builtin_context(), columns);
  EXPECT_THROW(other.row(0.5, 1, "gap", 3.0), std::logic_error);
  Table third(builtin_context(), columns);
  EXPECT_THROW(third.row("gap", 1, "gap"), std::logic_error);
}

TEST(JobHost, LeavesTablesOfFilesToTheFiles) {
  const TemporaryFolder folder;
  JobHost host;
  const HostScope here(host);
  JobContext context = builtin_context();
  context.output = folder / "out.csv";
  Table table(context, columns);
  table.row(0.5, 1, "gap");
  table.commit();
  EXPECT_TRUE(host.tables.empty());
  EXPECT_EQ(folder.files(), 2);
}

TEST(JobHost, ColumnsTakeWhatIsNotOfTheirKind) {
  ReceivedColumn whole({"count", "", "", "integer"});
  whole.put(std::int64_t{3});
  whole.put(4.0);
  EXPECT_EQ(whole.kind(), ReceivedColumn::Kind::whole_numbers);
  whole.put(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(whole.kind(), ReceivedColumn::Kind::numbers);
  EXPECT_EQ(whole.rows(), 3u);
  EXPECT_EQ(whole.numbers()[1], 4.0);
  ReceivedColumn number({"time", "", ""});
  number.put(std::int64_t{3});
  number.put(std::string_view(""));
  EXPECT_EQ(number.numbers()[0], 3.0);
  EXPECT_TRUE(std::isnan(number.numbers()[1]));
  EXPECT_THROW(number.put(std::string_view("soon")), std::logic_error);
}

TEST(JobHost, TakesGridsWithTheirAxes) {
  JobHost host;
  const HostScope here(host);
  const GridLayout layout{
      {{{"p", "N/m", "P"}, Axis{0.0, 1.0, 2}}, {{"d", "", "D"}, Axis{3.0, 5.0, 3}}},
      {{{"stable", "", "", "integer"}, {"no", "yes"}}, {{"radius", "", ""}, {}}}};
  GridOutput output(builtin_context(), layout);
  const std::vector<double> stable = {0, 1, 1, 0, 0, 1}, radius = {1, 2, 3, 4, 5, 6};
  output.append(2, {stable.data(), radius.data()});
  output.append(4, {stable.data() + 2, radius.data() + 2});
  output.commit();
  ReceivedTable& table = host.tables.at(0);
  EXPECT_EQ(table.axes[1].values, (std::vector<double>{3, 4, 5}));
  EXPECT_EQ(table.columns[0].whole_numbers(), (std::vector<std::int64_t>{0, 1, 1, 0, 0, 1}));
  EXPECT_EQ(table.columns[1].numbers(), radius);
}

TEST(JobHost, GetsWarningsAndProgressOfItsThread) {
  JobHost host;
  testing::internal::CaptureStderr();
  {
    const HostScope here(host);
    report_warning("of a value", true);
    report_error("of an outcome");
    Progress progress(10, "stability", false);
    std::thread([&] { progress.advance(4); }).join();
    EXPECT_EQ(host.steps, 10u);
    EXPECT_EQ(host.steps_done, 4u);
    EXPECT_EQ(JobHost::current(), &host);
    std::thread([] { EXPECT_EQ(JobHost::current(), nullptr); }).join();
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(host.warnings, (std::vector<std::string>{"of a value", "of an outcome"}));
  EXPECT_EQ(JobHost::current(), nullptr);
}

TEST(JobHost, AsksAComputationToEnd) {
  request_stop();
  EXPECT_TRUE(interrupted());
  EXPECT_THROW(throw_if_interrupted(), Interrupted);
  forget_asking();
  EXPECT_FALSE(interrupted());
}

/// The chart into arrays is the job's.
TEST(JobHost, FillsChartsAsTheJobDoes) {
  const Case the_case = load_case(std::nullopt, {});
  const GainGrid grid{{-1000.0, 200.0, 70}, {-40.0, 20.0, 41}};
  std::vector<std::uint8_t> stable(70 * 41);
  std::vector<double> radius(stable.size());
  const ChartRows rows = stability_chart_of(the_case, grid, true, InstructionSet::baseline);
  fill_chart(rows, {41, stable.data(), {radius.data()}}, 2);
  JobHost host;
  const HostScope here(host);
  write_chart(builtin_context(), {gain_axes(grid), cell_columns_of("sampled stability")}, rows);
  EXPECT_EQ(host.tables.at(0).columns[1].numbers(), radius);
  for (std::size_t cell = 0; cell < stable.size(); ++cell)
    ASSERT_EQ(host.tables[0].columns[0].whole_numbers()[cell], stable[cell]);
}

}  // namespace
}  // namespace holdfast::program
