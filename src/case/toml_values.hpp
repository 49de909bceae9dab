#pragma once

#include <toml++/toml.h>
#include <cstddef>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "case/case_keys.hpp"

namespace holdfast::program {

/// Excess nesting of a text, deeper than in any case, and its line.
struct TomlExcess {
  std::size_t line = 0;
  std::string message;  ///< "brackets are nested deeper than 16"
};

/// Looks for brackets and keys (`a.b.c`) of more than 16 levels in a text that is to be read as
/// TOML, without recursion: what reads it, and what takes its tables apart, recurses, and a small
/// file could exhaust the stack. Strings and comments are passed over.
std::optional<TomlExcess> toml_excess(std::string_view text);

/// The tables of a case file. Throws WrongInput with file and line and, where there is a guess,
/// what is probably wrong.
toml::table parse_case_text(std::string_view text, const std::string& name);

/// The value of an override, under "value": TOML, or a word or a name without quotes.
/// Throws WrongInput, which begins with the place.
toml::table parse_override_value(const KeyForm& key, std::string_view value,
                                 const std::string& place);

/// A number, or a text of one with a unit, in the own unit; nothing where the node is neither, NaN
/// where it is a number of some other kind. Throws WrongInput, which begins with the place and
/// names the units that would do, for a unit of something else.
std::optional<double> number_in(const toml::node& node, const std::string& unit,
                                const std::string& place);

/// Gives a key the value that a node holds; a relative name of a file is one to the folder. Throws
/// WrongInput, which begins with the place, where that is not admissible.
void read_value(const KeyForm& key, const ValuePlace& value, const toml::node& node,
                const std::string& place, const std::filesystem::path& folder);

/// A value as a file would have it.
std::string toml_value(const KeyForm& key, const ValuePlace& value);
nlohmann::ordered_json json_value(const KeyForm& key, const ValuePlace& value);

/// As a file would have it, numbers with their shortest digits; the beginning where it is long.
std::string value_text(const toml::node& node);

/// A TOML string: quotes, backslashes and control characters are escaped.
std::string toml_string(std::string_view text);

/// A line of a case file: `name = value  # unit, description`.
std::string toml_line(const KeyForm& key, const std::string& name, const std::string& value);

}  // namespace holdfast::program
