#include "io/file/folder_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <cerrno>
#include <string>

#include "process/errors.hpp"
#include "process/system_words.hpp"

namespace holdfast::program {
namespace {

namespace fs = std::filesystem;

/// Gives 0 or the system's error number.
int lock(int descriptor) {
  int status = 0;
  do {
    status = flock(descriptor, LOCK_EX | LOCK_NB);
  } while (status != 0 && errno == EINTR);
  return status == 0 ? 0 : errno;
}

bool means_no_locks_here(int error) {
  return error == ENOLCK || error == EOPNOTSUPP || error == ENOSYS;
}

/// Whether the open file is still the one of that name: its last holder may have removed it.
bool is_still_there(int descriptor, const fs::path& file) {
  struct stat opened {};
  struct stat named {};
  return fstat(descriptor, &opened) == 0 && stat(file.c_str(), &named) == 0 &&
         opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

}  // namespace

FolderLock::FolderLock(const fs::path& folder) {
  constexpr mode_t everyone_may_read_and_write = 0666;  // less the user's umask
  const fs::path file = folder / file_name;
  while (!descriptor_.is_open()) {
    // Network file systems lock only what is open for writing.
    Descriptor opened(
        open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, everyone_may_read_and_write));
    if (!opened.is_open()) refuse_to_write(file, errno);
    const int error = lock(opened.number());
    if (error == EWOULDBLOCK) throw OutputError(folder.string() + " is in use by another program");
    if (error != 0 && !means_no_locks_here(error)) refuse_to_write(file, error);
    if (is_still_there(opened.number(), file)) descriptor_ = std::move(opened);
  }
}

}  // namespace holdfast::program
