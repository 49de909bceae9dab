#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace holdfast::program {

/// Creates a file that does not exist yet, not even as a link, and opens it for writing. Returns
/// the descriptor, or −1 with the reason in errno.
int open_new_file(const std::filesystem::path& file);

/// Writes a file that appears complete or not at all; an existing file of this name is replaced.
/// The file is flushed to the disk. Returns 0, or the system's error number if nothing was written.
///
/// The bytes go to a temporary file beside it, `.NAME-PROCESS-COUNT.tmp`, which is then renamed; a
/// killed process leaves its temporary file. Threads and processes may write one file concurrently.
int write_whole_file(const std::filesystem::path& file, std::string_view bytes);

/// The NAME in the name of a temporary file of write_whole_file(); nullopt for any other name.
std::optional<std::string> name_behind_temporary(std::string_view name);

/// The bytes of a regular file, without waiting for a pipe. Returns nullopt on failure and sets
/// `error` to the system's error number (EISDIR for a folder, EINVAL for a device or a pipe).
std::optional<std::string> read_whole_file(const std::filesystem::path& file, int& error);

/// The whole text of a file or pipe. Throws WrongInput if it cannot be read or exceeds 2³¹ bytes.
std::string read_input(const std::filesystem::path& file);

/// Throws WrongInput if `output` is the file `input`, from which the result is computed.
void require_not_overwritten(const std::filesystem::path& input,
                             const std::optional<std::filesystem::path>& output);

}  // namespace holdfast::program
