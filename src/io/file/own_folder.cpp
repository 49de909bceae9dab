#include "io/file/own_folder.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <memory>
#include <string_view>

#include "process/errors.hpp"

namespace holdfast::program {
namespace {

constexpr int as_itself = O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC;

/// Status of an entry, links not followed; all zero, the type of no file, if it does not exist.
struct stat status_of(const Descriptor& folder, const std::string& name) {
  struct stat status {};
  if (fstatat(folder.number(), name.c_str(), &status, AT_SYMLINK_NOFOLLOW) != 0) status = {};
  return status;
}

}  // namespace

OwnFolder::OwnFolder(int opened) : descriptor_(opened) {
  struct stat status {};
  const bool is_ours = descriptor_.is_open() && fstat(descriptor_.number(), &status) == 0 &&
                       status.st_uid == geteuid();
  if (!is_ours) descriptor_ = Descriptor();
}

OwnFolder::OwnFolder(const std::filesystem::path& folder)
    : OwnFolder(open(folder.c_str(), as_itself)) {}

OwnFolder::OwnFolder(const OwnFolder& parent, const std::string& name)
    : OwnFolder(openat(parent.descriptor_.number(), name.c_str(), as_itself)) {}

std::vector<std::string> OwnFolder::names() const {
  // Reading the entries moves a descriptor's position, hence a second descriptor of the folder.
  Descriptor again(openat(descriptor_.number(), ".", as_itself));
  const std::unique_ptr<DIR, int (*)(DIR*)> entries(fdopendir(again.number()), &closedir);
  if (!entries) return {};
  again.release();
  std::vector<std::string> names;
  while (const dirent* entry = readdir(entries.get())) {
    const std::string_view name = entry->d_name;
    if (name != "." && name != "..") names.emplace_back(name);
  }
  return names;
}

bool OwnFolder::rename(const std::string& name, const std::string& to) const {
  return S_ISREG(status_of(descriptor_, name).st_mode) &&
         renameat(descriptor_.number(), name.c_str(), descriptor_.number(), to.c_str()) == 0;
}

void OwnFolder::remove_file(const std::string& name, bool empty_alone) const {
  const struct stat status = status_of(descriptor_, name);
  if (S_ISREG(status.st_mode) && (!empty_alone || status.st_size == 0))
    unlinkat(descriptor_.number(), name.c_str(), 0);
}

void OwnFolder::remove_empty_folder(const std::string& name) const {
  unlinkat(descriptor_.number(), name.c_str(), AT_REMOVEDIR);
}

std::filesystem::path new_passing_folder(const std::string& beginning) {
  std::string name = (std::filesystem::temp_directory_path() / beginning).string() + "XXXXXX";
  if (mkdtemp(name.data()) == nullptr)
    throw OutputError("cannot create the folder " + name + ": " + system_words(errno));
  return name;
}

std::vector<std::filesystem::path> passing_folders(const std::string& beginning) {
  namespace fs = std::filesystem;
  std::vector<fs::path> folders;
  std::error_code error;
  fs::directory_iterator entry(fs::temp_directory_path(error), error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error))
    if (entry->path().filename().string().rfind(beginning, 0) == 0)
      folders.push_back(entry->path());
  return folders;
}

}  // namespace holdfast::program
