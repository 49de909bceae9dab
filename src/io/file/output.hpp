#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>

#include "io/file/descriptor.hpp"
#include "process/interrupt.hpp"

namespace holdfast::program {

/// Whether the path names a netCDF file: it ends in `.nc`. False without a path.
bool is_netcdf_name(const std::optional<std::filesystem::path>& path);

/// Whether the path names a Zarr store: it ends in `.zarr` or `.zarr/`. False without a path.
bool is_store_name(const std::optional<std::filesystem::path>& path);

/// Whether the path names a picture: it ends in `.svg`, `.png` or `.pdf`.
bool is_picture_name(const std::filesystem::path& path);

/// Throws WrongInput if the name has the ending of a format that the job does not write.
/// @param drawn  whether the job has a picture
void require_output_name(const std::filesystem::path& path, bool drawn);

/// Size and checksum (CRC-64/XZ) of a written file, by which a reader can verify the file.
struct Written {
  std::uint64_t bytes = 0;
  std::uint64_t checksum = 0;
};

/// An output file that appears complete or not at all, or standard output.
///
/// Bytes go to a temporary file in the target's folder, which commit() renames to the target.
/// Without commit() the temporary file is removed; a temporary file of a killed process is removed
/// by the next run with the same target. Without a path or for "-", bytes go to standard output. If
/// the target is a device or a pipe (/dev/null), bytes go directly to it.
///
/// Throws WrongInput from the constructor when the path cannot be written, OutputError when a write
/// fails, Interrupted after a signal.
class OutputFile {
 public:
  explicit OutputFile(const std::optional<std::filesystem::path>& path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(std::string_view bytes);

  /// Closes the file; commit() then cannot fail for lack of space. commit() calls it if need be.
  void finish();

  /// Makes the file appear under the target's name; closes a device or a pipe.
  void commit();

  /// Size and checksum of the bytes passed to write() so far; only for a named file.
  const Written& written() const { return written_; }

  /// Whether commit() makes a file appear; false for standard output, a device or a pipe.
  bool is_file() const { return !temporary_.empty(); }

  /// Path of the temporary file, for a library that writes the file itself instead of write(). The
  /// library must have written it completely before commit(). Empty unless is_file().
  const std::filesystem::path& temporary() const { return temporary_; }

  /// Path at which the file will appear, with symbolic links followed.
  const std::filesystem::path& target() const { return target_; }

 private:
  friend void commit_together(OutputFile& file, OutputFile& companion);
  [[noreturn]] void fail(int error) const;
  void appear();

  std::filesystem::path shown_;  // path as the user gave it
  std::filesystem::path target_;
  std::filesystem::path temporary_;  // empty unless the file appears by renaming
  std::unique_ptr<RemovedBySignal> guard_;
  Descriptor file_;  // none for standard output
  Descriptor lock_;  // keeps the lock of the temporary file after finish()
  Written written_;
  bool committed_ = false;
};

/// Makes a file and its companion, which describes it, appear together: both or neither, whatever
/// signal arrives meanwhile. An older companion is removed first, so that no file is ever beside
/// the description of another. Throws the exceptions of commit().
void commit_together(OutputFile& file, OutputFile& companion);

}  // namespace holdfast::program
