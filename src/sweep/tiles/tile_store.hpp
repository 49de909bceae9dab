#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/file/folder_lock.hpp"
#include "sweep/tiles/tile_file.hpp"
#include "sweep/tiles/tile_plan_file.hpp"

namespace holdfast::program {

/// A work folder that keeps the finished tiles of a long computation, so that it can be killed at
/// any moment and gone on with.
///
/// A tile is a string of bytes. It is written whole, with its number, the identity of its plan and
/// a checksum, under a temporary name, and gets its own name by renaming; a file that is truncated,
/// altered or of another plan is no tile and counts as missing. Any number of threads and processes
/// may put and look up tiles of one folder at once, while one process holds it open for itself.
/// A tile number outside the plan throws std::out_of_range.
class TileStore {
 public:
  /// Makes the folder, or goes on with the one that is there, and keeps other programs from it
  /// until the object goes.
  ///
  /// Throws WrongInput where the folder holds tiles and `resume` is false (saying that --resume
  /// goes on with them), where its plan is damaged or another one (naming each entry that differs,
  /// with both texts), where it is no work folder, or cannot be written; OutputError where another
  /// program holds it, or the disk is full. A folder without tiles is begun again either way.
  static TileStore open(const std::filesystem::path& folder, const TilePlan& plan, bool resume);

  /// Joins a folder that another process of the same computation has opened, and keeps nobody from
  /// it. Throws WrongInput where the folder does not have that plan, or is not seen from here.
  static TileStore join(const std::filesystem::path& folder, const TilePlan& plan);

  /// Whether the folder holds this tile, whole and of this plan. Reads the file the first time. One
  /// that is not stays until put() replaces it: to remove it could meet what another process has
  /// put there meanwhile.
  bool has(std::int64_t tile) const;

  /// Keeps a finished tile. Throws OutputError where it cannot be written; what was kept before
  /// stays whole.
  void put(std::int64_t tile, std::string_view bytes) const;

  /// The bytes of a tile. Throws OutputError where has() would be false.
  std::string get(std::int64_t tile) const;

  /// Removes the tiles and the folder; call once they are not needed any more. Whatever else lies
  /// in the folder stays, and the folder then too; so does what the system will not remove.
  void remove();

  const std::filesystem::path& folder() const { return folder_; }

 private:
  TileStore(std::filesystem::path folder, const TilePlan& plan, std::optional<FolderLock> lock);
  TileLabel label_of(std::int64_t tile) const;
  bool known_whole(std::int64_t tile) const;
  void set_known_whole(std::int64_t tile, bool whole) const;

  std::filesystem::path folder_;
  std::uint64_t identity_;
  std::optional<FolderLock> lock_;
  std::unique_ptr<std::mutex> mutex_;
  mutable std::vector<bool> whole_;  // a bit a tile: those known to be
};

}  // namespace holdfast::program
