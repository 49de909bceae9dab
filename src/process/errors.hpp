#pragma once

#include <exception>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace holdfast::program {

/// Exception that ends the program, with a message of one line.
class Refusal : public std::runtime_error {
 public:
  explicit Refusal(const std::string& message);
};

/// Exception for invalid input of the user: exit code 2.
struct WrongInput : Refusal {
  using Refusal::Refusal;
};

/// Exception for valid input without an answer, with the reason as message: exit code 1.
struct NoAnswer : Refusal {
  using Refusal::Refusal;
};

/// Exception for a result that could not be written, with the system's message: exit code 1.
struct OutputError : Refusal {
  using Refusal::Refusal;
};

/// The system's message for an error number: "No space left on device".
std::string system_words(int error);

/// Throws WrongInput: "cannot read PATH: WHY".
[[noreturn]] void refuse_to_read(const std::filesystem::path& path, const std::string& why);

/// Throws "cannot write PATH: WORDS" for an output of a job. OutputError if the machine is the
/// cause (full disk, input or output error, too many open files, lack of memory), else WrongInput,
/// since the path is the cause.
[[noreturn]] void refuse_to_write(const std::filesystem::path& path, int error);

}  // namespace holdfast::program
