#include "output/table.hpp"

#include <nlohmann/json.hpp>

#include "case/case_file.hpp"
#include "output/metadata.hpp"
#include "process/errors.hpp"
#include "support/temporary_folder.hpp"

namespace holdfast::program {
namespace {

namespace fs = std::filesystem;
using tests::read_text;
using tests::TemporaryFolder;
using tests::write_text;

const std::vector<Column> columns = {{"time_s", "s", "time"},
                                     {"in_backlash", "", "1 inside the gap", "boolean"}};

JobContext simulation_to(const fs::path& output) {
  JobContext context;
  context.job = "simulate";
  context.case_data = load_case(std::nullopt, {"backlash.width=0.002"});
  context.options = {{"--duration", "10"}, {"--set", "a"}, {"--set", "b"}, {"--set", "c"}};
  context.output = output;
  return context;
}

TEST(Table, AppearsTogetherWithItsMetadata) {
  const TemporaryFolder folder;
  Table table(simulation_to(folder / "out.csv"), columns);
  table.row(0.5, true);
  table.writer().cell(1.0);
  table.writer().cell(0);
  table.writer().end_row();
  EXPECT_FALSE(fs::exists(folder / "out.csv") || fs::exists(folder / "out.csv-metadata.json"));
  table.commit();
  EXPECT_EQ(read_text(folder / "out.csv"), "time_s,in_backlash\r\n0.5,1\r\n1,0\r\n");
  EXPECT_TRUE(fs::exists(folder / "out.csv-metadata.json"));
  EXPECT_EQ(folder.files(), 2);
}

TEST(Table, LeavesNeitherFileWhenTheJobFails) {
  const TemporaryFolder folder;
  const auto failing = [&] {
    Table table(simulation_to(folder / "out.csv"), columns);
    table.row(0.5, true);
    throw NoAnswer("the motion diverges");
  };
  EXPECT_THROW(failing(), NoAnswer);
  EXPECT_EQ(folder.files(), 0);
}

TEST(Table, IsRefusedBeforeAnyRowWhenItsMetadataHasNoPlace) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "out.csv-metadata.json");
  EXPECT_THROW(Table(simulation_to(folder / "out.csv"), columns), WrongInput);
  EXPECT_EQ(folder.files(), 1);
}

TEST(Table, LeavesNoMetadataWhenTheFileCannotAppear) {
  const TemporaryFolder folder;
  Table table(simulation_to(folder / "out.csv"), columns);
  fs::create_directory(folder / "out.csv");  // takes the place in the meantime
  EXPECT_THROW(table.commit(), OutputError);
  EXPECT_FALSE(fs::exists(folder / "out.csv-metadata.json"));
}

TEST(Table, OnADeviceHasNoMetadata) {
  Table table(simulation_to("/dev/null"), columns);
  table.row(1.0, false);
  table.commit();
  EXPECT_FALSE(fs::exists("/dev/null-metadata.json"));
}

TEST(Metadata, DescribesColumnsAndWhatMadeThem) {
  const JobContext context = simulation_to("out.csv");
  const auto json = table_metadata(context, columns, "my out.csv");
  EXPECT_EQ(json["@context"], "http://www.w3.org/ns/csvw");
  EXPECT_EQ(json["url"], "my%20out.csv");
  ASSERT_EQ(json["tableSchema"]["columns"].size(), columns.size());
  const std::map<std::string, nlohmann::ordered_json> values = {
      {"/tableSchema/columns/0/name", "time_s"},
      {"/tableSchema/columns/0/datatype", "double"},
      {"/tableSchema/columns/0/schema:unitText", "s"},
      {"/tableSchema/columns/1/datatype", "boolean"},
      {"/notes/0/holdfast/version", HOLDFAST_VERSION},
      {"/notes/0/holdfast/job", "simulate"},
      {"/notes/0/holdfast/options/--duration", "10"},
      {"/notes/0/holdfast/options/--set", {"a", "b", "c"}},
      {"/notes/0/holdfast/case", case_to_json(context.case_data)}};
  for (const auto& [place, value] : values)
    EXPECT_EQ(json.at(nlohmann::ordered_json::json_pointer(place)), value) << place;
  EXPECT_FALSE(json["tableSchema"]["columns"][1].contains("schema:unitText"));
}

TEST(Metadata, IsTheSameEachTimeAndSurvivesTextThatIsNotUtf8) {
  JobContext context = simulation_to("out.csv");
  context.options.emplace_back("--data", "bad\xff.csv");
  const std::string first = json_text(table_metadata(context, columns, "out.csv"));
  EXPECT_EQ(first, json_text(table_metadata(context, columns, "out.csv")));
  EXPECT_TRUE(nlohmann::json::accept(first));
}

TEST(Metadata, LiesBesideItsTable) {
  EXPECT_EQ(metadata_path("folder/out.csv"), "folder/out.csv-metadata.json");
  EXPECT_EQ(metadata_path("out"), "out-metadata.json");
}

}  // namespace
}  // namespace holdfast::program
