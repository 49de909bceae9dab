#include "sweep/tiles/tile_file.hpp"

#include "io/text/checksum.hpp"

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

}  // namespace holdfast::program
