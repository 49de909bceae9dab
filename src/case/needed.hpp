#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "case/case_keys.hpp"
#include "process/errors.hpp"

namespace holdfast::program {

/// Something is asked that needs keys which the case has not; the message names them.
struct MissingKeys : WrongInput {
  using WrongInput::WrongInput;
};

/// Whether a key of a number has none: nobody gave it, and nothing stands in for it.
bool is_absent(const Case& the_case, const CaseKey& key);

/// Throws MissingKeys where the case has no value for some of these keys of numbers, in one line:
/// each of them with its unit, and what would do in its place.
void require_keys(const Case& the_case, const std::vector<std::string>& keys);

/// The number of a key. Throws as above.
double needed(const Case& the_case, std::string_view key);

}  // namespace holdfast::program
