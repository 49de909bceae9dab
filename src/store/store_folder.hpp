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

/// The values of a chunk: for each column of the store those of its cells.
using ChunkValues = std::vector<std::vector<double>>;

/// Cells of a grid as a Zarr store, a folder that xarray and zarr read while it grows. The axes are
/// coordinates, the columns arrays over them; numbers, units and meanings are as in netCDF. Nothing
/// in it is reached through a link.
///
/// A chunk is a file for each column; it is done when that of the first column is there, which is
/// written last. A file appears whole or not at all, and bears a checksum. Any number of threads
/// and processes, also of several machines, may fill one folder at once without knowing of each
/// other. A chunk number outside the store throws std::out_of_range.
class StoreFolder {
 public:
  /// Makes the store, or goes on with the one that is there.
  ///
  /// Throws WrongInput where the folder holds something else or a store of another plan (naming
  /// each entry that differs, with both texts), or cannot be written; OutputError where the disk is
  /// full. What describes a store that is there, and its axes, are mended where they are damaged.
  static StoreFolder enter(const std::filesystem::path& folder,
                           const StoreDescription& description);

  /// A store to be read. Throws WrongInput where there is none in the folder, and where a file that
  /// describes it, or one of its axes, is missing, damaged, or another store's.
  static StoreFolder open(const std::filesystem::path& folder);

  const StoreDescription& description() const { return description_; }
  const std::filesystem::path& folder() const { return folder_; }
  const ChunkGrid& grid() const { return description_.grid; }

  /// Whether the chunk is done; whether it is whole, read() tells.
  bool has(std::int64_t chunk) const;

  /// The values of a chunk; nothing where it is missing or damaged.
  std::optional<ChunkValues> read(std::int64_t chunk) const;
  /// Values of one column of a chunk.
  std::optional<std::vector<double>> read_column(std::size_t column, std::int64_t chunk) const;

  /// Keeps a chunk. Throws OutputError, which names the file, where it cannot be written; what was
  /// there stays whole.
  void put(std::int64_t chunk, const ChunkValues& values) const;

  /// Removes what a process that was killed has left of a chunk; its claim is the caller's.
  void remove_leftovers(std::int64_t chunk) const;

  /// The file that makes the chunk done.
  std::filesystem::path file_of(std::int64_t chunk) const { return file_of(array_of(0), chunk); }

  /// How many chunks are done.
  std::int64_t chunks_done() const;
  /// Chunks done of whatever store is in a folder; nothing where none is.
  static std::optional<std::int64_t> chunks_done_in(const std::filesystem::path& folder);

  /// Removes what a store of this description has, and the folder where nothing else lies in it:
  /// files with names that holdfast gives, where the user owns the folder. All else stays, and what
  /// cannot be removed. The root goes first, under another name: a removal that is cut short is
  /// finished by remove_store(), or by whoever enters the folder.
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

/// Removes the store in a folder, or what is left of one whose removal was cut short; nothing where
/// there is neither. See StoreFolder::remove().
void remove_store(const std::filesystem::path& folder);

/// The description of the store in a folder; nothing where there is no folder, or none in it that
/// holdfast wrote.
std::optional<StoreDescription> store_in(const std::filesystem::path& folder);

/// The right to compute a chunk, by a file that nobody else has locked. Processes that are ended,
/// however hard, lose it; on a file system without locks it is a hint alone.
class ChunkClaim {
 public:
  enum class Answer {
    ours,
    elsewhere,  ///< another process has it and is alive
    unknown,    ///< it has a file, and here are no locks that tell whether its process is alive
  };

  /// @param chunk_file  StoreFolder::file_of() of the chunk
  /// Throws OutputError where the file cannot be made.
  explicit ChunkClaim(const std::filesystem::path& chunk_file);
  ~ChunkClaim();
  ChunkClaim(const ChunkClaim&) = delete;
  ChunkClaim& operator=(const ChunkClaim&) = delete;

  Answer answer() const { return answer_; }

  /// Whether it was left by a process that was killed.
  bool was_left() const { return was_left_; }

  /// Whether a chunk has a claim, be its process alive or not.
  static bool exists(const std::filesystem::path& chunk_file);

 private:
  std::filesystem::path file_;
  Descriptor descriptor_;
  Answer answer_ = Answer::unknown;
  bool was_left_ = false;
};

}  // namespace holdfast::program
