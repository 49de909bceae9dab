#include "sweep/tiles/tile_store.hpp"

#include <mutex>
#include <optional>
#include <stdexcept>
#include <vector>

#include "io/file/folder_lock.hpp"
#include "io/file/whole_file.hpp"
#include "process/errors.hpp"
#include "process/system_words.hpp"
#include "sweep/tiles/tile_file.hpp"
#include "sweep/tiles/tile_plan_file.hpp"
#include "sweep/tiles/work_folder.hpp"
#include "sweep/tiles/work_folder_plan.hpp"

namespace holdfast::program {
namespace fs = std::filesystem;

/// The folder, whose it is, and which of its tiles are known to be whole.
class TileStore::Folder {
 public:
  Folder(fs::path path, const TilePlan& plan, std::optional<FolderLock> lock)
      : path_(std::move(path)),
        identity_(tile_plan_identity(plan)),
        lock_(std::move(lock)),
        whole_(static_cast<std::size_t>(plan.tiles)) {}

  const fs::path& path() const { return path_; }

  TileLabel label_of(std::int64_t tile) const {
    if (tile < 0 || static_cast<std::size_t>(tile) >= whole_.size()) {
      throw std::out_of_range("no such tile in the plan");
    }
    return {identity_, tile};
  }

  fs::path file_of(std::int64_t tile) const { return path_ / tile_file_name(tile); }

  bool known_whole(std::int64_t tile) const {
    const std::lock_guard<std::mutex> guard(mutex_);
    return whole_[static_cast<std::size_t>(tile)];
  }

  void set_known_whole(std::int64_t tile, bool whole) {
    const std::lock_guard<std::mutex> guard(mutex_);
    whole_[static_cast<std::size_t>(tile)] = whole;
  }

  void remove() {
    remove_work_folder(path_);
    lock_.reset();
    const std::lock_guard<std::mutex> guard(mutex_);
    whole_.assign(whole_.size(), false);
  }

 private:
  fs::path path_;
  std::uint64_t identity_;
  std::optional<FolderLock> lock_;
  mutable std::mutex mutex_;
  std::vector<bool> whole_;  // a bit a tile
};

TileStore::TileStore(std::unique_ptr<Folder> folder) : folder_(std::move(folder)) {}
TileStore::~TileStore() = default;
TileStore::TileStore(TileStore&&) noexcept = default;
TileStore& TileStore::operator=(TileStore&&) noexcept = default;

TileStore TileStore::open(const fs::path& folder, const TilePlan& plan, bool resume) {
  FolderLock lock = enter_work_folder(folder, plan, resume);
  return TileStore(std::make_unique<Folder>(folder, plan, std::move(lock)));
}

TileStore TileStore::join(const fs::path& folder, const TilePlan& plan) {
  require_plan_of_work_folder(folder, plan);
  return TileStore(std::make_unique<Folder>(folder, plan, std::nullopt));
}

bool TileStore::has(std::int64_t tile) const {
  const TileLabel label = folder_->label_of(tile);
  if (folder_->known_whole(tile)) return true;
  int ignored = 0;  // a file that cannot be read is as good as none
  const std::optional<std::string> file = read_whole_file(folder_->file_of(tile), ignored);
  const bool whole = file && tile_content(label, *file);
  if (whole) folder_->set_known_whole(tile, true);
  return whole;
}

void TileStore::put(std::int64_t tile, std::string_view bytes) const {
  const TileLabel label = folder_->label_of(tile);
  const fs::path file = folder_->file_of(tile);
  const int error = write_whole_file(file, tile_file(label, bytes));
  if (error != 0) {
    throw OutputError("cannot write " + file.string() + ": " + system_words(error));
  }
  folder_->set_known_whole(tile, true);
}

std::string TileStore::get(std::int64_t tile) const {
  const TileLabel label = folder_->label_of(tile);
  const fs::path path = folder_->file_of(tile);
  int error = 0;
  const std::optional<std::string> file = read_whole_file(path, error);
  const std::optional<std::string_view> content = file ? tile_content(label, *file) : std::nullopt;
  if (content) return std::string(*content);
  folder_->set_known_whole(tile, false);
  const std::string why = file ? "it is damaged, or of another sweep" : system_words(error);
  throw OutputError("cannot read " + path.string() + ": " + why);
}

void TileStore::remove() { folder_->remove(); }

const fs::path& TileStore::folder() const { return folder_->path(); }

}  // namespace holdfast::program
