#pragma once

#include <string>

namespace holdfast::tests {

/// The message of the exception of that type that the work throws; a failure when it throws none.
template <typename Exception, typename Work>
std::string message_of(const Work& work) {
  try {
    work();
  } catch (const Exception& error) {
    return error.what();
  }
  return "(nothing was thrown)";
}

}  // namespace holdfast::tests
