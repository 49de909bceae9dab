#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/file/descriptor.hpp"

namespace holdfast::program {

/// A folder owned by the effective user, opened directly and not through a symbolic link. Entries
/// are removed from the opened folder, even if its path now names another folder. Only regular
/// files and empty folders are removed, no links and no devices.
class OwnFolder {
 public:
  /// Opens a folder; is_open() is false if it does not exist, is a link or belongs to another user.
  explicit OwnFolder(const std::filesystem::path& folder);
  /// Opens the folder `name` inside `parent`; is_open() is false under the same conditions.
  OwnFolder(const OwnFolder& parent, const std::string& name);

  bool is_open() const { return descriptor_.is_open(); }
  std::vector<std::string> names() const;

  /// Renames a regular file within the folder; true if this succeeded.
  bool rename(const std::string& name, const std::string& to) const;
  void remove_file(const std::string& name, bool empty_alone = false) const;
  void remove_empty_folder(const std::string& name) const;

 private:
  explicit OwnFolder(int opened);
  Descriptor descriptor_;
};

/// Creates a folder in the temporary folder, readable by this user only, with an unpredictable name
/// that starts with `beginning`. Returns its path. Throws OutputError.
std::filesystem::path new_passing_folder(const std::string& beginning);

/// Paths in the temporary folder whose names start with `beginning`.
std::vector<std::filesystem::path> passing_folders(const std::string& beginning);

}  // namespace holdfast::program
