#pragma once

#include <exception>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace holdfast::program {

/// Why the program ends, on one line.
class Refusal : public std::runtime_error {
 public:
  explicit Refusal(const std::string& message);
};

/// The user asked for something that cannot be asked: exit code 2.
struct WrongInput : Refusal {
  using Refusal::Refusal;
};

/// The question is fair and the computation has no answer to it: exit code 1. The message says why.
struct NoAnswer : Refusal {
  using Refusal::Refusal;
};

/// A result could not be written, in the system's words: exit code 1.
struct OutputError : Refusal {
  using Refusal::Refusal;
};

/// The system's words for one of its error numbers: "No space left on device".
std::string system_words(int error);

/// Throws WrongInput: "cannot read PATH: WHY".
[[noreturn]] void refuse_to_read(const std::filesystem::path& path, const std::string& why);

/// Throws "cannot write PATH: WORDS" for what a job was asked to write: OutputError where the
/// machine is in trouble (full disk, input or output error, too many open files, lack of memory),
/// WrongInput for whatever else, since the path is to blame then.
[[noreturn]] void refuse_to_write(const std::filesystem::path& path, int error);

}  // namespace holdfast::program
