#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace holdfast::program {

/// What is nested deeper in a text than in any case, and on which line.
struct TomlExcess {
  std::size_t line = 0;
  std::string message;  ///< "brackets are nested deeper than 16"
};

/// Looks for brackets and keys (`a.b.c`) of more than 16 levels in a text that is to be read as
/// TOML, without recursion: what reads it, and what takes its tables apart, recurses, and a small
/// file could exhaust the stack. Strings and comments are passed over.
std::optional<TomlExcess> toml_excess(std::string_view text);

}  // namespace holdfast::program
