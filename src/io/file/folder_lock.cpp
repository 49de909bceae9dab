#include "io/file/folder_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <cerrno>

#include "process/errors.hpp"

namespace holdfast::program {

namespace fs = std::filesystem;

int lock_file(int descriptor) {
  int status = 0;
  do {
    status = flock(descriptor, LOCK_EX | LOCK_NB);
  } while (status != 0 && errno == EINTR);
  return status == 0 ? 0 : errno;
}

bool has_name(int descriptor, const fs::path& name) {
  struct stat opened {};
  struct stat named {};
  return fstat(descriptor, &opened) == 0 && lstat(name.c_str(), &named) == 0 &&
         opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

FolderLock::FolderLock(const fs::path& folder) {
  constexpr mode_t everyone_may_read_and_write = 0666;  // less the user's umask
  const fs::path file = folder / file_name;
  while (!descriptor_.is_open()) {
    // Network file systems lock only files that are open for writing.
    Descriptor opened(
        open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, everyone_may_read_and_write));
    if (!opened.is_open() && errno == ELOOP)
      throw WrongInput("cannot write " + file.string() +
                       ": it is a symbolic link, which holdfast does not follow; remove the link");
    if (!opened.is_open()) refuse_to_write(file, errno);
    const int error = lock_file(opened.number());
    if (error == EWOULDBLOCK)
      throw OutputError(folder.string() +
                        " is in use by another program; wait until that program ends");
    const bool has_locks = error != ENOLCK && error != EOPNOTSUPP && error != ENOSYS;
    if (error != 0 && has_locks) refuse_to_write(file, error);
    // The program that had the lock before may have removed the file.
    if (has_name(opened.number(), file)) descriptor_ = std::move(opened);
  }
}

}  // namespace holdfast::program
