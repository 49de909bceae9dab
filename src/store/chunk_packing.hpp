#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace holdfast::program {

/// How the bytes of a chunk lie in its file: as codecs of Zarr that notice damage.
enum class ChunkPacking {
  zstd,      ///< Zstandard with the checksum of its content
  checksum,  ///< as they are, and the CRC-32C of them behind
};

/// Zstandard, or where the program is built without it the checksum alone.
ChunkPacking usual_packing();

/// The level of compression, a balance for numbers that hardly repeat.
inline constexpr int zstd_level = 1;

/// The file of a chunk: the same bytes give the same file. Throws std::bad_alloc, and NoAnswer,
/// which names the package, where the program cannot pack so.
std::string packed_chunk(std::string_view bytes, ChunkPacking packing);

/// The bytes of a file; nothing where they are not `size` ones, or damaged. Throws as above.
std::optional<std::string> unpacked_chunk(std::string_view file, std::size_t size,
                                          ChunkPacking packing);

}  // namespace holdfast::program
