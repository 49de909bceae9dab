#include "sweep/tiles/work_folder.hpp"

#include "io/file/folder_lock.hpp"
#include "support/temporary_folder.hpp"
#include "support/testing.hpp"

namespace holdfast::program {
namespace {

using tests::TemporaryFolder;
using tests::write_text;

TEST(WorkFolder, NamesTilesInTheirOrder) {
  EXPECT_EQ(tile_file_name(1234), "tile-000000001234");
  std::string before;
  for (std::int64_t tile = 0, step = 1; tile < 1'000'000'000'000; tile += step, step *= 2) {
    const std::string name = tile_file_name(tile);
    EXPECT_EQ(tile_of_file_name(name), tile);
    EXPECT_LT(before, name);
    before = name;
  }
}

TEST(WorkFolder, KnowsOtherNames) {
  for (const char* name : {"", "tile-", "tile-1234", "tile-00000000123x", "tile--00000000123",
                           "tile-+00000000123", "tile-0000000001234", "Tile-000000001234",
                           ".tile-000000001234", "tile-000000001234~", "tile-00000000 123"}) {
    EXPECT_FALSE(tile_of_file_name(name)) << name;
  }
}

TEST(WorkFolder, SortsWhatLiesInIt) {
  const TemporaryFolder folder;
  for (const char* name : {"plan", "lock", "tile-000000000000", "tile-000000000001"}) {
    write_text(folder / name, "");
  }
  write_text(folder / ".plan-1-0.tmp", "");
  write_text(folder / ".tile-000000000002-1-0.tmp", "");
  const WorkFolderContents contents = contents_of_work_folder(folder.path());
  EXPECT_EQ(contents.tiles, 2);
  EXPECT_EQ(contents.leftovers.size(), 2U);
  EXPECT_FALSE(contents.others);
  write_text(folder / ".table.csv-1-0.tmp", "");
  const WorkFolderContents more = contents_of_work_folder(folder.path());
  EXPECT_EQ(more.leftovers.size(), 2U);
  EXPECT_TRUE(more.others);
}

/// A work folder of 3000 tiles as a sweep leaves it that was killed.
void leave_work_folder(const std::filesystem::path& folder) {
  std::filesystem::create_directory(folder);
  write_text(folder / "plan", tile_plan_text({{{"version", "1"}}, 3000}));
  for (const char* name : {"lock", ".tile-000000000002-1-0.tmp"}) write_text(folder / name, "");
  for (int tile = 0; tile < 3000; ++tile) write_text(folder / tile_file_name(tile), "");
}

TEST(WorkFolder, IsRemovedWithAllThatIsItsOwn) {
  const TemporaryFolder outer;
  leave_work_folder(outer / "work");
  remove_work_folder(outer / "work");
  EXPECT_EQ(outer.files(), 0);
}

TEST(WorkFolder, StaysWithWhatIsNotItsOwn) {
  const TemporaryFolder outer;
  leave_work_folder(outer / "work");
  std::vector<std::string> foreign = {"letter", "tile-000000003000", ".table.csv-1-0.tmp"};
  for (const std::string& name : foreign) write_text(outer / "work" / name, "precious");
  remove_work_folder(outer / "work");
  std::vector<std::string> left;
  for (const auto& entry : std::filesystem::directory_iterator(outer / "work"))
    left.push_back(entry.path().filename().string());
  std::sort(left.begin(), left.end());
  std::sort(foreign.begin(), foreign.end());
  EXPECT_EQ(left, foreign);
}

TEST(WorkFolder, WithoutAWholePlanLosesNothing) {
  for (const std::string& plan : {std::string(), std::string("plan of a house"),
                                  tile_plan_text({{{"version", "1"}}, 3}).substr(1)}) {
    const TemporaryFolder folder;
    for (const char* name : {"letter", "lock", "tile-000000000000", ".plan-1-0.tmp"})
      write_text(folder / name, "precious");
    write_text(folder / "plan", plan);
    remove_work_folder(folder.path());
    EXPECT_EQ(folder.files(), 5);
  }
}

TEST(WorkFolder, ThatAnotherProgramHoldsStays) {
  const TemporaryFolder outer;
  leave_work_folder(outer / "work");
  const FolderLock held(outer / "work");
  remove_work_folder(outer / "work");
  EXPECT_EQ(contents_of_work_folder(outer / "work").tiles, 3000);
}

}  // namespace
}  // namespace holdfast::program
