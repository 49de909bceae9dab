#include <sched.h>
#include <sys/mount.h>

#include "process/errors.hpp"
#include "program/child_process.hpp"
#include "support/message_of.hpp"
#include "support/temporary_folder.hpp"
#include "support/testing.hpp"
#include "sweep/tiles/tile_store.hpp"

namespace holdfast::program {
namespace {

using tests::exit_code_of_child;
using tests::message_of;
using tests::TemporaryFolder;

constexpr int no_small_disk = 77;

/// A disk of that many bytes on the folder, seen by this process alone. Not every user may have it.
bool mount_small_disk(const std::filesystem::path& folder, const char* size) {
  if (unshare(CLONE_NEWNS) != 0 && unshare(CLONE_NEWUSER | CLONE_NEWNS) != 0) return false;
  if (mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0) return false;
  return mount("tmpfs", folder.c_str(), "tmpfs", 0, size) == 0;
}

int fill_small_disk(const std::filesystem::path& disk) {
  if (!mount_small_disk(disk, "size=64k")) return no_small_disk;
  const TilePlan plan{{{"version", "0.6.0"}}, 100};
  const std::string tile(10000, 'x');
  const TileStore store = TileStore::open(disk / "tiles", plan, false);
  std::int64_t kept = 0;
  const std::string words = message_of<OutputError>([&] {
    for (; kept < plan.tiles; ++kept) store.put(kept, tile);
  });
  if (kept < 2 || words.find(": No space left on device") == std::string::npos) return 1;
  for (std::int64_t i = 0; i < kept; ++i) {
    if (store.get(i) != tile) return 2;
  }
  if (store.has(kept)) return 3;
  std::filesystem::remove(disk / "tiles" / "tile-000000000000");
  store.put(kept, tile);  // goes on once there is room
  return 0;
}

/// A folder cannot be begun on a disk without room for its plan.
int begin_on_full_disk(const std::filesystem::path& disk) {
  if (!mount_small_disk(disk, "size=8k")) return no_small_disk;
  tests::write_text(disk / "filling", std::string(8192, 'x'));
  const TilePlan plan{{{"version", "0.6.0"}}, 100};
  const std::string words =
      message_of<OutputError>([&] { TileStore::open(disk / "tiles", plan, false); });
  const std::string file = (disk / "tiles" / "plan").string();
  return words == "cannot write " + file + ": No space left on device" ? 0 : 1;
}

TEST(TileStoreOnFullDisk, KeepsWhatItHasAndSaysSo) {
  const TemporaryFolder disk;
  const int code = exit_code_of_child([&] { return fill_small_disk(disk.path()); });
  if (code == no_small_disk) GTEST_SKIP() << "this user may mount no disk";
  EXPECT_EQ(code, 0);
}

TEST(TileStoreOnFullDisk, CannotBeBegun) {
  const TemporaryFolder disk;
  const int code = exit_code_of_child([&] { return begin_on_full_disk(disk.path()); });
  if (code == no_small_disk) GTEST_SKIP() << "this user may mount no disk";
  EXPECT_EQ(code, 0);
}

}  // namespace
}  // namespace holdfast::program
