#pragma once

#include <filesystem>

#include "io/file/folder_lock.hpp"
#include "store/store_folder.hpp"

namespace holdfast::program {

/// A store of which a table or a netCDF file is made once it is complete, and which then goes. One
/// program has it at a time, with whatever its launcher started beside it.
class WorkStore {
 public:
  /// Makes the store, or goes on with the one that is there; one without chunks is begun again.
  ///
  /// Throws WrongInput where chunks are there and `resume` is false (saying that --resume goes on
  /// with them); OutputError where another program has it; and what StoreFolder::enter() throws.
  WorkStore(const std::filesystem::path& folder, const StoreDescription& description, bool resume);

  const StoreFolder& store() const { return store_; }

  /// Removes it; call once it is not needed any more.
  void remove();

 private:
  StoreFolder store_;
  FolderLock lock_;
};

/// Removes what is left in a folder of a work store whose program is gone; anything else stays.
void remove_left_work_store(const std::filesystem::path& folder);

}  // namespace holdfast::program
