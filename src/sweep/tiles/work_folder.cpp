#include "sweep/tiles/work_folder.hpp"

#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <system_error>

#include "io/file/folder_lock.hpp"
#include "io/file/whole_file.hpp"
#include "process/errors.hpp"

namespace holdfast::program {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view tile_beginning = "tile-";
constexpr std::size_t tile_digits = 12;

bool is_leftover(const std::string& name) {
  const std::optional<std::string> target = name_behind_temporary(name);
  return target && (*target == plan_file_name || tile_of_file_name(*target));
}

/// Gives how many were removed: a folder that changes while it is read may hide some at first.
std::int64_t remove_tiles_and_leftovers(const fs::path& folder, std::int64_t tiles) {
  std::int64_t removed = 0;
  std::error_code ignored;
  fs::directory_iterator entries(folder, ignored);
  while (entries != fs::directory_iterator()) {
    const fs::path file = entries->path();
    const std::string name = file.filename().string();
    const std::optional<std::int64_t> tile = tile_of_file_name(name);
    const bool ours = tile ? *tile < tiles : is_leftover(name);
    if (ours && unlink(file.c_str()) == 0) ++removed;
    entries.increment(ignored);
  }
  return removed;
}

}  // namespace

std::string tile_file_name(std::int64_t tile) {
  const std::string digits = std::to_string(tile);
  const std::size_t zeros = tile_digits - std::min(tile_digits, digits.size());
  return std::string(tile_beginning) + std::string(zeros, '0') + digits;
}

std::optional<std::int64_t> tile_of_file_name(std::string_view name) {
  const bool fits = name.size() == tile_beginning.size() + tile_digits &&
                    name.substr(0, tile_beginning.size()) == tile_beginning;
  if (!fits) return std::nullopt;
  std::int64_t tile = 0;
  std::from_chars(name.data() + tile_beginning.size(), name.data() + name.size(), tile);
  if (tile_file_name(tile) != name) return std::nullopt;
  return tile;
}

std::string finished_tiles(std::int64_t tiles) {
  return std::to_string(tiles) + (tiles == 1 ? " finished tile" : " finished tiles");
}

WorkFolderContents contents_of_work_folder(const fs::path& folder) {
  WorkFolderContents contents;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (tile_of_file_name(name)) {
      ++contents.tiles;
    } else if (is_leftover(name)) {
      contents.leftovers.push_back(entry.path());
    } else if (name != plan_file_name && name != FolderLock::file_name) {
      contents.others = true;
    }
  }
  return contents;
}

std::optional<TilePlan> plan_of_work_folder(const fs::path& folder) {
  int ignored = 0;
  const std::optional<std::string> text = read_whole_file(folder / plan_file_name, ignored);
  return text ? parse_tile_plan(*text) : std::nullopt;
}

void remove_held_work_folder(const fs::path& folder) {
  const std::optional<TilePlan> plan = plan_of_work_folder(folder);
  while (plan && remove_tiles_and_leftovers(folder, plan->tiles) > 0) continue;
  if (plan) unlink((folder / plan_file_name).c_str());
  const fs::path lock = folder / FolderLock::file_name;
  std::error_code ignored;
  if (fs::is_regular_file(fs::symlink_status(lock, ignored)) && fs::is_empty(lock, ignored))
    unlink(lock.c_str());
  rmdir(folder.c_str());
}

void remove_work_folder(const fs::path& folder) {
  if (!plan_of_work_folder(folder)) return;
  try {
    const FolderLock held(folder);
    remove_held_work_folder(folder);
  } catch (const Refusal&) {
    // Another program holds it, or it cannot be written: it stays.
  }
}

}  // namespace holdfast::program
