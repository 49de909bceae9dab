#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sweep/tiles/tile_plan_file.hpp"

namespace holdfast::program {

/// The name of the file of a tile, 0 … 10¹² − 1: `tile-000000001234`.
std::string tile_file_name(std::int64_t tile);

/// The number of the tile whose file has that name; nothing for another file's name.
std::optional<std::int64_t> tile_of_file_name(std::string_view name);

/// The name of the file that says what the tiles of a work folder are parts of.
inline constexpr const char* plan_file_name = "plan";

/// What lies in a work folder, by name.
struct WorkFolderContents {
  std::int64_t tiles = 0;
  std::vector<std::filesystem::path> leftovers;  ///< temporary files of a process that was killed
  bool others = false;                           ///< anything that no work folder has
};

/// "1 finished tile", "12 finished tiles".
std::string finished_tiles(std::int64_t tiles);

/// Throws std::filesystem::filesystem_error where the folder cannot be read.
WorkFolderContents contents_of_work_folder(const std::filesystem::path& folder);

/// The plan in a folder; nothing where there is no whole one.
std::optional<TilePlan> plan_of_work_folder(const std::filesystem::path& folder);

/// Removes from a work folder that no other program holds what is its own: the tiles that its plan
/// counts, their leftovers, the plan and the lock; and then the folder where nothing else lies in
/// it. Without a plan that bears its checksum nothing is known to be its own, and all stays. What
/// cannot be removed stays.
void remove_work_folder(const std::filesystem::path& folder);

/// The same by the program that holds the folder.
void remove_held_work_folder(const std::filesystem::path& folder);

}  // namespace holdfast::program
