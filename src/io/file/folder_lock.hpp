#pragma once

#include <filesystem>

#include "io/file/descriptor.hpp"

namespace holdfast::program {

/// Keeps every other program of this machine from a folder while the object lives, by an advisory
/// lock on its file `lock`. The system lets go of the lock when the process ends, however it ends.
/// On a file system without locks it keeps nobody away.
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
