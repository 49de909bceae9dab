#include "io/file/output.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <string>

#include "io/file/whole_file.hpp"
#include "process/errors.hpp"
#include "process/system_words.hpp"

namespace holdfast::program {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse_path(const fs::path& shown, const std::string& why) {
  throw WrongInput("cannot write " + shown.string() + ": " + why);
}

[[noreturn]] void refuse_to_open(const fs::path& shown, int error) {
  if (error == EINTR) throw_if_interrupted();  // a pipe waits for its reader here
  refuse_to_write(shown, error);
}

/// Where a file of that name would lie once every symbolic link is followed, dangling ones too.
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

std::string unique_name() {
  static std::atomic<unsigned> count{0};
  return ".holdfast-" + std::to_string(getpid()) + "-" + std::to_string(count.fetch_add(1)) +
         ".tmp";
}

}  // namespace

bool is_netcdf_name(const std::optional<fs::path>& path) {
  constexpr std::string_view ending = ".nc";
  const std::string name = path ? path->filename().string() : std::string();
  return name.size() >= ending.size() &&
         name.compare(name.size() - ending.size(), ending.size(), ending) == 0;
}

OutputFile::OutputFile(const std::optional<fs::path>& path) {
  if (!path || *path == "-") {
    shown_ = "standard output";
    descriptor_ = STDOUT_FILENO;
    return;
  }
  if (path->empty()) throw WrongInput("cannot write to a file without a name");
  shown_ = *path;
  struct stat status {};
  const bool exists = stat(path->c_str(), &status) == 0;
  if (!exists && errno != ENOENT) refuse_to_open(shown_, errno);
  if ((exists && S_ISDIR(status.st_mode)) || !path->has_filename())
    refuse_path(shown_, "is a folder");
  if (exists && access(path->c_str(), W_OK) != 0) refuse_path(shown_, system_words(errno));
  if (exists && !S_ISREG(status.st_mode)) {
    open_device();
  } else {
    target_ = follow_links(*path);
    open_temporary();
  }
}

OutputFile::~OutputFile() { discard(); }

void OutputFile::open_device() {
  target_ = shown_;
  descriptor_ = open(target_.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor_ < 0) refuse_to_open(shown_, errno);
  owns_descriptor_ = true;
}

void OutputFile::open_temporary() {
  fs::path opened;
  descriptor_ = open_new_file([this] { return target_.parent_path() / unique_name(); }, opened);
  if (descriptor_ < 0) refuse_to_open(shown_, errno);
  temporary_ = opened;
  owns_descriptor_ = true;
  // Absolute, since the handler of a second signal does not know of a change of folder.
  guard_ = std::make_unique<RemovedBySignal>(fs::absolute(temporary_).c_str());
}

void OutputFile::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written >= 0) {
      bytes.remove_prefix(static_cast<std::size_t>(written));
      continue;
    }
    if (errno == EINTR) {
      throw_if_interrupted();
      continue;
    }
    if (errno == EPIPE) throw OutputError(shown_.string() + " was closed by its reader");
    throw OutputError("cannot write " + shown_.string() + ": " + system_words(errno));
  }
}

void OutputFile::finish() {
  if (finished_) return;
  close_descriptor();
  finished_ = true;
}

void OutputFile::close_descriptor() {
  if (!owns_descriptor_) return;
  owns_descriptor_ = false;
  // Some file systems report a lack of space only here.
  if (close(descriptor_) != 0 && errno != EINTR) {
    throw OutputError("cannot write " + shown_.string() + ": " + system_words(errno));
  }
}

void OutputFile::commit() {
  throw_if_interrupted();
  finish();
  if (is_file() && rename(temporary_.c_str(), target_.c_str()) != 0) {
    throw OutputError("cannot write " + shown_.string() + ": " + system_words(errno));
  }
  committed_ = true;
  guard_.reset();
}

void OutputFile::discard() noexcept {
  if (owns_descriptor_) close(descriptor_);
  owns_descriptor_ = false;
  if (is_file() && !committed_) unlink(temporary_.c_str());
}

}  // namespace holdfast::program
