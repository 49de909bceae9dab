#include <sched.h>
#include <sys/mount.h>
#include <atomic>
#include <thread>

#include "process/errors.hpp"
#include "program/child_process.hpp"
#include "program/store/small_store.hpp"
#include "store/fill_store.hpp"
#include "support/message_of.hpp"
#include "support/temporary_folder.hpp"

namespace holdfast::program {
namespace {

namespace fs = std::filesystem;
using tests::TemporaryFolder;
using tests::write_text;

/// Counts how often each chunk is computed.
struct CountedWork {
  std::array<std::atomic<int>, 4> computed{};

  ChunkWork work(bool verify = false) {
    const auto compute = [this](std::int64_t chunk) {
      ++computed.at(static_cast<std::size_t>(chunk));
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      return ChunkResult{values_of_small_store(chunk), 1};
    };
    return {"sweep, cells", compute, nullptr, verify};
  }
};

void fill(const StoreFolder& store, const ChunkWork& work, int threads) {
  JobContext context;
  context.quiet = true;
  context.threads = threads;
  fill_store(context, store, work);
}

void expect_complete(const StoreFolder& store) {
  for (std::int64_t chunk = 0; chunk < 4; ++chunk)
    EXPECT_EQ(store.read(chunk), values_of_small_store(chunk));
}

TEST(FillStore, ComputesWhatIsMissingOnce) {
  for (const int threads : {1, 3}) {
    const TemporaryFolder folder;
    const StoreFolder store = StoreFolder::enter(folder / "x.zarr", small_store());
    store.put(2, values_of_small_store(2));
    CountedWork counted;
    fill(store, counted.work(), threads);
    expect_complete(store);
    for (std::size_t chunk = 0; chunk < 4; ++chunk)
      EXPECT_EQ(counted.computed.at(chunk), chunk == 2 ? 0 : 1);
  }
}

TEST(FillStore, TwoThatKnowNothingOfEachOtherShareTheWork) {
  const TemporaryFolder folder;
  const StoreFolder store = StoreFolder::enter(folder / "x.zarr", small_store());
  CountedWork counted;
  std::thread other([&] { fill(store, counted.work(), 1); });
  fill(store, counted.work(), 1);
  expect_complete(store);  // also while the other may still be at its end
  other.join();
  for (const auto& times : counted.computed) EXPECT_EQ(times, 1);
}

TEST(FillStore, TakesOverWhatAProcessThatIsGoneHasClaimed) {
  const TemporaryFolder folder;
  const StoreFolder store = StoreFolder::enter(folder / "x.zarr", small_store());
  const fs::path place = store.file_of(1).parent_path();
  write_text(place / ".c.1.0.claim", "");
  write_text(place / ".c.1.0-4711-3.tmp", "half a chu");
  CountedWork counted;
  fill(store, counted.work(), 1);
  expect_complete(store);
  EXPECT_FALSE(fs::exists(place / ".c.1.0.claim"));
  EXPECT_FALSE(fs::exists(place / ".c.1.0-4711-3.tmp"));
}

TEST(FillStore, VerifyingItComputesDamagedChunksAnew) {
  const TemporaryFolder folder;
  const StoreFolder store = StoreFolder::enter(folder / "x.zarr", small_store());
  CountedWork counted;
  fill(store, counted.work(), 2);
  write_text(store.file_of(3), "damaged");
  fill(store, counted.work(), 2);
  EXPECT_FALSE(store.read(3));
  fill(store, counted.work(true), 2);
  expect_complete(store);
  EXPECT_EQ(counted.computed.at(3), 2);
  EXPECT_EQ(counted.computed.at(0), 1);
}

TEST(FillStore, AFaultOfOneChunkLeavesTheOthers) {
  const TemporaryFolder folder;
  const StoreFolder store = StoreFolder::enter(folder / "x.zarr", small_store());
  const auto compute = [](std::int64_t chunk) {
    if (chunk == 2) throw NoAnswer("no such motion");
    return ChunkResult{values_of_small_store(chunk)};
  };
  EXPECT_THROW(fill(store, {"sweep, cells", compute}, 1), NoAnswer);
  EXPECT_EQ(store.chunks_done(), 2);
  EXPECT_FALSE(ChunkClaim::exists(store.file_of(2)));
}

using tests::exit_code_of_child;
using tests::message_of;

constexpr int no_small_disk = 77;

/// A disk of that many bytes on the folder, seen by this process alone. Not every user may have it.
bool mount_small_disk(const std::filesystem::path& folder, const char* size) {
  if (unshare(CLONE_NEWNS) != 0 && unshare(CLONE_NEWUSER | CLONE_NEWNS) != 0) return false;
  if (mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0) return false;
  return mount("tmpfs", folder.c_str(), "tmpfs", 0, size) == 0;
}

/// The small store's first column over a thousand rows, a chunk a row of bytes that do not repeat.
int fill_small_disk(const std::filesystem::path& disk) {
  if (!mount_small_disk(disk, "size=128k")) return no_small_disk;
  const StoreFolder store = StoreFolder::enter(disk / "x.zarr", small_store());
  std::filesystem::path filling;
  for (int k = 0; k < 100; ++k) {
    filling = disk / ("filling" + std::to_string(k));
    tests::write_text(filling, std::string(4096, 'x'));
    if (std::filesystem::file_size(filling) < 4096) break;
  }
  const std::string words =
      message_of<OutputError>([&] { store.put(0, values_of_small_store(0)); });
  const std::array<const char*, 3> columns = {"steady_peak", "period_samples", "kind"};
  const auto is_named = [&](const char* name) { return words.find(name) != std::string::npos; };
  if (std::none_of(columns.begin(), columns.end(), is_named)) return 1;
  if (words.find(": No space left on device") == std::string::npos) return 2;
  if (store.has(0)) return 3;
  for (int k = 0; k < 4; ++k) std::filesystem::remove(disk / ("filling" + std::to_string(k)));
  store.put(0, values_of_small_store(0));  // goes on once there is room
  return store.read(0) == values_of_small_store(0) ? 0 : 4;
}

TEST(StoreOnFullDisk, SaysWhichChunkAndGoesOnOnceThereIsRoom) {
  const TemporaryFolder disk;
  const int code = exit_code_of_child([&] { return fill_small_disk(disk.path()); });
  if (code == no_small_disk) GTEST_SKIP() << "this user may mount no disk";
  EXPECT_EQ(code, 0);
}

}  // namespace
}  // namespace holdfast::program
