#include "process/errors.hpp"

#include "io/text/text.hpp"

namespace holdfast::program {

WrongInput::WrongInput(const std::string& message) : std::runtime_error(one_line(message)) {}

NoAnswer::NoAnswer(const std::string& reason) : std::runtime_error(one_line(reason)) {}

OutputError::OutputError(const std::string& message) : std::runtime_error(one_line(message)) {}

}  // namespace holdfast::program
