#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace holdfast::program {

/// What the tiles of a work folder are parts of.
struct TilePlan {
  /// Everything that the bytes of a tile depend on, name and text: {"version", "0.6.0"},
  /// {"--axis 1", "backlash.width=0:0.003:61"}. The names differ from each other; the order of the
  /// entries means nothing.
  std::vector<std::pair<std::string, std::string>> entries;
  std::int64_t tiles = 0;  ///< numbered 0 … tiles − 1
};

}  // namespace holdfast::program
