#include <sched.h>
#include <sys/mount.h>

#include "process/errors.hpp"
#include "program/child_process.hpp"
#include "program/store/small_store.hpp"
#include "support/message_of.hpp"
#include "support/temporary_folder.hpp"
#include "support/testing.hpp"

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
