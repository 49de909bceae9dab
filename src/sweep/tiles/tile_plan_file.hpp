#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace holdfast::program {

/// What the tiles of a work folder are parts of.
struct TilePlan {
  /// Everything that the bytes of a tile depend on, name and text: {"version", "0.6.0"},
  /// {"--axis 1", "backlash.width=0:0.003:61"}.
  std::map<std::string, std::string> entries;
  std::int64_t tiles = 0;  ///< numbered 0 … tiles − 1
};

/// The text of the file that keeps the plan of a work folder:
///
///     holdfast tiles, format 1
///     3 tiles
///     --axis 1 = backlash.width=0:0.003:61
///     version = 0.6.0
///     checksum 0123456789abcdef
///
/// The entries are ordered by name. A backslash and control characters, and in names `=`, are
/// written as `\x` and two hexadecimal digits; a line of an entry is NAME, ` = `, TEXT. The last
/// line has the CRC-64 of the lines before it.
std::string tile_plan_text(const TilePlan& plan);

/// The plan that the text was made of; nothing for any other text.
std::optional<TilePlan> parse_tile_plan(std::string_view text);

/// Whether the text begins as that of a plan does, be it whole or not.
bool begins_as_tile_plan(std::string_view text);

/// A number that plans have in common only when they are the same: the checksum of the text.
std::uint64_t tile_plan_identity(const TilePlan& plan);

/// What differs, each entry with both texts: "--duration was 20, is 60; --kick was 1:0.1, is not
/// given; the number of tiles was 9, is 12". Empty for the same plan.
std::string tile_plan_differences(const TilePlan& before, const TilePlan& now);

}  // namespace holdfast::program
