#include "store/work_store.hpp"

#include "process/errors.hpp"

namespace holdfast::program {
namespace {

namespace fs = std::filesystem;

StoreFolder entered(const fs::path& folder, const StoreDescription& description, bool resume) {
  if (const std::optional<std::int64_t> done = StoreFolder::chunks_done_in(folder)) {
    if (*done > 0 && !resume)
      throw WrongInput(folder.string() + " holds " + std::to_string(*done) +
                       (*done == 1 ? " finished chunk" : " finished chunks") +
                       " of an interrupted sweep; give --resume to continue, or remove the folder "
                       "to begin anew");
    if (*done == 0) remove_left_work_store(folder);
  }
  return StoreFolder::enter(folder, description);
}

}  // namespace

WorkStore::WorkStore(const fs::path& folder, const StoreDescription& description, bool resume)
    : store_(entered(folder, description, resume)), lock_(folder) {}

void WorkStore::remove() { store_.remove(); }

void remove_left_work_store(const fs::path& folder) {
  // Checked first: nothing is opened in the folder of another user.
  const OwnFolder own(folder);
  std::error_code error;
  if (!own.is_open() || !fs::exists(folder / FolderLock::file_name, error)) return;
  try {
    const FolderLock held(folder);
    remove_store(folder);
  } catch (const Refusal&) {
    // The store remains: another program uses it, or it cannot be read.
  }
}

}  // namespace holdfast::program
