#include "io/text/checksum.hpp"

#include <array>

namespace holdfast::program {
namespace {

using Remainders = std::array<std::uint64_t, 256>;

/// What eight steps of the division make of a register that holds one byte.
constexpr Remainders remainders_of_bytes() {
  constexpr std::uint64_t polynomial = 0xC96C5795D7870F42;  // lowest bit for the highest power
  Remainders remainders{};
  for (std::size_t byte = 0; byte < remainders.size(); ++byte) {
    std::uint64_t remainder = byte;
    for (int bit = 0; bit < 8; ++bit) {
      remainder = (remainder >> 1) ^ ((remainder & 1) != 0 ? polynomial : 0);
    }
    remainders[byte] = remainder;
  }
  return remainders;
}

constexpr Remainders remainders = remainders_of_bytes();

}  // namespace

std::uint64_t checksum(std::string_view bytes, std::uint64_t of_bytes_before) {
  std::uint64_t remainder = ~of_bytes_before;
  for (const char character : bytes) {
    const auto byte = static_cast<unsigned char>(character);
    remainder = remainders[(remainder ^ byte) & 0xFF] ^ (remainder >> 8);
  }
  return ~remainder;
}

}  // namespace holdfast::program
