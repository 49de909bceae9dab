#include "output/grid/chunk_grid.hpp"

#include "support/testing.hpp"

namespace holdfast::program {
namespace {

std::vector<ChunkGrid> some_grids() {
  std::mt19937 random(7);
  std::vector<ChunkGrid> grids;
  for (int draw = 0; draw < 200; ++draw) {
    ChunkGrid grid;
    for (std::size_t axes = 1 + random() % 4; axes > 0; --axes)
      grid.shape.push_back(1 + random() % 9);
    grid.chunk = chunk_shape(grid.shape, 1 + random() % 60);
    grids.push_back(grid);
  }
  return grids;
}

TEST(ChunkGrid, ItsChunksAreRunsThatCoverEveryCellOnce) {
  for (const ChunkGrid& grid : some_grids()) {
    std::int64_t next = 0;
    for (std::int64_t chunk = 0; chunk < grid.chunks(); ++chunk) {
      EXPECT_EQ(grid.first_cell(chunk), next);
      EXPECT_GE(grid.cells_of(chunk), 1);
      EXPECT_LE(grid.cells_of(chunk), grid.cells_of_file());
      next += grid.cells_of(chunk);
    }
    EXPECT_EQ(next, grid.cells());
  }
}

/// The index along each axis, by the definition of a regular grid of chunks.
TEST(ChunkGrid, ACellLiesInTheChunkOfItsIndices) {
  for (const ChunkGrid& grid : some_grids()) {
    for (std::int64_t chunk = 0; chunk < grid.chunks(); ++chunk) {
      for (std::int64_t i = 0; i < grid.cells_of(chunk); ++i) {
        std::int64_t cell = grid.first_cell(chunk) + i;
        for (std::size_t axis = grid.shape.size(); axis-- > 0;) {
          const auto count = static_cast<std::int64_t>(grid.shape[axis]);
          EXPECT_EQ(cell % count / static_cast<std::int64_t>(grid.chunk[axis]),
                    grid.place(chunk)[axis]);
          cell /= count;
        }
      }
    }
  }
}

TEST(ChunkGrid, AShapeOfItsOwnCellsIsItself) {
  for (const ChunkGrid& grid : some_grids())
    EXPECT_EQ(chunk_shape(grid.shape, static_cast<std::size_t>(grid.cells_of_file())), grid.chunk);
}

}  // namespace
}  // namespace holdfast::program
