#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/file/descriptor.hpp"

namespace holdfast::program {

/// A folder that the effective user owns, opened as itself and not by a link. What is removed is
/// removed from it, wherever its name may lead meanwhile; only files are, no links, no devices, and
/// folders only where they are empty.
class OwnFolder {
 public:
  /// Not open where there is no such folder, where it is a link, and where another user owns it.
  explicit OwnFolder(const std::filesystem::path& folder);
  /// The folder of that name in another.
  OwnFolder(const OwnFolder& parent, const std::string& name);

  bool is_open() const { return descriptor_.is_open(); }
  std::vector<std::string> names() const;

  /// Whether the file was given the other name, in the same folder.
  bool rename(const std::string& name, const std::string& to) const;
  void remove_file(const std::string& name, bool empty_alone = false) const;
  void remove_empty_folder(const std::string& name) const;

 private:
  explicit OwnFolder(int opened);
  Descriptor descriptor_;
};

/// Makes a folder of that beginning in the temporary folder, of a name that nobody can foresee and
/// into which no other user sees. Throws OutputError.
std::filesystem::path new_passing_folder(const std::string& beginning);

/// The folders there whose names begin so.
std::vector<std::filesystem::path> passing_folders(const std::string& beginning);

}  // namespace holdfast::program
