#include "store/store_folder.hpp"

#include <thread>

#include "process/errors.hpp"
#include "program/store/small_store.hpp"
#include "support/message_of.hpp"
#include "support/temporary_folder.hpp"
#include "support/testing.hpp"

namespace holdfast::program {
namespace {

namespace fs = std::filesystem;
using tests::message_of;
using tests::read_text;
using tests::TemporaryFolder;
using tests::write_text;

TEST(StoreFolder, KeepsItsChunksForWhoeverOpensIt) {
  for (const int format : {3, 2}) {
    if (format == 2 && usual_packing() != ChunkPacking::zstd) continue;
    const TemporaryFolder folder;
    const StoreFolder store = StoreFolder::enter(folder / "x.zarr", small_store(format));
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
