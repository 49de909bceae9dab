#pragma once

#include <toml++/toml.h>
#include <string>
#include <string_view>

#include "case/case_keys.hpp"

namespace holdfast::program {

/// The tables of a case file. Throws WrongInput with file and line and, where there is a guess,
/// what is probably wrong.
toml::table parse_case_text(std::string_view text, const std::string& name);

/// The value of an override, under "value": TOML, or a word or a name without quotes.
/// Throws WrongInput, which begins with the place.
toml::table parse_override_value(const CaseKey& key, std::string_view value,
                                 const std::string& place);

/// As a file would have it, numbers with their shortest digits; the beginning where it is long.
std::string value_text(const toml::node& node);

}  // namespace holdfast::program
