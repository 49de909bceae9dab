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

/// Place of too deep a nesting in a TOML text, and a message about it.
struct TomlExcess {
  std::size_t line = 0;
  std::string message;  ///< message: "brackets are nested deeper than 16 levels"
};

/// First bracket or key (`a.b.c`) of a TOML text nested deeper than 16 levels; nullopt if there is
/// none. Call it before the TOML parser, which is recursive: a small file with deep nesting would
/// exhaust its stack. Strings and comments are skipped.
std::optional<TomlExcess> toml_excess(std::string_view text);

/// Parses a case file. Throws WrongInput with file, line and, if guessed, the probable mistake.
toml::table parse_case_text(std::string_view text, const std::string& name);

/// Parses the value of an override into a table with the key "value". Words and names need no
/// quotes. Throws WrongInput, whose message begins with the place.
toml::table parse_override_value(const KeyForm& key, std::string_view value,
                                 const std::string& place);

/// A number in `unit`, from a TOML number or a text with a unit ("28.2 kN"). None if the node is
/// neither; NaN if a double cannot represent the number. Throws WrongInput for a wrong unit; the
/// message begins with the place and names the admissible units.
std::optional<double> number_in(const toml::node& node, const std::string& unit,
                                const std::string& place);

/// Sets a key to the value of a TOML node; a relative file name is relative to `folder`. Throws
/// WrongInput, whose message begins with the place, if the value is not admissible.
void read_value(const KeyForm& key, const ValuePlace& value, const toml::node& node,
                const std::string& place, const std::filesystem::path& folder);

/// The value of a key as TOML, and as JSON.
std::string toml_value(const KeyForm& key, const ValuePlace& value);
nlohmann::ordered_json json_value(const KeyForm& key, const ValuePlace& value);

/// A TOML node as text, shortened to 60 characters; numbers have the fewest exact digits.
std::string value_text(const toml::node& node);

/// A TOML string: quotes, backslashes and control characters are escaped.
std::string toml_string(std::string_view text);

/// A line of a case file: `name = value  # unit, description`.
std::string toml_line(const KeyForm& key, const std::string& name, const std::string& value);

}  // namespace holdfast::program
