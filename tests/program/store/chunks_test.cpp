#include "output/grid/chunk_grid.hpp"
#include "process/errors.hpp"
#include "store/chunk_packing.hpp"
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

std::vector<ChunkPacking> packings() {
  if (usual_packing() == ChunkPacking::zstd) return {ChunkPacking::zstd, ChunkPacking::checksum};
  return {ChunkPacking::checksum};
}

std::string some_bytes(std::mt19937& random, std::size_t size) {
  std::string bytes(size, '\0');
  for (char& byte : bytes) byte = static_cast<char>(random() % (random() % 256 + 1));
  return bytes;
}

TEST(ChunkPacking, GivesBackWhatItWasGiven) {
  std::mt19937 random(1);
  for (const ChunkPacking packing : packings()) {
    for (const std::size_t size : {0UL, 1UL, 8UL, 4096UL, 100000UL}) {
      const std::string bytes = some_bytes(random, size);
      const std::string file = packed_chunk(bytes, packing);
      EXPECT_EQ(unpacked_chunk(file, size, packing), bytes);
      EXPECT_EQ(unpacked_chunk(file, size + 1, packing), std::nullopt);
      EXPECT_EQ(packed_chunk(bytes, packing), file);
    }
  }
}

TEST(ChunkPacking, NoticesEveryDamageOfOneBitAndEveryCut) {
  std::mt19937 random(2);
  for (const ChunkPacking packing : packings()) {
    const std::string bytes = some_bytes(random, 300);
    const std::string file = packed_chunk(bytes, packing);
    int unnoticed = 0;
    for (std::size_t bit = 0; bit < 8 * file.size(); ++bit) {
      std::string damaged = file;
      damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ (1 << bit % 8));
      const auto read = unpacked_chunk(damaged, bytes.size(), packing);
      // What does not change the bytes is no damage.
      unnoticed += read && *read != bytes ? 1 : 0;
    }
    EXPECT_EQ(unnoticed, 0);
    for (std::size_t length = 0; length < file.size(); ++length)
      EXPECT_EQ(unpacked_chunk(file.substr(0, length), bytes.size(), packing), std::nullopt);
    EXPECT_EQ(unpacked_chunk(file + "x", bytes.size(), packing), std::nullopt);
  }
}

/// The check value of CRC-32C for the nine digits, as catalogues of checksums have it: E3069283.
TEST(ChunkPacking, ItsChecksumIsCastagnolis) {
  EXPECT_EQ(packed_chunk("123456789", ChunkPacking::checksum), "123456789\x83\x92\x06\xE3");
}

}  // namespace
}  // namespace holdfast::program
