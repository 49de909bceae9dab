#pragma once

#include <string>

#include "holdfast/core/errors.hpp"

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

/// The name of the parameter that the work refuses; empty where it takes them all.
template <typename Work>
std::string refused_name(const Work& work) {
  try {
    work();
    return "";
  } catch (const InvalidParameter& error) {
    return error.name();
  }
}

}  // namespace holdfast::tests
