#pragma once

#include <string>
#include <string_view>

#include "case/case.hpp"

namespace holdfast::program {

/// Whether the case has the key's value from the library, by conductor.name.
bool is_from_library(const Case& the_case, std::string_view key);

/// That conductor.name fills nothing since the case gives every value itself, and of another
/// conductor: mass, area or diameter differ by more than a tenth. Empty otherwise.
std::string idle_name_text(const Case& the_case);

/// That the damping ratio of a named conductor is the built-in cable's. Empty otherwise.
std::string borrowed_damping_text(const Case& the_case);

}  // namespace holdfast::program
