#pragma once

#include <exception>
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

/// Another process of the same computation has told why it ends; this one ends with the same code
/// and in silence.
class ToldElsewhere : public std::exception {
 public:
  explicit ToldElsewhere(int exit_code) : exit_code_(exit_code) {}
  int exit_code() const { return exit_code_; }
  const char* what() const noexcept override { return "told by another process"; }

 private:
  int exit_code_;
};

}  // namespace holdfast::program
