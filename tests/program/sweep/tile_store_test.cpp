#include "sweep/tiles/tile_store.hpp"

#include <sys/resource.h>

#include "process/errors.hpp"
#include "program/child_process.hpp"
#include "support/message_of.hpp"
#include "support/temporary_folder.hpp"
#include "support/testing.hpp"
#include "sweep/tiles/tile_file.hpp"
#include "sweep/tiles/tile_plan_file.hpp"

namespace holdfast::program {
namespace {

namespace fs = std::filesystem;
using tests::exit_code_of_child;
using tests::message_of;
using tests::read_text;
using tests::TemporaryFolder;
using tests::write_text;

TilePlan plan_of_store(const std::string& duration = "20") {
  return {{{"version", "0.6.0"}, {"--duration", duration}}, 100};
}

std::string bytes_of(std::int64_t tile) {
  return std::string(static_cast<std::size_t>(3 * tile), static_cast<char>('A' + tile));
}

fs::path file_of(const fs::path& folder, std::int64_t tile) {
  const std::string digits = std::to_string(tile);
  return folder / ("tile-" + std::string(12 - digits.size(), '0') + digits);
}

/// A work folder that a computation left with its first tiles.
class TileStoreTest : public ::testing::Test {
 protected:
  void leave_tiles(std::int64_t tiles) const {
    const TileStore store = TileStore::open(folder(), plan_of_store(), false);
    for (std::int64_t tile = 0; tile < tiles; ++tile) store.put(tile, bytes_of(tile));
  }

  TileStore resumed() const { return TileStore::open(folder(), plan_of_store(), true); }

  std::string refusal(const TilePlan& plan, bool resume) const {
    return message_of<WrongInput>([&] { TileStore::open(folder(), plan, resume); });
  }

  std::vector<std::string> names() const {
    std::vector<std::string> result;
    for (const auto& entry : fs::directory_iterator(folder())) {
      result.push_back(entry.path().filename().string());
    }
    std::sort(result.begin(), result.end());
    return result;
  }

  fs::path folder() const { return outer_ / "sweep.csv-tiles"; }
  const TemporaryFolder& outer() const { return outer_; }

