#include "sweep/tiles/tile_store.hpp"

#include <cerrno>
#include <new>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "io/file/whole_file.hpp"
#include "process/errors.hpp"
#include "process/system_words.hpp"
#include "sweep/tiles/work_folder.hpp"

namespace holdfast::program {
namespace fs = std::filesystem;

namespace {

[[noreturn]] void refuse_to_read(const fs::path& path, int error) {
  // A machine without memory is not a wrong input.
  if (error == ENOMEM) throw std::bad_alloc();
  throw WrongInput("cannot read " + path.string() + ": " + system_words(error));
}

/// The text of the folder's plan; nothing where there is no such file.
std::optional<std::string> read_plan(const fs::path& folder) {
  int error = 0;
  std::optional<std::string> text = read_whole_file(folder / plan_file_name, error);
  if (!text && error != ENOENT) refuse_to_read(folder / plan_file_name, error);
  return text;
}

WorkFolderContents read_contents(const fs::path& folder) {
  try {
    return contents_of_work_folder(folder);
  } catch (const fs::filesystem_error& error) {
    refuse_to_read(folder, error.code().value());
  }
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directory(folder, error);
  if (error) refuse_to_write(folder, error.value());
}

/// Looks before anything is laid into the folder. A plan without tiles will be replaced, which must
/// not befall another program's file of that name.
void require_work_folder(const fs::path& folder) {
  const std::optional<std::string> text = read_plan(folder);
  if (text && (text->empty() || begins_as_tile_plan(*text))) return;
  const WorkFolderContents contents = read_contents(folder);
  if (contents.tiles > 0) return;
  const std::string refusal = folder.string() + " is no work folder: ";
  if (text) throw WrongInput(refusal + "its file " + plan_file_name + " is of another kind");
  if (contents.others) throw WrongInput(refusal + "it holds other files and no plan");
}

void require_same_plan(const fs::path& folder, const TilePlan& before, const TilePlan& now) {
  const std::string differences = tile_plan_differences(before, now);
  if (differences.empty()) return;
  throw WrongInput("the tiles in " + folder.string() + " are of another sweep: " + differences +
                   "; give the same options, another --output, or remove the folder");
}

void require_tiles_of_plan(const fs::path& folder, std::int64_t tiles, const TilePlan& plan,
                           bool resume) {
  const std::string held = folder.string() + " holds " + finished_tiles(tiles);
  if (!resume) {
    throw WrongInput(held +
                     " of an interrupted sweep; go on with --resume, or remove the folder to "
                     "begin anew");
  }
  const std::optional<std::string> text = read_plan(folder);
  const std::optional<TilePlan> before = text ? parse_tile_plan(*text) : std::nullopt;
  if (!before) {
    throw WrongInput(held + ", but its plan is " + (text ? "damaged" : "missing") +
                     "; remove the folder to begin anew");
  }
  require_same_plan(folder, *before, plan);
}

void write_plan(const fs::path& folder, const TilePlan& plan) {
  const fs::path file = folder / plan_file_name;
  const int error = write_whole_file(file, tile_plan_text(plan));
  if (error == 0) return;
  remove_held_work_folder(folder);
  refuse_to_write(file, error);
}

/// Makes a work folder for the plan, or goes on with the one that is there, and holds it. Leftovers
/// of killed processes are removed; the plan is in its file then.
FolderLock enter_work_folder(const fs::path& folder, const TilePlan& plan, bool resume) {
  make_folder(folder);
  require_work_folder(folder);
  FolderLock lock(folder);
  // Read again: until here another program may have held the folder.
  const WorkFolderContents contents = read_contents(folder);
  if (contents.tiles > 0) require_tiles_of_plan(folder, contents.tiles, plan, resume);
  std::error_code ignored;
  for (const fs::path& leftover : contents.leftovers) fs::remove(leftover, ignored);
  if (contents.tiles == 0) write_plan(folder, plan);
  return lock;
}

}  // namespace

TileStore::TileStore(fs::path folder, const TilePlan& plan, std::optional<FolderLock> lock)
    : folder_(std::move(folder)),
      identity_(tile_plan_identity(plan)),
      lock_(std::move(lock)),
      mutex_(std::make_unique<std::mutex>()),
      whole_(static_cast<std::size_t>(plan.tiles)) {}

TileStore TileStore::open(const fs::path& folder, const TilePlan& plan, bool resume) {
  return {folder, plan, enter_work_folder(folder, plan, resume)};
}

TileStore TileStore::join(const fs::path& folder, const TilePlan& plan) {
  const std::optional<std::string> text = read_plan(folder);
  if (!text) {
    throw WrongInput("no plan in " + folder.string() +
                     "; all processes need a file system that they share");
  }
  const std::optional<TilePlan> before = parse_tile_plan(*text);
  if (!before) throw WrongInput("the plan of " + folder.string() + " is damaged");
  require_same_plan(folder, *before, plan);
  return {folder, plan, std::nullopt};
}

TileLabel TileStore::label_of(std::int64_t tile) const {
  if (tile < 0 || static_cast<std::size_t>(tile) >= whole_.size())
    throw std::out_of_range("no such tile in the plan");
  return {identity_, tile};
}

bool TileStore::known_whole(std::int64_t tile) const {
  const std::lock_guard<std::mutex> guard(*mutex_);
  return whole_[static_cast<std::size_t>(tile)];
}

void TileStore::set_known_whole(std::int64_t tile, bool whole) const {
  const std::lock_guard<std::mutex> guard(*mutex_);
  whole_[static_cast<std::size_t>(tile)] = whole;
}

bool TileStore::has(std::int64_t tile) const {
  const TileLabel label = label_of(tile);
  if (known_whole(tile)) return true;
  int ignored = 0;  // a file that cannot be read is as good as none
  const std::optional<std::string> file = read_whole_file(folder_ / tile_file_name(tile), ignored);
  const bool whole = file && tile_content(label, *file);
  if (whole) set_known_whole(tile, true);
  return whole;
}

void TileStore::put(std::int64_t tile, std::string_view bytes) const {
  const TileLabel label = label_of(tile);
  const fs::path file = folder_ / tile_file_name(tile);
  const int error = write_whole_file(file, tile_file(label, bytes));
  if (error != 0) {
    throw OutputError("cannot write " + file.string() + ": " + system_words(error));
  }
  set_known_whole(tile, true);
}

std::string TileStore::get(std::int64_t tile) const {
  const TileLabel label = label_of(tile);
  const fs::path path = folder_ / tile_file_name(tile);
  int error = 0;
  const std::optional<std::string> file = read_whole_file(path, error);
  const std::optional<std::string_view> content = file ? tile_content(label, *file) : std::nullopt;
  if (content) return std::string(*content);
  set_known_whole(tile, false);
  const std::string why = file ? "it is damaged, or of another sweep" : system_words(error);
  throw OutputError("cannot read " + path.string() + ": " + why);
}

void TileStore::remove() {
  remove_held_work_folder(folder_);
  lock_.reset();
  const std::lock_guard<std::mutex> guard(*mutex_);
  whole_.assign(whole_.size(), false);
}

}  // namespace holdfast::program
