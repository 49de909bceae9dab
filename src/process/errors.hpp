#pragma once

#include <exception>
#include <stdexcept>
#include <string>

namespace holdfast::program {

/// The user asked for something that cannot be asked: exit code 2. The message is one line.
class WrongInput : public std::runtime_error {
 public:
  explicit WrongInput(const std::string& message);
};

/// The question is fair and the computation has no answer to it: exit code 1. The message says why.
class NoAnswer : public std::runtime_error {
 public:
  explicit NoAnswer(const std::string& reason);
};

/// A result could not be written, in the system's words: exit code 1.
class OutputError : public std::runtime_error {
 public:
  explicit OutputError(const std::string& message);
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
