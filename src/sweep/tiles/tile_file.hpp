#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

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

/// What was computed of the cells of one tile.
struct TileResult {
  std::int64_t cells = 0;
  std::vector<double> values;       // column after column, one value a cell in each
  std::int64_t samples = 0;         // of the motions of the cells
  std::int64_t diverging = 0;       // cells whose motion diverges
  std::int64_t without_motion = 0;  // cells not admissible, or without a best gain
  std::string first_fault;          // why the first of those is not; empty where there is none

  /// The values of one column.
  const double* column(std::size_t number) const {
    return values.data() + number * static_cast<std::size_t>(cells);
  }
};

/// The tile as bytes, for the same program on the same kind of machine.
std::string tile_bytes(const TileResult& tile);

/// The tile of such bytes. Throws OutputError where they are none of a tile with that many cells
/// and columns.
TileResult tile_of_bytes(std::string_view bytes, std::int64_t cells, std::size_t columns);

}  // namespace holdfast::program
