#include <fcntl.h>
#include <unistd.h>

#include <cerrno>

#include "io/file/folder_lock.hpp"
#include "io/file/whole_file.hpp"
#include "process/errors.hpp"
#include "store/store_folder.hpp"

namespace holdfast::program {
namespace {

namespace fs = std::filesystem;

fs::path claim_beside(const fs::path& chunk_file) {
  return chunk_file.parent_path() / ("." + chunk_file.filename().string() + ".claim");
}

[[noreturn]] void refuse(const fs::path& path, int error) {
  throw OutputError("cannot write " + path.string() + ": " + system_words(error));
}

}  // namespace

ChunkClaim::ChunkClaim(const fs::path& chunk_file) : file_(claim_beside(chunk_file)) {
  for (;;) {
    Descriptor opened(open_new_file(file_));
    const bool made = opened.is_open();
    if (!made && errno != EEXIST) refuse(file_, errno);
    if (!made) opened = Descriptor(open(file_.c_str(), O_WRONLY | O_CLOEXEC | O_NOFOLLOW));
    if (!opened.is_open() && errno == ENOENT) continue;  // its process has finished
    if (!opened.is_open()) refuse(file_, errno);
    const int fault = lock_file(opened.number());
    if (fault == EWOULDBLOCK) {
      answer_ = Answer::elsewhere;
      return;
    }
    // Its process may have removed it since it was opened.
    if (!has_name(opened.number(), file_)) continue;
    if (fault != 0 && !made) return;
    answer_ = Answer::ours;
    was_left_ = !made;
    descriptor_ = std::move(opened);
    return;
  }
}

bool ChunkClaim::exists(const fs::path& chunk_file) {
  std::error_code error;
  return fs::exists(claim_beside(chunk_file), error);
}

ChunkClaim::~ChunkClaim() {
  if (answer_ == Answer::ours) unlink(file_.c_str());
}

}  // namespace holdfast::program
