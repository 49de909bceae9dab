#include <algorithm>
#include <array>
#include <cinttypes>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>

#include "fuzz/require.hpp"
#include "io/file/whole_file.hpp"
#include "io/text/checksum.hpp"
#include "process/errors.hpp"
#include "sweep/tiles/tile_file.hpp"
#include "sweep/tiles/tile_plan_file.hpp"
#include "sweep/tiles/work_folder.hpp"

namespace {

using namespace holdfast::program;
using holdfast::fuzz::require;

void read_as_plan(std::string_view text) {
  const auto plan = parse_tile_plan(text);
  if (!plan) return;
  require(tile_plan_text(*plan) == text, "a plan has one text");
  require(tile_plan_differences(*plan, *plan).empty(), "a plan does not differ from itself");
}

/// The text with the checksum that it should have: the fuzzer does not guess checksums.
std::string mended(const std::string& text) {
  std::array<char, 32> line{};
  std::snprintf(line.data(), line.size(), "checksum %016" PRIx64 "\n", checksum(text));
  return text + line.data();
}

/// Any text as the entries of a plan.
void write_as_plan(std::string_view text) {
  TilePlan plan;
  plan.tiles = static_cast<std::int64_t>(text.size());
  const std::size_t half = text.size() / 2;
  plan.entries.emplace(text.substr(0, half), text.substr(half));
  const std::string written = tile_plan_text(plan);
  const auto again = parse_tile_plan(written);
  require(again && again->entries == plan.entries && again->tiles == plan.tiles,
          "a plan that was written reads as the same plan");
}

void read_as_tile(std::string_view bytes) {
  const TileLabel label{bytes.size(), 3};
  require(!tile_content(label, bytes) || bytes.substr(0, 8) == "holdtile", "a tile has its head");
  const std::string file = tile_file(label, bytes);
  const auto content = tile_content(label, file);
  require(content && *content == bytes, "the content of a tile is that which was put into it");
  require(!tile_content({label.plan, 4}, file), "a tile is not another one");
}

void read_as_result(std::string_view bytes) {
  const std::int64_t cells =
      bytes.empty() ? 1 : std::max<int>(1, static_cast<unsigned char>(bytes[0]));
  try {
    const TileResult tile = tile_of_bytes(bytes, cells, 3);
    require(tile_bytes(tile) == bytes, "a result that was read is written as it was");
  } catch (const OutputError&) {
    // Not the bytes of a result.
  }
}

void read_as_name(const std::string& name) {
  if (const auto tile = tile_of_file_name(name))
    require(tile_file_name(*tile) == name, "a tile has one name");
  name_behind_temporary(name);
}

}  // namespace

/// Any bytes as each of the things that lie in a work folder.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  read_as_plan(bytes);
  read_as_plan(mended(bytes));
  write_as_plan(bytes);
  read_as_tile(bytes);
  read_as_result(bytes);
  read_as_name(bytes);
  return 0;
}
