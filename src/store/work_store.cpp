#include "store/work_store.hpp"

#include <unistd.h>

#include <string>

#include "process/errors.hpp"

namespace holdfast::program {
namespace {

namespace fs = std::filesystem;

void remove_lock_and_store(const StoreFolder& store) {
  const fs::path lock = store.folder() / FolderLock::file_name;
  std::error_code ignored;
  if (fs::is_regular_file(fs::symlink_status(lock, ignored)) && fs::is_empty(lock, ignored))
    unlink(lock.c_str());
  store.remove();
}

StoreFolder entered(const fs::path& folder, const StoreDescription& description, bool resume) {
  const std::optional<StoreDescription> there = store_in(folder);
  if (there) {
    const StoreFolder before = StoreFolder::open(folder);
    const std::int64_t done = before.chunks_done();
    if (done > 0 && !resume)
      throw WrongInput(folder.string() + " holds " + std::to_string(done) +
                       (done == 1 ? " finished chunk" : " finished chunks") +
                       " of an interrupted sweep; go on with --resume, or remove the folder to "
                       "begin anew");
    if (done == 0) remove_left_work_store(folder);
  }
  return StoreFolder::enter(folder, description);
}

}  // namespace

WorkStore::WorkStore(const fs::path& folder, const StoreDescription& description, bool resume)
    : store_(entered(folder, description, resume)), lock_(folder) {}

void WorkStore::remove() { remove_lock_and_store(store_); }

void remove_left_work_store(const fs::path& folder) {
  if (!fs::exists(folder / FolderLock::file_name)) return;
  try {
    if (!store_in(folder)) return;
    const FolderLock held(folder);
    remove_lock_and_store(StoreFolder::open(folder));
  } catch (const Refusal&) {
    // Another program has it, or it cannot be read: it stays.
  }
}

}  // namespace holdfast::program
