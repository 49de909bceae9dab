#include "store/chunk_packing.hpp"

#include <cstdint>
#include <memory>
#include <new>

#include "process/errors.hpp"
#include "text/checksum.hpp"

#ifdef HOLDFAST_HAS_ZSTD
#include <zstd.h>
#endif

namespace holdfast::program {
namespace {

/// Bytes of a number in little-endian order, as the codecs require.
template <class Number>
std::string bytes_of(Number number) {
  std::string bytes;
  for (std::size_t k = 0; k < sizeof(Number); ++k)
    bytes += static_cast<char>(number >> (8 * k) & 0xFFU);
  return bytes;
}

std::optional<std::string> without_checksum(std::string_view file, std::size_t size) {
  if (file.size() != size + 4) return std::nullopt;
  const std::string_view bytes = file.substr(0, size);
  if (file.substr(size) != bytes_of(crc32c(bytes))) return std::nullopt;
  return std::string(bytes);
}

#ifdef HOLDFAST_HAS_ZSTD

std::string compressed(std::string_view bytes) {
  const std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> context(ZSTD_createCCtx(),
                                                                     &ZSTD_freeCCtx);
  if (!context) throw std::bad_alloc();
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_compressionLevel, zstd_level);
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_checksumFlag, 1);
  std::string file(ZSTD_compressBound(bytes.size()), '\0');
  const std::size_t length =
      ZSTD_compress2(context.get(), file.data(), file.size(), bytes.data(), bytes.size());
  if (ZSTD_isError(length) != 0) throw std::bad_alloc();
  file.resize(length);
  return file;
}

std::optional<std::string> expanded(std::string_view file, std::size_t size) {
  // Checked first, so that a damaged size allocates no memory.
  if (ZSTD_getFrameContentSize(file.data(), file.size()) != size) return std::nullopt;
  std::string bytes(size, '\0');
  if (ZSTD_decompress(bytes.data(), size, file.data(), file.size()) != size) return std::nullopt;
  return bytes;
}

#else

[[noreturn]] void refuse_zstd() {
  throw NoAnswer(
      "chunks compressed by Zstandard need a program built with it: install libzstd-dev and build "
      "again");
}
std::string compressed(std::string_view) { refuse_zstd(); }
std::optional<std::string> expanded(std::string_view, std::size_t) { refuse_zstd(); }

#endif

constexpr std::uint32_t skippable_frame = 0x184D2A50U;

std::string seal_of(std::string_view bytes, std::string_view place) {
  const std::string sum = bytes_of(checksum(bytes, checksum(place)));
  return bytes_of(skippable_frame) + bytes_of(static_cast<std::uint32_t>(sum.size())) + sum;
}

std::optional<std::string> unsealed(std::string_view file, std::size_t size,
                                    std::string_view place) {
  const std::size_t length = seal_of("", "").size();
  if (file.size() < length) return std::nullopt;
  std::optional<std::string> bytes = expanded(file.substr(0, file.size() - length), size);
  if (bytes && file.substr(file.size() - length) != seal_of(*bytes, place)) return std::nullopt;
  return bytes;
}

}  // namespace

ChunkPacking usual_packing() {
#ifdef HOLDFAST_HAS_ZSTD
  return ChunkPacking::zstd;
#else
  return ChunkPacking::checksum;
#endif
}

std::string packed_chunk(std::string_view bytes, ChunkPacking packing, std::string_view place) {
  if (packing == ChunkPacking::zstd) return compressed(bytes) + seal_of(bytes, place);
  return std::string(bytes) + bytes_of(crc32c(bytes));
}

std::optional<std::string> unpacked_chunk(std::string_view file, std::size_t size,
                                          ChunkPacking packing, std::string_view place) {
  return packing == ChunkPacking::zstd ? unsealed(file, size, place) : without_checksum(file, size);
}

}  // namespace holdfast::program
