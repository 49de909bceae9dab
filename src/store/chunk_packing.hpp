#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace holdfast::program {

/// How the bytes of a chunk lie in its file: as codecs of Zarr that notice damage.
enum class ChunkPacking {
  zstd,      ///< Zstandard with the checksum of its content, and a seal that says where it belongs
  checksum,  ///< as they are, and the CRC-32C of them behind; where they belong is not in it
};

/// Zstandard, or where the program is built without it the checksum alone.
ChunkPacking usual_packing();

/// The level of compression, a balance for numbers that hardly repeat.
inline constexpr int zstd_level = 1;

/// The file of a chunk: the same bytes at the same place give the same file. Its seal, the
/// CRC-64/XZ of place and bytes, is a skippable frame behind that of the bytes, over which every
/// reader of Zstandard passes (RFC 8878, 3.1.2).
/// @param place  names the chunk among all others of all stores
/// Throws std::bad_alloc, and NoAnswer, which names the package, where the program cannot pack so.
std::string packed_chunk(std::string_view bytes, ChunkPacking packing, std::string_view place = "");

/// The bytes of a file; nothing where they are not `size` ones, damaged, or those of another place.
/// Throws as above.
std::optional<std::string> unpacked_chunk(std::string_view file, std::size_t size,
                                          ChunkPacking packing, std::string_view place = "");

}  // namespace holdfast::program
