#include "store/chunk_packing.hpp"

#include "process/errors.hpp"
#include "support/testing.hpp"

namespace holdfast::program {
namespace {

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
