#include "io/file/whole_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <system_error>
#include <vector>

#include "io/file/descriptor.hpp"
#include "process/errors.hpp"
#include "process/interrupt.hpp"

namespace holdfast::program {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view ending = ".tmp";

fs::path temporary_beside(const fs::path& file) {
  static std::atomic<unsigned> count{0};
  return file.parent_path() / ("." + file.filename().string() + "-" + std::to_string(getpid()) +
                               "-" + std::to_string(count.fetch_add(1)) + std::string(ending));
}

bool is_number(std::string_view text) {
  const auto is_digit = [](char character) { return character >= '0' && character <= '9'; };
  return !text.empty() && std::all_of(text.begin(), text.end(), is_digit);
}

/// Writes all bytes, continuing after a signal; jobs check for signals between their pieces of
/// work. Returns 0 or the system's error number.
int write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno != EINTR) return errno;
    if (written > 0) bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

/// Flushes a file to the disk; returns 0, also if its file system cannot, or an error number.
int synchronise(int descriptor) {
  int status = 0;
  do {
    status = fsync(descriptor);
  } while (status != 0 && errno == EINTR);
  return status == 0 || errno == EINVAL || errno == ENOSYS ? 0 : errno;
}

/// Reads at most `text.size()` bytes and shortens `text` to the bytes read; 0 or an error number.
int read_all(int descriptor, std::string& text) {
  std::size_t filled = 0;
  while (filled < text.size()) {
    const ssize_t count = ::read(descriptor, text.data() + filled, text.size() - filled);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return errno;
    if (count == 0) break;
    filled += static_cast<std::size_t>(count);
  }
  text.resize(filled);
  return 0;
}

/// Reads an open regular file completely; returns 0 or the system's error number.
int read_regular(int descriptor, std::string& text) {
  struct stat status {};
  if (fstat(descriptor, &status) != 0) return errno;
  if (S_ISDIR(status.st_mode)) return EISDIR;
  if (!S_ISREG(status.st_mode)) return EINVAL;
  text.resize(static_cast<std::size_t>(status.st_size));
  return read_all(descriptor, text);
}

/// Opens a file for reading. Opening a pipe waits for its writer, until a signal arrives.
Descriptor open_to_read(const fs::path& file) {
  for (;;) {
    Descriptor opened(open(file.c_str(), O_RDONLY | O_CLOEXEC));
    if (opened.is_open()) return opened;
    if (errno != EINTR) refuse_to_read(file, system_words(errno));
    throw_if_interrupted();
  }
}

}  // namespace

int open_new_file(const fs::path& file) {
  constexpr mode_t everyone_may_read_and_write = 0666;  // less the user's umask
  return open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, everyone_may_read_and_write);
}

int write_whole_file(const fs::path& file, std::string_view bytes) {
  fs::path temporary;
  int descriptor = -1;
  do {  // a killed process with this process number may have left one
    temporary = temporary_beside(file);
    descriptor = open_new_file(temporary);
  } while (descriptor < 0 && errno == EEXIST);
  if (descriptor < 0) return errno;
  int error = write_all(descriptor, bytes);
  // Flushed before it is renamed: a finished file must survive a loss of power.
  if (error == 0) error = synchronise(descriptor);
  // Some file systems report a full disk only here.
  if (close(descriptor) != 0 && errno != EINTR && error == 0) error = errno;
  if (error == 0 && rename(temporary.c_str(), file.c_str()) != 0) error = errno;
  if (error != 0) unlink(temporary.c_str());
  return error;
}

std::optional<std::string> name_behind_temporary(std::string_view name) {
  const bool framed = name.size() > ending.size() && name.front() == '.' &&
                      name.substr(name.size() - ending.size()) == ending;
  if (!framed) return std::nullopt;
  name = name.substr(1, name.size() - 1 - ending.size());
  for (int number = 0; number < 2; ++number) {
    const std::size_t dash = name.rfind('-');
    if (dash == std::string_view::npos || !is_number(name.substr(dash + 1))) return std::nullopt;
    name = name.substr(0, dash);
  }
  if (name.empty()) return std::nullopt;
  return std::string(name);
}

std::optional<std::string> read_whole_file(const fs::path& file, int& error) {
  // O_NONBLOCK: opening a pipe does not wait for its writer.
  const Descriptor descriptor(open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  std::string text;
  error = descriptor.is_open() ? read_regular(descriptor.number(), text) : errno;
  if (error != 0) return std::nullopt;
  return text;
}

std::string read_input(const fs::path& file) {
  constexpr std::size_t largest = std::size_t{1} << 31;  // ends the reading of an endless device
  const Descriptor opened = open_to_read(file);
  std::string text;
  std::vector<char> chunk(std::size_t{1} << 16);
  for (;;) {
    const ssize_t count = ::read(opened.number(), chunk.data(), chunk.size());
    if (count == 0) return text;
    if (count < 0 && errno != EINTR) refuse_to_read(file, system_words(errno));
    throw_if_interrupted();
    if (count > 0) text.append(chunk.data(), static_cast<std::size_t>(count));
    if (text.size() > largest) refuse_to_read(file, "too large");
  }
}

void require_not_overwritten(const std::filesystem::path& input,
                             const std::optional<std::filesystem::path>& output) {
  std::error_code ignored;
  const bool same = output && *output != "-" &&
                    std::filesystem::is_regular_file(*output, ignored) &&
                    std::filesystem::equivalent(input, *output, ignored);
  if (same)
    throw WrongInput("--output " + output->string() +
                     ": the job reads this file and would overwrite it; give another name");
}

}  // namespace holdfast::program