 private:
  TemporaryFolder outer_;
};

TEST_F(TileStoreTest, GivesBackWhatWasPut) {
  const TileStore store = TileStore::open(folder(), plan_of_store(), false);
  for (const std::int64_t tile : {0, 99, 40}) {
    EXPECT_FALSE(store.has(tile));
    store.put(tile, bytes_of(tile));
    EXPECT_TRUE(store.has(tile));
    EXPECT_EQ(store.get(tile), bytes_of(tile));
  }
  EXPECT_FALSE(store.has(1));
  EXPECT_EQ(store.folder(), folder());
  EXPECT_EQ(names(), (std::vector<std::string>{"lock", "plan", "tile-000000000000",
                                               "tile-000000000040", "tile-000000000099"}));
}

TEST_F(TileStoreTest, WritesThePlanBeforeAnyTile) {
  const TileStore store = TileStore::open(folder(), plan_of_store(), false);
  EXPECT_EQ(read_text(folder() / "plan"), tile_plan_text(plan_of_store()));
}

TEST_F(TileStoreTest, TakesTheLastOfTwoContents) {
  const TileStore store = TileStore::open(folder(), plan_of_store(), false);
  store.put(3, "first");
  store.put(3, "second");
  EXPECT_EQ(store.get(3), "second");
}

TEST_F(TileStoreTest, GoesOnWithTheTilesThatAreThere) {
  leave_tiles(12);
  const TileStore store = resumed();
  for (std::int64_t tile = 0; tile < 100; ++tile) EXPECT_EQ(store.has(tile), tile < 12) << tile;
  EXPECT_EQ(store.get(5), bytes_of(5));
}

TEST_F(TileStoreTest, AsksForResumeWhereThereAreTiles) {
  leave_tiles(12);
  EXPECT_EQ(refusal(plan_of_store(), false),
            folder().string() +
                " holds 12 finished tiles of an interrupted sweep; go on with --resume, or remove "
                "the folder to begin anew");
  EXPECT_TRUE(resumed().has(11));
}

TEST_F(TileStoreTest, BeginsAnewWhereThereAreNone) {
  EXPECT_NO_THROW(resumed());
  for (const bool resume : {false, true}) {
    const TilePlan other = plan_of_store(resume ? "30" : "40");
    EXPECT_FALSE(TileStore::open(folder(), other, resume).has(0));
    EXPECT_EQ(read_text(folder() / "plan"), tile_plan_text(other));
  }
  fs::remove_all(folder());
  fs::create_directory(folder());
  EXPECT_FALSE(resumed().has(0));
}

TEST_F(TileStoreTest, NamesWhatDiffersFromTheSweepOfTheTiles) {
  leave_tiles(2);
  TilePlan other = plan_of_store("60");
  other.tiles = 101;
  EXPECT_EQ(refusal(other, true),
            "the tiles in " + folder().string() +
                " are of another sweep: --duration was 20, is 60; the number of tiles was 100, is "
                "101; give the same options, another --output, or remove the folder");
  EXPECT_TRUE(resumed().has(1));
}

TEST_F(TileStoreTest, SaysThatThePlanIsDamagedOrMissing) {
  leave_tiles(1);
  const std::string text = read_text(folder() / "plan");
  const std::string held = folder().string() + " holds 1 finished tile, but its plan is ";
  for (const std::string& bad : {std::string(), text.substr(0, 40), text + "x", std::string(99, 0),
                                 std::string("\xFF\xFE\\x\n = \n")}) {
    write_text(folder() / "plan", bad);
    EXPECT_EQ(refusal(plan_of_store(), true), held + "damaged; remove the folder to begin anew");
  }
  fs::remove(folder() / "plan");
  EXPECT_EQ(refusal(plan_of_store(), true), held + "missing; remove the folder to begin anew");
  fs::create_directory(folder() / "plan");
  EXPECT_EQ(refusal(plan_of_store(), true),
            "cannot read " + (folder() / "plan").string() + ": Is a directory");
}

TEST_F(TileStoreTest, BeginsAnewWithADamagedPlanOfNoTiles) {
  leave_tiles(0);
  const std::string text = read_text(folder() / "plan");
  for (const std::string& bad : {std::string(), text.substr(0, 40)}) {
    write_text(folder() / "plan", bad);
    EXPECT_NO_THROW(resumed());
    EXPECT_EQ(read_text(folder() / "plan"), text);
  }
}

TEST_F(TileStoreTest, LeavesFoldersOfOthersAlone) {
  fs::create_directory(folder());
  write_text(folder() / "thesis.txt", "mine");
  EXPECT_EQ(refusal(plan_of_store(), true),
            folder().string() + " is no work folder: it holds other files and no plan");
  write_text(folder() / "plan", "buy cables");
  EXPECT_EQ(refusal(plan_of_store(), false),
            folder().string() + " is no work folder: its file plan is of another kind");
  EXPECT_EQ(read_text(folder() / "plan"), "buy cables");
  EXPECT_EQ(names(), (std::vector<std::string>{"plan", "thesis.txt"}));
}

TEST_F(TileStoreTest, SaysWhyTheFolderCannotBeMade) {
  write_text(folder(), "a file");
  EXPECT_NE(refusal(plan_of_store(), false).find("cannot write " + folder().string()),
            std::string::npos);
  const fs::path missing = outer() / "missing" / "folder";
  EXPECT_EQ(message_of<WrongInput>([&] { TileStore::open(missing, plan_of_store(), false); }),
            "cannot write " + missing.string() + ": No such file or directory");
}

TEST_F(TileStoreTest, TakesATruncatedTileForMissing) {
  leave_tiles(3);
  const std::string whole = read_text(file_of(folder(), 2));
  for (std::size_t length = 0; length < whole.size(); ++length) {
    write_text(file_of(folder(), 2), whole.substr(0, length));
    EXPECT_FALSE(resumed().has(2)) << length;
  }
  const TileStore store = resumed();
  store.put(2, bytes_of(2));
  EXPECT_EQ(read_text(file_of(folder(), 2)), whole);
}

TEST_F(TileStoreTest, TakesATileWithAnyBitFlippedForMissing) {
  leave_tiles(3);
  const std::string whole = read_text(file_of(folder(), 2));
  const TileStore store = resumed();
  for (std::size_t bit = 0; bit < 8 * whole.size(); ++bit) {
    std::string altered = whole;
    altered[bit / 8] = static_cast<char>(altered[bit / 8] ^ (1 << (bit % 8)));
    write_text(file_of(folder(), 2), altered);
    EXPECT_FALSE(store.has(2)) << bit;
  }
}

TEST_F(TileStoreTest, TakesATileOfAnotherSweepForMissing) {
  leave_tiles(3);
  write_text(file_of(folder(), 1), tile_file({tile_plan_identity(plan_of_store("60")), 1}, "xyz"));
  EXPECT_FALSE(resumed().has(1));
  write_text(file_of(folder(), 1), tile_file({tile_plan_identity(plan_of_store()), 1}, "xyz"));
  EXPECT_EQ(resumed().get(1), "xyz");
}

TEST_F(TileStoreTest, TakesRenamedTilesForMissing) {
  leave_tiles(3);
  fs::rename(file_of(folder(), 0), file_of(folder(), 7));
  fs::rename(file_of(folder(), 1), file_of(folder(), 8));
  fs::rename(file_of(folder(), 2), file_of(folder(), 1));
  fs::rename(file_of(folder(), 8), file_of(folder(), 2));
  const TileStore store = resumed();
  for (const std::int64_t tile : {0, 1, 2, 7, 8}) EXPECT_FALSE(store.has(tile)) << tile;
}

TEST_F(TileStoreTest, TakesAFolderOrALinkToNothingForNoTile) {
  leave_tiles(1);
  fs::create_directory(file_of(folder(), 1));
  fs::create_symlink("nowhere", file_of(folder(), 2));
  const TileStore store = resumed();
  EXPECT_FALSE(store.has(1));
  EXPECT_FALSE(store.has(2));
  EXPECT_THROW(store.put(1, "x"), OutputError);
  EXPECT_NO_THROW(store.put(2, "x"));
  EXPECT_EQ(store.get(2), "x");
}

TEST_F(TileStoreTest, SaysWhyATileCannotBeRead) {
  const TileStore store = TileStore::open(folder(), plan_of_store(), false);
  const auto words = [&] { return message_of<OutputError>([&] { store.get(4); }); };
  const std::string start = "cannot read " + file_of(folder(), 4).string() + ": ";
  EXPECT_EQ(words(), start + "No such file or directory");
  store.put(4, "good");
  write_text(file_of(folder(), 4), "bad");
  EXPECT_EQ(words(), start + "it is damaged, or of another sweep");
  EXPECT_FALSE(store.has(4));
}

TEST_F(TileStoreTest, RefusesTilesOutsideThePlan) {
  const TileStore store = TileStore::open(folder(), plan_of_store(), false);
  for (const std::int64_t tile : {std::int64_t{-1}, std::int64_t{100}, std::int64_t{1} << 40}) {
    EXPECT_THROW(store.has(tile), std::out_of_range);
    EXPECT_THROW(store.get(tile), std::out_of_range);
    EXPECT_THROW(store.put(tile, "x"), std::out_of_range);
  }
}

TEST_F(TileStoreTest, KeepsASecondProgramAway) {
  leave_tiles(1);
  const TileStore store = resumed();
  const auto second = [&] {
    try {
      TileStore::open(folder(), plan_of_store(), true);
      return 0;
    } catch (const OutputError& error) {
      return error.what() == folder().string() + " is in use by another program" ? 1 : 2;
    }
  };
  EXPECT_EQ(exit_code_of_child(second), 1);
}

TEST_F(TileStoreTest, LetsProcessesOfOneComputationJoin) {
  TileStore store = TileStore::open(folder(), plan_of_store(), false);
  store.put(1, "one");
  const auto join = [&] {
    const TileStore joined = TileStore::join(folder(), plan_of_store());
    joined.put(2, "two");
    return joined.get(1) == "one" ? 5 : 6;
  };
  EXPECT_EQ(exit_code_of_child(join), 5);
  EXPECT_EQ(store.get(2), "two");
  EXPECT_TRUE(store.has(2));
}

TEST_F(TileStoreTest, JoinsOnlyTheSamePlan) {
  const auto words = [&](const TilePlan& plan) {
    return message_of<WrongInput>([&] { TileStore::join(folder(), plan); });
  };
  EXPECT_EQ(words(plan_of_store()), "no plan in " + folder().string() +
                                        "; all processes need a file system that they share");
  leave_tiles(1);
  EXPECT_NE(words(plan_of_store("60")).find("--duration was 20, is 60"), std::string::npos);
  write_text(folder() / "plan", "holdfast");
  EXPECT_EQ(words(plan_of_store()), "the plan of " + folder().string() + " is damaged");
}

TEST_F(TileStoreTest, TakesTilesFromManyThreads) {
  const TileStore store = TileStore::open(folder(), plan_of_store(), false);
  std::vector<std::thread> threads;
  for (std::int64_t thread = 0; thread < 8; ++thread) {
    threads.emplace_back([&store, thread] {
      // Neighbours have half of their tiles in common.
      for (std::int64_t i = 0; i < 20; ++i) {
        const std::int64_t tile = (10 * thread + i) % 100;
        if (!store.has(tile)) store.put(tile, bytes_of(tile));
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (std::int64_t tile = 0; tile < 90; ++tile) EXPECT_EQ(store.get(tile), bytes_of(tile));
  EXPECT_EQ(names().size(), 92U);
}

TEST_F(TileStoreTest, GoesOnAfterAKilledProcess) {
  const auto work = [&] {
    const TileStore store = TileStore::open(folder(), plan_of_store(), false);
    for (std::int64_t tile = 0; tile < 10; ++tile) store.put(tile, bytes_of(tile));
    write_text(folder() / ".tile-000000000010-1-0.tmp", "hal");
    raise(SIGKILL);
    return 0;
  };
  EXPECT_EQ(exit_code_of_child(work), -SIGKILL);
  const TileStore store = resumed();
  for (std::int64_t tile = 0; tile < 20; ++tile) EXPECT_EQ(store.has(tile), tile < 10);
  EXPECT_EQ(names().size(), 12U);
}

TEST_F(TileStoreTest, RemovesOnlyItsOwnLeftovers) {
  leave_tiles(1);
  for (const char* name : {".plan-1-0.tmp", ".tile-000000000002-77-3.tmp"}) {
    write_text(folder() / name, "half");
  }
  for (const char* name : {".mine-1-0.tmp", "notes", ".tile-2-77-3.tmp"}) {
    write_text(folder() / name, "mine");
  }
  EXPECT_NE(refusal(plan_of_store("60"), true), "");
  EXPECT_EQ(names().size(), 8U);
  resumed();
  EXPECT_EQ(names(), (std::vector<std::string>{".mine-1-0.tmp", ".tile-2-77-3.tmp", "lock", "notes",
                                               "plan", "tile-000000000000"}));
}

TEST_F(TileStoreTest, IsRemovedWhole) {
  leave_tiles(12);
  TileStore store = resumed();
  store.remove();
  EXPECT_EQ(outer().files(), 0);
  EXPECT_FALSE(store.has(0));
  EXPECT_FALSE(TileStore::open(folder(), plan_of_store("60"), false).has(0));
}

TEST_F(TileStoreTest, IsRemovedButForFilesOfOthers) {
  leave_tiles(12);
  write_text(folder() / "notes", "mine");
  resumed().remove();
  EXPECT_EQ(names(), std::vector<std::string>{"notes"});
}

/// 0 where a tile that is too large for the limit is refused in the system's words and leaves no
/// trace.
int put_beyond_limit(const fs::path& folder, std::int64_t tiles) {
  signal(SIGXFSZ, SIG_IGN);
  const TileStore store = TileStore::open(folder, plan_of_store(), false);
  for (std::int64_t tile = 0; tile < tiles; ++tile) store.put(tile, bytes_of(tile));
  const rlimit limit{1000, 1000};
  if (setrlimit(RLIMIT_FSIZE, &limit) != 0) return 1;
  const std::string words = message_of<OutputError>([&] { store.put(50, std::string(2000, 'x')); });
  if (words != "cannot write " + file_of(folder, 50).string() + ": File too large") return 2;
  if (store.has(50)) return 3;
  const auto files = std::distance(fs::directory_iterator(folder), fs::directory_iterator());
  return files == tiles + 2 ? 0 : 4;
}

TEST_F(TileStoreTest, KeepsWhatItHasWhenAWriteFails) {
  for (std::int64_t tiles = 0; tiles < 3; ++tiles) {
    EXPECT_EQ(exit_code_of_child([&] { return put_beyond_limit(folder(), tiles); }), 0);
    fs::remove_all(folder());
  }
}

}  // namespace
}  // namespace holdfast::program
