#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/file/descriptor.hpp"
#include "io/file/own_folder.hpp"
#include "store/store_description.hpp"

namespace holdfast::program {

/// Values of a chunk: a list per column of the store, with a value per cell.
using ChunkValues = std::vector<std::vector<double>>;

/// A Zarr store with the cells of a grid: a folder that xarray and zarr can read while it is
/// filled. The axes are coordinates, the columns arrays over them; numbers, units and descriptions
/// are as in netCDF. Nothing is written through a symbolic link.
///
/// A chunk has one file per column. The file of the first column is written last: once it exists,
/// the chunk is done. A file appears complete or not at all, and contains a checksum. Threads and
/// processes, also of several machines, may fill one folder concurrently. A chunk number outside
/// the store throws std::out_of_range.
class StoreFolder {
 public:
  /// Creates the store, or continues an existing one, whose damaged descriptions are repaired.
  ///
  /// Throws WrongInput if the folder has other content, is a store of another plan (the message
  /// gives each differing entry with both texts) or cannot be written; OutputError for a full disk.
  static StoreFolder enter(const std::filesystem::path& folder,
                           const StoreDescription& description);

  /// Opens a store for reading. Throws WrongInput if the folder has no store, or if a file with its
  /// description or an axis is missing, damaged or of another store.
  static StoreFolder open(const std::filesystem::path& folder);

  const StoreDescription& description() const { return description_; }
  const std::filesystem::path& folder() const { return folder_; }
  const ChunkGrid& grid() const { return description_.grid; }

  /// Whether the chunk is done; only read() checks whether it is undamaged.
  bool has(std::int64_t chunk) const;

  /// Values of a chunk; nullopt if it is missing or damaged.
  std::optional<ChunkValues> read(std::int64_t chunk) const;
  /// Values of one column of a chunk; nullopt if its file is missing or damaged.
  std::optional<std::vector<double>> read_column(std::size_t column, std::int64_t chunk) const;

  /// Writes a chunk. Throws OutputError, which names the file, if that fails; existing files remain
  /// complete.
  void put(std::int64_t chunk, const ChunkValues& values) const;

  /// Removes temporary files of a chunk that a killed process has left, but not the chunk's claim.
  void remove_leftovers(std::int64_t chunk) const;

  /// Path of the file whose existence marks the chunk as done.
  std::filesystem::path file_of(std::int64_t chunk) const { return file_of(array_of(0), chunk); }

  /// Number of chunks done.
  std::int64_t chunks_done() const;
  /// Number of chunks done in the store of a folder; nullopt if the folder has no store.
  static std::optional<std::int64_t> chunks_done_in(const std::filesystem::path& folder);

  /// Removes the files of this store, and the folder if it is then empty. Only files with names
  /// that holdfast gives are removed, in folders that the user owns; all else remains. The root
  /// file is renamed first: remove_store() or the next enter() completes an interrupted removal.
  void remove() const;

 private:
  StoreFolder(std::filesystem::path folder, StoreDescription description)
      : folder_(std::move(folder)), description_(std::move(description)) {}
  const StoreArray& array_of(std::size_t column) const {
    return arrays_[description_.axes.size() + column];
  }
  std::filesystem::path file_of(const StoreArray& array, std::int64_t chunk) const;
  std::string seal_of(const std::filesystem::path& file) const;
  std::string packed(const StoreArray& array, std::int64_t chunk,
                     const std::vector<double>& values) const;
  std::optional<std::vector<double>> values_in(const StoreArray& array, std::int64_t chunk) const;
  template <class Call>
  void each_axis_file(const Call& call) const;
  void read_axes();
  void begin() const;
  void write_axis(std::size_t axis, std::int64_t chunk) const;
  void mend(const Documents& documents) const;
  void require(const Documents& documents) const;
  void refuse_links() const;
  bool gives(const std::string& name, const ChunkGrid& grid) const;
  void remove_array(const OwnFolder& folder, const StoreArray& array) const;
  friend void remove_store(const std::filesystem::path& folder);

  std::filesystem::path folder_;
  StoreDescription description_;
  std::vector<StoreArray> arrays_ = arrays_of(description_);
  std::string identity_ = plan_identity(description_.plan);
};

/// Removes the store in a folder, or completes an interrupted removal; without effect if there is
/// neither. See StoreFolder::remove().
void remove_store(const std::filesystem::path& folder);

/// Description of the store in a folder; nullopt if the folder does not exist or has no store that
/// holdfast wrote.
std::optional<StoreDescription> store_in(const std::filesystem::path& folder);

/// Exclusive right to compute a chunk, represented by a locked file. The right ends with the
/// process, even if it is killed. On a file system without locks it is only a hint.
class ChunkClaim {
 public:
  enum class Answer {
    ours,
    elsewhere,  ///< another running process has the claim
    unknown,    ///< a claim file exists; without locks its process may be running or not
  };

  /// Tries to claim a chunk. @param chunk_file  StoreFolder::file_of() of the chunk
  /// Throws OutputError where the file cannot be made.
  explicit ChunkClaim(const std::filesystem::path& chunk_file);
  ~ChunkClaim();
  ChunkClaim(const ChunkClaim&) = delete;
  ChunkClaim& operator=(const ChunkClaim&) = delete;

  Answer answer() const { return answer_; }

  /// Whether a killed process has left this claim.
  bool was_left() const { return was_left_; }

  /// Whether a claim file of the chunk exists, whether its process is running or not.
  static bool exists(const std::filesystem::path& chunk_file);

 private:
  std::filesystem::path file_;
  Descriptor descriptor_;
  Answer answer_ = Answer::unknown;
  bool was_left_ = false;
};

}  // namespace holdfast::program
