#include "sweep/tiles/tile_file.hpp"

#include <array>
#include <cstring>

#include "io/text/checksum.hpp"
#include "process/errors.hpp"

namespace holdfast::program {
namespace {

constexpr std::string_view magic = "holdtile";
constexpr std::uint64_t format = 1;
constexpr std::size_t number_size = 8;
constexpr std::size_t head_size = magic.size() + 5 * number_size;

void append_number(std::string& bytes, std::uint64_t number) {
  for (std::size_t i = 0; i < number_size; ++i) {
    bytes += static_cast<char>(static_cast<unsigned char>(number >> (8 * i)));
  }
}

std::string head(const TileLabel& label, std::string_view content) {
  std::string bytes(magic);
  append_number(bytes, format);
  append_number(bytes, label.plan);
  append_number(bytes, static_cast<std::uint64_t>(label.tile));
  append_number(bytes, content.size());
  append_number(bytes, checksum(content, checksum(bytes)));
  return bytes;
}

using Counts = std::array<std::int64_t, 4>;

void append_bytes(std::string& bytes, const void* from, std::size_t size) {
  bytes.append(static_cast<const char*>(from), size);
}

}  // namespace

std::string tile_file(const TileLabel& label, std::string_view content) {
  return head(label, content).append(content);
}

std::optional<std::string_view> tile_content(const TileLabel& label, std::string_view file) {
  if (file.size() < head_size) return std::nullopt;
  const std::string_view content = file.substr(head_size);
  if (file.substr(0, head_size) != head(label, content)) return std::nullopt;
  return content;
}

std::string tile_bytes(const TileResult& tile) {
  const Counts counts = {tile.cells, tile.samples, tile.diverging, tile.without_motion};
  std::string bytes;
  bytes.reserve(sizeof(counts) + tile.values.size() * sizeof(double) + tile.first_fault.size());
  append_bytes(bytes, counts.data(), sizeof(counts));
  append_bytes(bytes, tile.values.data(), tile.values.size() * sizeof(double));
  return bytes + tile.first_fault;
}

TileResult tile_of_bytes(std::string_view bytes, std::int64_t cells, std::size_t columns) {
  Counts counts{};
  const std::size_t values = static_cast<std::size_t>(cells) * columns;
  const std::size_t size = sizeof(counts) + values * sizeof(double);
  if (bytes.size() >= size) std::memcpy(counts.data(), bytes.data(), sizeof(counts));
  if (bytes.size() < size || counts[0] != cells)
    throw OutputError("a finished tile does not hold what the sweep needs");
  TileResult tile{cells,     std::vector<double>(values),    counts[1], counts[2],
                  counts[3], std::string(bytes.substr(size))};
  if (values > 0)  // of none, data() may be null, which memcpy does not take
    std::memcpy(tile.values.data(), bytes.data() + sizeof(counts), values * sizeof(double));
  return tile;
}

}  // namespace holdfast::program
