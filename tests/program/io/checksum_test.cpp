#include "text/checksum.hpp"

#include "support/testing.hpp"

namespace holdfast::program {
namespace {

std::string random_bytes(std::mt19937& random, std::size_t size) {
  std::uniform_int_distribution<int> byte(0, 255);
  std::string bytes;
  for (std::size_t i = 0; i < size; ++i) bytes += static_cast<char>(byte(random));
  return bytes;
}

/// The division written out bit by bit, highest power first, on reflected bytes.
std::uint64_t checksum_by_long_division(const std::string& bytes) {
  constexpr std::uint64_t polynomial = 0x42F0E1EBA9EA3693;  // as ECMA-182 prints it
  std::uint64_t remainder = ~std::uint64_t{0};
  for (const char character : bytes) {
    for (int bit = 0; bit < 8; ++bit) {
      const auto next =
          static_cast<std::uint64_t>(static_cast<unsigned char>(character) >> bit & 1);
      const std::uint64_t top = remainder >> 63;
      remainder = (remainder << 1) ^ (top != next ? polynomial : 0);
    }
  }
  std::uint64_t reflected = 0;
  for (int bit = 0; bit < 64; ++bit) reflected |= (remainder >> bit & 1) << (63 - bit);
  return ~reflected;
}

TEST(Checksum, HasThePublishedCheckValue) {
  // Catalogue of parametrised CRC algorithms, CRC-64/XZ.
  EXPECT_EQ(checksum("123456789"), 0x995DC9BBDF1939FA);
  EXPECT_EQ(checksum(""), 0U);
}

TEST(Checksum, IsTheRemainderOfALongDivision) {
  std::mt19937 random(1);
  for (std::size_t size = 0; size < 70; ++size) {
    const std::string bytes = random_bytes(random, size);
    EXPECT_EQ(checksum(bytes), checksum_by_long_division(bytes)) << size;
  }
}

TEST(Checksum, GoesOnFromThePartBefore) {
  std::mt19937 random(2);
  const std::string bytes = random_bytes(random, 100);
  for (std::size_t cut = 0; cut <= bytes.size(); ++cut) {
    EXPECT_EQ(checksum(bytes.substr(cut), checksum(bytes.substr(0, cut))), checksum(bytes));
  }
}

}  // namespace
}  // namespace holdfast::program
