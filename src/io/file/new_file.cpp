#include "io/file/new_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>

#include <cerrno>

namespace holdfast::program {

int open_new_file(const std::function<std::filesystem::path()>& next_name,
                  std::filesystem::path& file) {
  constexpr int most_attempts = 100;
  constexpr mode_t everyone_may_read_and_write = 0666;  // less the user's umask
  for (int attempt = 0; attempt < most_attempts; ++attempt) {
    file = next_name();
    const int descriptor =
        open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, everyone_may_read_and_write);
    if (descriptor >= 0 || errno != EEXIST) return descriptor;
  }
  return -1;
}

}  // namespace holdfast::program
