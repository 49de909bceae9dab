#pragma once

#include <string>
#include <string_view>

#include "case/case.hpp"

namespace holdfast::program {

/// Whether the case has the key's value from the library, by conductor.name.
bool is_from_library(const Case& the_case, std::string_view key);

/// That values given beside conductor.name are not its: those that differ by more than a tenth from
/// the library's, with both and their ratio, and the unit whose mistake that ratio is. Empty
/// otherwise.
std::string contradicted_name_text(const Case& the_case);

/// That the damping ratio of a named conductor is the built-in cable's. Empty otherwise.
std::string borrowed_damping_text(const Case& the_case);

}  // namespace holdfast::program
