#include "sweep/tiles/work_folder.hpp"

#include <gtest/gtest.h>

#include "support/temporary_folder.hpp"

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

TEST(WorkFolder, IsRemovedWithAllThatIsItsOwn) {
  const TemporaryFolder outer;
  std::filesystem::create_directory(outer / "work");
  for (const char* name : {"plan", "lock", ".tile-000000000002-1-0.tmp"}) {
    write_text(outer / "work" / name, "");
  }
  for (int tile = 0; tile < 3000; ++tile) write_text(outer / "work" / tile_file_name(tile), "");
  remove_work_folder(outer / "work");
  EXPECT_EQ(outer.files(), 0);
}

}  // namespace
}  // namespace holdfast::program
