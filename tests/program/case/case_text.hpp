#pragma once

#include <string>
#include <vector>

#include "case/case_file.hpp"
#include "process/errors.hpp"
#include "support/message_of.hpp"
#include "support/testing.hpp"

namespace holdfast::tests {

/// The case of a text, as if it stood in case.toml.
inline program::Case from_text(const std::string& text,
                               const std::vector<std::string>& overrides = {}) {
  return program::load_case_text(text, "case.toml", overrides);
}

/// Why a text is no case, in one line.
inline std::string refusal(const std::string& text,
                           const std::vector<std::string>& overrides = {}) {
  const std::string message = message_of<program::WrongInput>([&] { from_text(text, overrides); });
  EXPECT_EQ(message.find('\n'), std::string::npos);
  return message;
}

/// Why the built-in case refuses overrides.
inline std::string override_refusal(const std::vector<std::string>& overrides) {
  return message_of<program::WrongInput>([&] { program::load_case(std::nullopt, overrides); });
}

inline bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace holdfast::tests

namespace holdfast::program {
using tests::from_text, tests::holds, tests::message_of, tests::override_refusal, tests::refusal;
}  // namespace holdfast::program
