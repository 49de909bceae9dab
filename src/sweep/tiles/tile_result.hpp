#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace holdfast::program {

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
