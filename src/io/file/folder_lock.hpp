#pragma once

#include <filesystem>

#include "io/file/descriptor.hpp"

namespace holdfast::program {

/// Takes the advisory lock of an open file, which the system lets go of with the file, however its
/// process ends. Gives 0 or the system's error number: EWOULDBLOCK where another program holds it.
int lock_file(int descriptor);

/// Whether the open file still has that name, itself and not by a link.
bool has_name(int descriptor, const std::filesystem::path& name);

/// Keeps every other program of this machine from a folder while the object lives, by an advisory
/// lock on its file `lock`, no link to one. The system lets go of the lock when the process ends,
/// however it ends. On a file system without locks it keeps nobody away.
class FolderLock {
 public:
  /// The name of the file, which stays when the object goes.
  static constexpr const char* file_name = "lock";

  /// Throws OutputError where another program holds the folder; what refuse_to_write() throws where
  /// the file cannot be made.
  explicit FolderLock(const std::filesystem::path& folder);

 private:
  Descriptor descriptor_;
};

}  // namespace holdfast::program
