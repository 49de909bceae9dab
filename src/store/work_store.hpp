#pragma once

#include <filesystem>

#include "io/file/folder_lock.hpp"
#include "store/store_folder.hpp"

namespace holdfast::program {

/// A temporary store, from which a table or a netCDF file is made once it is complete; it is then
/// removed. Only one program at a time uses it, or several processes that one launcher started.
class WorkStore {
 public:
  /// Creates the store, or continues an existing one; an existing one without chunks starts anew.
  ///
  /// Throws WrongInput if it has chunks and `resume` is false (the message names --resume);
  /// OutputError if another program uses it; and the exceptions of StoreFolder::enter().
  WorkStore(const std::filesystem::path& folder, const StoreDescription& description, bool resume);

  const StoreFolder& store() const { return store_; }

  /// Removes the store; call when it is no longer needed.
  void remove();

 private:
  StoreFolder store_;
  FolderLock lock_;
};

/// Removes a work store that an ended program has left in a folder; any other content remains.
void remove_left_work_store(const std::filesystem::path& folder);

}  // namespace holdfast::program
