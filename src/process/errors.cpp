#include "process/errors.hpp"

#include "io/text/text.hpp"

namespace holdfast::program {

Refusal::Refusal(const std::string& message) : std::runtime_error(one_line(message)) {}

}  // namespace holdfast::program
