#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>

#include "io/file/descriptor.hpp"
#include "process/interrupt.hpp"

namespace holdfast::program {

/// Whether a result of that name is asked for as netCDF: the name ends in `.nc`.
bool is_netcdf_name(const std::optional<std::filesystem::path>& path);

/// Whether a result of that name is asked for as a Zarr store: the name ends in `.zarr`, with or
/// without a slash behind.
bool is_store_name(const std::optional<std::filesystem::path>& path);

/// Whether the name ends in `.svg`, `.png` or `.pdf`, which asks for a picture.
bool is_picture_name(const std::filesystem::path& path);

/// Throws WrongInput where the name ends in something that promises another format than the job's.
/// @param drawn  the job has a picture
void require_output_name(const std::filesystem::path& path, bool drawn);

/// The length of what was written, and its checksum(), CRC-64/XZ: by them a reader knows the file.
struct Written {
  std::uint64_t bytes = 0;
  std::uint64_t checksum = 0;
};

/// A file that appears whole or not at all, or standard output.
///
/// Bytes go to a temporary file in the target's folder, and commit() gives it the target's name;
/// without commit() it is removed, and what a process that was killed has left of it goes with the
/// next one that writes the same file. Without a path, or for "-", they go to standard output, and
/// for a device or a pipe (/dev/null) to that.
///
/// Throws WrongInput from the constructor when the path cannot be written, OutputError when a
/// write fails, Interrupted when a signal has come.
class OutputFile {
 public:
  explicit OutputFile(const std::optional<std::filesystem::path>& path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(std::string_view bytes);

  /// Hands everything to the system and closes the file, so that commit() can fail no more for
  /// want of space. commit() calls it where the caller did not.
  void finish();

  /// Makes the file appear. For standard output: sees to it that all was written.
  void commit();

  /// Bytes that write() has been given so far, of a named file.
  const Written& written() const { return written_; }

  /// Whether a named file will appear, as opposed to standard output, a device or a pipe.
  bool is_file() const { return !temporary_.empty(); }

  /// The file that gets the target's name at commit(), for a library that writes files itself
  /// instead of write(); it must have closed the file by then. Empty unless is_file().
  const std::filesystem::path& temporary() const { return temporary_; }

  /// Where the file will appear; symbolic links are followed.
  const std::filesystem::path& target() const { return target_; }

 private:
  friend void commit_together(OutputFile& file, OutputFile& companion);
  [[noreturn]] void fail(int error) const;
  void appear();

  std::filesystem::path shown_;  // as the user wrote it
  std::filesystem::path target_;
  std::filesystem::path temporary_;  // empty unless the file appears by renaming
  std::unique_ptr<RemovedBySignal> guard_;
  Descriptor file_;  // none for standard output
  Descriptor lock_;  // holds the lock of the temporary file once that is finished
  Written written_;
  bool committed_ = false;
};

/// Makes a named file appear and beside it the one that describes it, whatever signal comes
/// meanwhile: both or neither. Where an older pair stands, its description goes first, so that no
/// file ever stands beside the description of another. Throws what commit() throws.
void commit_together(OutputFile& file, OutputFile& companion);

}  // namespace holdfast::program
