#include "store/store_folder.hpp"

#include <unistd.h>

#include <map>
#include <thread>

#include "process/errors.hpp"
#include "program/store/small_store.hpp"
#include "support/message_of.hpp"
#include "support/temporary_folder.hpp"

namespace holdfast::program {
namespace {

namespace fs = std::filesystem;
using namespace tests;

TEST(StoreFolder, KeepsItsChunksForWhoeverOpensIt) {
  const TemporaryFolder folder;
  const StoreFolder store = StoreFolder::enter(folder / "x.zarr", small_store());
  for (std::int64_t chunk = 0; chunk < store.grid().chunks(); ++chunk) {
    EXPECT_FALSE(store.has(chunk));
    store.put(chunk, values_of_small_store(chunk));
    EXPECT_EQ(store.chunks_done(), chunk + 1);
  }
  const StoreFolder opened = StoreFolder::open(folder / "x.zarr");
  for (std::int64_t chunk = 0; chunk < store.grid().chunks(); ++chunk)
    EXPECT_EQ(opened.read(chunk), values_of_small_store(chunk));
  const GridAxis& axis = opened.description().axes[0];
  ASSERT_EQ(axis.count(), 7U);
  for (std::size_t i = 0; i < 7; ++i) EXPECT_EQ(axis.at(i), small_store().axes[0].at(i));
  EXPECT_THROW(store.has(4), std::out_of_range);
  store.remove();
  EXPECT_TRUE(folder.names().empty());
}

TEST(StoreFolder, ManyThatBeginItAtOnceAllHaveIt) {
  const TemporaryFolder folder;
  for (int store = 0; store < 5; ++store) {
    const fs::path path = folder / (std::to_string(store) + ".zarr");
    std::vector<std::thread> others;
    for (std::int64_t chunk = 0; chunk < 4; ++chunk)
      others.emplace_back([chunk, path] {
        EXPECT_NO_THROW(
            StoreFolder::enter(path, small_store()).put(chunk, values_of_small_store(chunk)));
      });
    for (std::thread& other : others) other.join();
    EXPECT_EQ(StoreFolder::open(path).chunks_done(), 4);
  }
}

TEST(StoreFolder, IsGoneOnWithByTheSamePlanAlone) {
  const TemporaryFolder folder;
  StoreFolder::enter(folder / "x.zarr", small_store()).put(0, values_of_small_store(0));
  EXPECT_TRUE(StoreFolder::enter(folder / "x.zarr", small_store()).has(0));
  StoreDescription other = small_store();
  other.plan["--duration"] = "60";
  const std::string words =
      message_of<WrongInput>([&] { StoreFolder::enter(folder / "x.zarr", other); });
  EXPECT_NE(words.find("--duration was not given, is 60"), std::string::npos) << words;
}

TEST(StoreFolder, LeavesAloneWhatIsNoStore) {
  const TemporaryFolder folder;
  fs::create_directories(folder / "letters");
  write_text(folder / "letters/zarr.json", "{}");
  EXPECT_THROW(StoreFolder::enter(folder / "letters", small_store()), WrongInput);
  EXPECT_THROW(StoreFolder::open(folder / "letters"), WrongInput);
  EXPECT_THROW(StoreFolder::open(folder / "absent"), WrongInput);
  write_text(folder / "file", "precious");
  EXPECT_THROW(StoreFolder::enter(folder / "file", small_store()), WrongInput);
  EXPECT_EQ(read_text(folder / "file"), "precious");
}

TEST(StoreFolder, AdoptsNoChunksOfWhichNothingTellsWhatTheyAre) {
  const TemporaryFolder folder;
  StoreFolder::enter(folder / "x.zarr", small_store());
  fs::remove(folder / "x.zarr/zarr.json");
  const StoreFolder begun = StoreFolder::enter(folder / "x.zarr", small_store());
  begun.put(0, values_of_small_store(0));
  fs::remove(folder / "x.zarr/zarr.json");
  EXPECT_THROW(StoreFolder::enter(folder / "x.zarr", small_store()), WrongInput);
}

/// A folder, each file with its text, each link with what it leads to.
std::map<std::string, std::string> all_in(const fs::path& folder) {
  std::map<std::string, std::string> all;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    all[entry.path().lexically_relative(folder).string()] =
        entry.is_symlink()        ? fs::read_symlink(entry).string()
        : entry.is_regular_file() ? read_text(entry.path())
                                  : "";
  return all;
}

TEST(StoreFolder, RemovesNothingButWhatItHasWritten) {
  const TemporaryFolder folder;
  const StoreFolder store = StoreFolder::enter(folder / "x.zarr", small_store());
  fs::create_directories(folder / "thesis");
  write_text(folder / "thesis/zarr.json", "mine");
  const auto mine = [&] {
    fs::create_directories(folder / "x.zarr/kind/mine");
    write_text(folder / "x.zarr/kind/mine/zarr.json", "mine");
    for (const char* name : {"c.4.0", "c.0.1", "c.00.0", "c.0.0.0", "c.0.0.txt", "notes"})
      write_text(folder / "x.zarr/kind" / name, "mine");
    write_text(folder / "x.zarr/notes", "mine");
    write_text(folder / "x.zarr/lock", "mine");
    fs::create_symlink("../../thesis/zarr.json", folder / "x.zarr/kind/c.3.0");
    fs::create_symlink("../thesis", folder / "x.zarr/letters");
  };
  mine();
  const auto before = all_in(folder / "x.zarr");
  for (std::int64_t chunk = 0; chunk < 3; ++chunk) store.put(chunk, values_of_small_store(chunk));
  EXPECT_THROW(store.put(3, values_of_small_store(3)), WrongInput);
  write_text(folder / "x.zarr/steady_peak/.c.1.0-4242-7.tmp", "left by a killed process");
  write_text(folder / "x.zarr/steady_peak/.c.2.0.claim", "");
  store.remove();
  auto after = all_in(folder / "x.zarr");
  for (const auto& [name, text] : after) EXPECT_EQ(text, before.at(name)) << name;
  EXPECT_EQ(after.size(), 13U);  // two folders, two links, nine files
  EXPECT_EQ(read_text(folder / "thesis/zarr.json"), "mine");
}

TEST(StoreFolder, WritesAndRemovesNothingThroughALink) {
  const TemporaryFolder folder;
  fs::create_directories(folder / "thesis");
  for (const char* name : {"steady_peak", "backlash_width"}) {
    const fs::path store = folder / (std::string(name) + ".zarr");
    StoreFolder::enter(store, small_store());
    fs::remove_all(store / name);
    fs::create_symlink("../thesis", store / name);
    EXPECT_THROW(StoreFolder::enter(store, small_store()), WrongInput) << name;
    remove_store(store);
    EXPECT_TRUE(fs::is_symlink(store / name));
    EXPECT_TRUE(fs::is_empty(folder / "thesis"));
  }
  StoreFolder::enter(folder / "x.zarr", small_store());
  fs::create_symlink("x.zarr", folder / "link.zarr");
  remove_store(folder / "link.zarr");
  EXPECT_TRUE(fs::exists(folder / "x.zarr/zarr.json"));
}

TEST(StoreFolder, OfAnotherUserIsNotRemoved) {
  if (geteuid() != 0) GTEST_SKIP() << "only root gives folders away";
  const TemporaryFolder folder;
  StoreFolder::enter(folder / "x.zarr", small_store()).put(0, values_of_small_store(0));
  ASSERT_EQ(chown((folder / "x.zarr").c_str(), 4242, 4242), 0);
  const auto before = all_in(folder / "x.zarr");
  remove_store(folder / "x.zarr");
  EXPECT_EQ(all_in(folder / "x.zarr"), before);
}

// Killed between any two of its steps, a removal leaves what is finished or begun anew.
TEST(StoreFolder, ARemovalThatIsCutShortIsFinishedByTheNext) {
  for (const bool others_are_gone : {false, true}) {
    const TemporaryFolder folder;
    StoreFolder::enter(folder / "x.zarr", small_store()).put(2, values_of_small_store(2));
    fs::rename(folder / "x.zarr/zarr.json", folder / "x.zarr/.removed");
    if (others_are_gone) fs::remove_all(folder / "x.zarr/backlash_width");
    EXPECT_THROW(StoreFolder::open(folder / "x.zarr"), WrongInput);
    EXPECT_EQ(StoreFolder::enter(folder / "x.zarr", small_store()).chunks_done(), 0);
    fs::rename(folder / "x.zarr/zarr.json", folder / "x.zarr/.removed");
    remove_store(folder / "x.zarr");
    EXPECT_TRUE(folder.names().empty());
  }
}

// A store's description and axes are checked when it is opened; a chunk says where it belongs.
TEST(StoreFolder, NoticesDamageOfEveryFileThatDescribesIt) {
  const TemporaryFolder folder;
  const fs::path path = folder / "x.zarr";
  const StoreFolder store = StoreFolder::enter(path, small_store());
  const auto whole = all_in(path);
  for (const auto& [name, text] : whole) {
    if (fs::is_directory(path / name)) continue;
    for (const bool missing : {true, false}) {
      if (name == "zarr.json") continue;
      fs::remove(path / name);
      if (!missing) write_text(path / name, text.substr(0, text.size() - 3) + "abc");
      EXPECT_THROW(StoreFolder::open(path), WrongInput) << name;
      StoreFolder::enter(path, small_store());
      EXPECT_NO_THROW(StoreFolder::open(path));
      EXPECT_EQ(all_in(path), whole) << name;
    }
  }
}

TEST(StoreFolder, ReadsNoChunkAtAPlaceOfAnother) {
  if (usual_packing() != ChunkPacking::zstd) GTEST_SKIP() << "built without Zstandard";
  const TemporaryFolder folder;
  const fs::path path = folder / "x.zarr";
  const StoreFolder store = StoreFolder::enter(path, small_store());
  for (std::int64_t chunk = 0; chunk < 2; ++chunk) store.put(chunk, values_of_small_store(chunk));
  fs::rename(path / "steady_peak/c.0.0", path / "kept");
  fs::rename(path / "steady_peak/c.1.0", path / "steady_peak/c.0.0");
  EXPECT_FALSE(store.read(0));
  fs::rename(path / "kept", path / "steady_peak/c.0.0");
  EXPECT_TRUE(store.read(0));
  StoreDescription other = small_store();
  other.plan["--duration"] = "60";
  StoreFolder::enter(folder / "y.zarr", other).put(0, values_of_small_store(1));
  fs::rename(folder / "y.zarr/kind/c.0.0", path / "kind/c.0.0");
  EXPECT_FALSE(store.read(0));
  fs::copy(path / "backlash_width/c.0", folder / "axis");
  fs::copy(folder / "y.zarr/backlash_width/c.0", path / "backlash_width/c.0",
           fs::copy_options::overwrite_existing);
  EXPECT_THROW(StoreFolder::open(path), WrongInput);
}

TEST(StoreFolder, ReadsNoChunkThatIsDamagedOrHasWordsThatAreNone) {
  const TemporaryFolder folder;
  const StoreFolder store = StoreFolder::enter(folder / "x.zarr", small_store());
  const auto damage = [&](const std::string& file, const std::string& text) {
    EXPECT_TRUE(store.read(1));
    write_text(folder / "x.zarr" / file, text);
    EXPECT_TRUE(store.has(1));
    EXPECT_FALSE(store.read(1)) << file;
    store.put(1, values_of_small_store(1));
  };
  store.put(1, values_of_small_store(1));
  damage("steady_peak/c.1.0", "");
  damage("period_samples/c.1.0", read_text(folder / "x.zarr/steady_peak/c.1.0").substr(1));
  const std::string whole = read_text(folder / "x.zarr/kind/c.1.0");
  damage("kind/c.1.0", whole + "x");
  ChunkValues values = values_of_small_store(1);
  values[2][3] = 2.0;
  store.put(1, values);
  EXPECT_FALSE(store.read(1));
}

TEST(ChunkClaim, BelongsToOneAtATime) {
  const TemporaryFolder folder;
  const fs::path chunk = folder / "c.0.1";
  {
    const ChunkClaim first(chunk);
    EXPECT_EQ(first.answer(), ChunkClaim::Answer::ours);
    EXPECT_FALSE(first.was_left());
    EXPECT_EQ(ChunkClaim(chunk).answer(), ChunkClaim::Answer::elsewhere);
    EXPECT_TRUE(ChunkClaim::exists(chunk));
  }
  EXPECT_FALSE(ChunkClaim::exists(chunk));
}

TEST(ChunkClaim, OfAProcessThatIsGoneIsTakenOver) {
  const TemporaryFolder folder;
  const fs::path chunk = folder / "c.0.1";
  write_text(chunk.parent_path() / ".c.0.1.claim", "");
  const ChunkClaim claim(chunk);
  EXPECT_EQ(claim.answer(), ChunkClaim::Answer::ours);
  EXPECT_TRUE(claim.was_left());
}

}  // namespace
}  // namespace holdfast::program
