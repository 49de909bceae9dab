#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "case/case_keys.hpp"
#include "process/errors.hpp"

namespace holdfast::program {

/// Error for keys that a job needs and the case does not give; the message names them.
struct MissingKeys : WrongInput {
  using WrongInput::WrongInput;
};

/// Whether a numeric key has no value in the case: neither given nor a default.
bool is_absent(const Case& the_case, const CaseKey& key);

/// Throws MissingKeys if the case has no value of one of these numeric keys. The message, one line,
/// names each missing key with its unit and an alternative key.
void require_keys(const Case& the_case, const std::vector<std::string>& keys);

/// The number of a key. Throws MissingKeys if the case has none.
double needed(const Case& the_case, std::string_view key);

}  // namespace holdfast::program
