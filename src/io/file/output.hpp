#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>

#include "process/interrupt.hpp"

namespace holdfast::program {

/// Whether a result of that name is asked for as netCDF: the name ends in `.nc`.
bool is_netcdf_name(const std::optional<std::filesystem::path>& path);

/// A file that appears whole or not at all, or standard output.
///
/// Bytes go to a temporary file in the target's folder, and commit() gives it the target's name;
/// without commit() it is removed. Without a path, or for "-", they go to standard output, and for
/// a device or a pipe (/dev/null) to that.
///
/// Throws WrongInput from the constructor when the path cannot be written, OutputError when a
/// write fails, Interrupted when a signal has come.
class OutputFile {
 public:
  explicit OutputFile(const std::optional<std::filesystem::path>& path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  OutputFile(OutputFile&&) = delete;
  OutputFile& operator=(OutputFile&&) = delete;

  void write(std::string_view bytes);

  /// Hands everything to the system and closes the file, so that commit() can fail no more for
  /// want of space. commit() calls it where the caller did not.
  void finish();

  /// Makes the file appear. For standard output: sees to it that all was written.
  void commit();

  /// Whether a named file will appear, as opposed to standard output, a device or a pipe.
  bool is_file() const { return !temporary_.empty(); }

  /// The file that gets the target's name at commit(), for a library that writes files itself
  /// instead of write(); it must have closed the file by then. Empty unless is_file().
  const std::filesystem::path& temporary() const { return temporary_; }

  /// Where the file will appear; symbolic links are followed.
  const std::filesystem::path& target() const { return target_; }

 private:
  void open_temporary();
  void open_device();
  void close_descriptor();
  void discard() noexcept;

  std::filesystem::path shown_;  // as the user wrote it
  std::filesystem::path target_;
  std::filesystem::path temporary_;  // empty unless the file appears by renaming
  std::unique_ptr<RemovedBySignal> guard_;
  int descriptor_ = -1;
  bool owns_descriptor_ = false;
  bool finished_ = false;
  bool committed_ = false;
};

}  // namespace holdfast::program
