#include "io/file/output.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <string>

#include "io/file/folder_lock.hpp"
#include "io/file/whole_file.hpp"
#include "process/errors.hpp"
#include "process/progress.hpp"
#include "text/checksum.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse_path(const fs::path& shown, const std::string& why) {
  throw WrongInput("cannot write " + shown.string() + ": " + why);
}

[[noreturn]] void refuse_to_open(const fs::path& shown, int error) {
  if (error == EINTR) throw_if_interrupted();  // here a pipe waits for its reader
  refuse_to_write(shown, error);
}

/// The path with all symbolic links followed, dangling links too.
fs::path follow_links(fs::path path) {
  constexpr int most_links = 40;
  std::error_code error;
  for (int i = 0; i < most_links && fs::is_symlink(fs::symlink_status(path, error)); ++i) {
    const fs::path next = fs::read_symlink(path, error);
    if (error) break;
    path = next.is_absolute() ? next : path.parent_path() / next;
  }
  return path;
}

/// The temporary name, with a number, of a target. The target's own name may be as long as the
/// system admits, so its checksum is used.
fs::path temporary_for(const fs::path& target, unsigned number) {
  constexpr std::size_t digits = 16;
  return target.parent_path() /
         (".holdfast-" + hexadecimal(checksum(target.filename().string()), digits) + "-" +
          std::to_string(number) + ".tmp");
}

/// Removes a temporary file whose lock is free, since no process writes it any more; true if
/// removed. Files of other users, and files on a file system without locks, remain.
bool remove_left(const fs::path& temporary) {
  struct stat status {};
  const Descriptor left(open(temporary.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  const bool ours = left.is_open() && fstat(left.number(), &status) == 0 &&
                    S_ISREG(status.st_mode) && status.st_uid == geteuid();
  return ours && lock_file(left.number()) == 0 && has_name(left.number(), temporary) &&
         unlink(temporary.c_str()) == 0;
}

/// Opens and locks a new temporary file beside the target, and removes those left by killed runs.
/// The lock shows other runs that the file is in use. On failure no file is open and errno is set.
Descriptor open_temporary(const fs::path& target, fs::path& file) {
  constexpr unsigned most = 1000;
  unsigned number = 0;
  Descriptor opened;
  while (!opened.is_open() && number < most) {
    file = temporary_for(target, number++);
    remove_left(file);
    opened = Descriptor(open_new_file(file));
    if (!opened.is_open() && errno != EEXIST) return opened;
    // Another run may have taken the file before it was locked.
    const bool lost = opened.is_open() && (lock_file(opened.number()) == EWOULDBLOCK ||
                                           !has_name(opened.number(), file));
    if (lost) opened = Descriptor();
  }
  while (remove_left(temporary_for(target, number))) ++number;
  return opened;
}

}  // namespace

bool is_netcdf_name(const std::optional<fs::path>& path) {
  constexpr std::string_view ending = ".nc";
  const std::string name = path ? path->filename().string() : std::string();
  return name.size() >= ending.size() &&
         name.compare(name.size() - ending.size(), ending.size(), ending) == 0;
}

bool is_store_name(const std::optional<fs::path>& path) {
  return path && (path->has_filename() ? *path : path->parent_path()).extension() == ".zarr";
}

bool is_picture_name(const fs::path& path) {
  const std::string ending = path.extension().string();
  return ending == ".svg" || ending == ".png" || ending == ".pdf";
}

void require_output_name(const fs::path& path, bool drawn) {
  const std::string ending = path.extension().string();
  if (ending.empty() || ending == ".csv" || is_netcdf_name(path) || is_store_name(path)) return;
  if (drawn && is_picture_name(path)) return;
  throw WrongInput("--output " + path.string() +
                   ": tables are written as .csv, charts and sweeps also as .nc or .zarr, and " +
                   (drawn ? "the picture as .svg, .png or .pdf" : "this job has no picture") +
                   "; give one of these endings, not " + ending);
}

OutputFile::OutputFile(const std::optional<fs::path>& path) {
  if (!path || *path == "-") {
    shown_ = "standard output";
    return;
  }
  if (path->empty()) throw WrongInput("cannot write to a file without a name: give a name");
  shown_ = *path;
  struct stat status {};
  const bool exists = stat(path->c_str(), &status) == 0;
  if (!exists && errno != ENOENT) refuse_to_open(shown_, errno);
  if ((exists && S_ISDIR(status.st_mode)) || !path->has_filename())
    refuse_path(shown_, "is a folder");
  if (exists && access(path->c_str(), W_OK) != 0) refuse_path(shown_, system_words(errno));
  if (exists && !S_ISREG(status.st_mode)) {
    target_ = shown_;
    file_ = Descriptor(open(target_.c_str(), O_WRONLY | O_CLOEXEC));
  } else {
    target_ = follow_links(*path);
    fs::path opened;
    file_ = open_temporary(target_, opened);
    if (file_.is_open()) temporary_ = opened;
  }
  if (!file_.is_open()) refuse_to_open(shown_, errno);
  // Absolute, since the signal handler does not know of a change of the working folder.
  if (is_file()) guard_ = std::make_unique<RemovedBySignal>(fs::absolute(temporary_).c_str());
}

OutputFile::~OutputFile() {
  if (is_file() && !committed_) unlink(temporary_.c_str());
}

void OutputFile::fail(int error) const {
  throw OutputError("cannot write " + shown_.string() + ": " + system_words(error));
}

void OutputFile::write(std::string_view bytes) {
  const int descriptor = file_.is_open() ? file_.number() : STDOUT_FILENO;
  if (!file_.is_open()) yield_terminal_to_result();
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written >= 0) {
      const auto taken = bytes.substr(0, static_cast<std::size_t>(written));
      if (is_file()) written_ = {written_.bytes + taken.size(), checksum(taken, written_.checksum)};
      bytes.remove_prefix(static_cast<std::size_t>(written));
      continue;
    }
    if (errno == EPIPE)
      throw OutputError("cannot write all of " + shown_.string() + ": it was closed by its reader");
    if (errno != EINTR) fail(errno);
    throw_if_interrupted();
  }
}

void OutputFile::finish() {
  if (!file_.is_open()) return;
  if (is_file()) lock_ = Descriptor(fcntl(file_.number(), F_DUPFD_CLOEXEC, 0));
  // Some file systems report a full disk only here.
  if (close(file_.release()) != 0 && errno != EINTR) fail(errno);
}

void OutputFile::appear() {
  if (is_file() && rename(temporary_.c_str(), target_.c_str()) != 0) fail(errno);
  committed_ = true;
  guard_.reset();
  lock_ = Descriptor();
}

void OutputFile::commit() {
  throw_if_interrupted();
  finish();
  appear();
}

void commit_together(OutputFile& file, OutputFile& companion) {
  file.finish();
  companion.finish();
  const SignalsHeld held;
  throw_if_interrupted();
  const fs::path& before = companion.target();
  if (unlink(before.c_str()) != 0 && errno != ENOENT) companion.fail(errno);
  file.appear();
  try {
    companion.appear();
  } catch (...) {  // a table without metadata would not say how it was made
    unlink(file.target().c_str());
    throw;
  }
}

}  // namespace holdfast::program
