#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

#include "fuzz/require.hpp"
#include "io/file/whole_file.hpp"
#include "store/chunk_packing.hpp"
#include "store/store_description.hpp"

namespace {

using namespace holdfast::program;
using holdfast::fuzz::require;

void read_as_root(std::string_view text) {
  try {
    const StoreDescription store = read_description(text);
    const std::int64_t last = store.grid.chunks() - 1;
    require(store.grid.first_cell(last) + store.grid.cells_of(last) == store.grid.cells(),
            "the last chunk ends with the last cell");
    require(plan_differences(store.plan, store.plan).empty(), "a plan does not differ from itself");
  } catch (const std::invalid_argument&) {
    // No root of a store.
  }
}

void read_as_chunk(std::string_view bytes) {
  const std::string file = packed_chunk(bytes, usual_packing());
  require(unpacked_chunk(file, bytes.size(), usual_packing()) == std::string(bytes),
          "a chunk has the bytes that were put into it");
  unpacked_chunk(bytes, bytes.size() / 2, usual_packing());
  unpacked_chunk(bytes, 4096, ChunkPacking::checksum);
}

}  // namespace

/// Any bytes as each of the things that lie in a store.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  read_as_root(bytes);
  read_as_chunk(bytes);
  name_behind_temporary(bytes);
  return 0;
}
