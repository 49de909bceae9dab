#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace holdfast::program {

/// Encoding of a chunk's bytes in its file, by Zarr codecs that detect damage.
enum class ChunkPacking {
  zstd,      ///< Zstandard with a checksum of the content, and a seal that identifies the chunk
  checksum,  ///< plain bytes followed by their CRC-32C; the chunk is not identified
};

/// Default packing: Zstandard, or the checksum alone in a program built without Zstandard.
ChunkPacking usual_packing();

/// Compression level of Zstandard, a balance of time and size for numbers that hardly repeat.
inline constexpr int zstd_level = 1;

/// Content of a chunk's file; equal bytes at an equal place give equal files. With Zstandard a
/// seal, the CRC-64/XZ of place and bytes, follows as a skippable frame, which every reader of
/// Zstandard ignores (RFC 8878, 3.1.2).
/// @param place  name of the chunk, unique among all chunks of all stores
/// Throws std::bad_alloc, or NoAnswer, naming the package, if the program lacks Zstandard.
std::string packed_chunk(std::string_view bytes, ChunkPacking packing, std::string_view place = "");

/// The bytes of a chunk from its file; nullopt if the file is damaged, has not `size` bytes or,
/// with Zstandard, belongs to another place. Throws the exceptions of packed_chunk().
std::optional<std::string> unpacked_chunk(std::string_view file, std::size_t size,
                                          ChunkPacking packing, std::string_view place = "");

}  // namespace holdfast::program
