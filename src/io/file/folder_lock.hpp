#pragma once

#include <filesystem>

#include "io/file/descriptor.hpp"

namespace holdfast::program {

/// Takes an open file's advisory lock without waiting. The system releases it with the file, even
/// if the process is killed. Returns 0, EWOULDBLOCK if another program has it, or another error.
int lock_file(int descriptor);

/// Whether `name` still is the name of the open file itself, not of a link to it.
bool has_name(int descriptor, const std::filesystem::path& name);

/// Advisory lock of a folder against all other programs of this machine, while the object exists.
/// The locked file is `lock` in the folder, which must not be a link. The system releases the lock
/// when the process ends. Without effect on a file system without locks.
class FolderLock {
 public:
  /// Name of the locked file, which remains after the lock is released.
  static constexpr const char* file_name = "lock";

  /// Throws OutputError if another program has locked the folder, and the exceptions of
  /// refuse_to_write() if the lock file cannot be created.
  explicit FolderLock(const std::filesystem::path& folder);

 private:
  Descriptor descriptor_;
};

}  // namespace holdfast::program
