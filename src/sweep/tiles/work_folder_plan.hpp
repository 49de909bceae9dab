#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "io/file/folder_lock.hpp"
#include "sweep/tiles/tile_plan.hpp"

namespace holdfast::program {

/// Makes a work folder for the plan, or goes on with the one that is there, and holds it. Leftovers
/// of killed processes are removed; the plan is in its file then.
///
/// Throws as TileStore::open() does; what lies in the folder is as it was then.
FolderLock enter_work_folder(const std::filesystem::path& folder, const TilePlan& plan,
                             bool resume);

/// Throws WrongInput where the folder does not have that plan.
void require_plan_of_work_folder(const std::filesystem::path& folder, const TilePlan& plan);

/// "1 finished tile", "12 finished tiles".
std::string finished_tiles(std::int64_t tiles);

}  // namespace holdfast::program
