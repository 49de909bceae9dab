#include "text/checksum.hpp"

#include <array>

namespace holdfast::program {
namespace {

/// Cyclic redundancy check with the register inverted at both ends; bits of a byte lowest first.
/// @tparam polynomial  coefficients of the polynomial, the lowest bit for the highest power
template <class Register, Register polynomial>
Register check_of(std::string_view bytes, Register of_bytes_before) {
  // Remainders after eight steps of the division, for a register that holds one byte.
  static constexpr std::array<Register, 256> remainders = [] {
    std::array<Register, 256> all{};
    for (std::size_t byte = 0; byte < all.size(); ++byte) {
      auto remainder = static_cast<Register>(byte);
      for (int bit = 0; bit < 8; ++bit)
        remainder = (remainder >> 1U) ^ ((remainder & 1U) != 0 ? polynomial : 0U);
      all[byte] = remainder;
    }
    return all;
  }();
  Register remainder = ~of_bytes_before;
  for (const char character : bytes)
    remainder =
        remainders[(remainder ^ static_cast<unsigned char>(character)) & 0xFFU] ^ (remainder >> 8U);
  return ~remainder;
}

}  // namespace

std::uint64_t checksum(std::string_view bytes, std::uint64_t of_bytes_before) {
  return check_of<std::uint64_t, 0xC96C5795D7870F42>(bytes, of_bytes_before);
}

std::uint32_t crc32c(std::string_view bytes) {
  return check_of<std::uint32_t, 0x82F63B78>(bytes, 0);
}

}  // namespace holdfast::program
