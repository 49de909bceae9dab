#pragma once

#include <filesystem>
#include <string>

namespace holdfast::program {

/// The system's words for one of its error numbers: "No space left on device".
std::string system_words(int error);

/// Throws WrongInput: "cannot read PATH: WHY".
[[noreturn]] void refuse_to_read(const std::filesystem::path& path, const std::string& why);

/// Throws "cannot write PATH: WORDS" for what a job was asked to write: OutputError where the
/// machine is in trouble (full disk, input or output error, too many open files, lack of memory),
/// WrongInput for whatever else, since the path is to blame then.
[[noreturn]] void refuse_to_write(const std::filesystem::path& path, int error);

}  // namespace holdfast::program
