#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace holdfast::program {

/// Makes and opens for writing a file that was not there before, not even as a link. Gives the
/// descriptor; or −1, and the reason is in errno.
int open_new_file(const std::filesystem::path& file);

/// Writes a file that appears whole or not at all, in place of one that has the name already, and
/// is on the disk by then. Gives 0, or the system's error number, and then nothing is left of it.
///
/// The bytes go to a temporary file beside it, `.NAME-PROCESS-COUNT.tmp`, which is then renamed; a
/// process that is killed leaves that one. Any number of threads and processes may write one file.
int write_whole_file(const std::filesystem::path& file, std::string_view bytes);

/// The NAME that a temporary file of write_whole_file() was to get; nothing for another file's
/// name.
std::optional<std::string> name_behind_temporary(std::string_view name);

/// The bytes of a regular file; or nothing, and `error` is the system's error number (EISDIR for a
/// folder, EINVAL for a device or a pipe, which are not waited for).
std::optional<std::string> read_whole_file(const std::filesystem::path& file, int& error);

/// The whole text of a file. Throws WrongInput, in the system's words, when it cannot be read.
std::string read_input(const std::filesystem::path& file);

/// Throws WrongInput where a result would take the place of a file that it is computed from.
void require_not_overwritten(const std::filesystem::path& input,
                             const std::optional<std::filesystem::path>& output);

}  // namespace holdfast::program
