#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace holdfast::program {

/// Which tile of which plan a file holds.
struct TileLabel {
  std::uint64_t plan = 0;  ///< identity of the plan
  std::int64_t tile = 0;   ///< number of the tile, 0 …
};

/// The bytes of the file of a tile: 48 bytes of head, then the content. The head is `holdtile` and
/// five whole numbers of 8 bytes, lowest first: format (1), plan, tile, length of the content, and
/// the checksum of the head before it followed by the content.
std::string tile_file(const TileLabel& label, std::string_view content);

/// The content, a part of `file`; nothing where the bytes are not those of tile_file() with that
/// label: truncated, altered, of another tile or of another plan.
std::optional<std::string_view> tile_content(const TileLabel& label, std::string_view file);

}  // namespace holdfast::program
