#pragma once

#include <cstdint>
#include <string_view>

namespace holdfast::program {

/// The cyclic redundancy check CRC-64/XZ of the bytes: the remainder of the message by the
/// polynomial 0x42F0E1EBA9EA3693 of ECMA-182 over GF(2), bits of a byte lowest first, register
/// inverted at both ends. Two messages of one length that differ only within 64 neighbouring bits
/// always have different checksums, other messages with probability 1 − 2⁻⁶⁴.
///
/// `checksum(b, checksum(a))` is the checksum of a followed by b. Source: "The .xz File Format"
/// 1.0.4, section 6.
std::uint64_t checksum(std::string_view bytes, std::uint64_t of_bytes_before = 0);

/// The cyclic redundancy check CRC-32C (Castagnoli) of the Zarr codec crc32c and iSCSI (RFC 3720).
std::uint32_t crc32c(std::string_view bytes);

}  // namespace holdfast::program
