#include "store/store_folder.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <limits>
#include <new>
#include <stdexcept>

#include "io/file/folder_lock.hpp"
#include "io/file/whole_file.hpp"
#include "output/grid/grid_attributes.hpp"
#include "process/errors.hpp"
#include "process/interrupt.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

namespace fs = std::filesystem;

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "a store's numbers are little-endian");

/// Calls `call` with the fill value of an array, whose type is the array's number type.
template <class Call>
auto with_fill(ElementType type, const Call& call) {
  if (type == ElementType::byte) return call(std::int8_t{-1});
  if (type == ElementType::integer) return call(std::numeric_limits<std::int64_t>::min());
  return call(std::numeric_limits<double>::quiet_NaN());
}

/// The bytes of a file of `count` cells; cells beyond the values have the fill value.
std::string bytes_of(const std::vector<double>& values, std::size_t count, ElementType type) {
  return with_fill(type, [&](auto fill) {
    std::vector<decltype(fill)> numbers(count, fill);
    std::transform(values.begin(), values.end(), numbers.begin(),
                   [](double value) { return static_cast<decltype(fill)>(value); });
    return std::string(reinterpret_cast<const char*>(numbers.data()), count * sizeof fill);
  });
}

std::vector<double> values_of(const std::string& bytes, std::size_t count, ElementType type) {
  return with_fill(type, [&](auto fill) {
    std::vector<decltype(fill)> numbers(count);
    std::memcpy(numbers.data(), bytes.data(), count * sizeof fill);
    return std::vector<double>(numbers.begin(), numbers.end());
  });
}

/// Whether every value is one that the column may have.
bool fit(const CellColumn& column, const std::vector<double>& values) {
  if (column.words.empty()) return true;
  return std::all_of(values.begin(), values.end(), [&](double value) {
    return value >= 0.0 && value < static_cast<double>(column.words.size());
  });
}

void write_file(const fs::path& file, std::string_view bytes) {
  std::error_code failure;
  fs::create_directories(file.parent_path(), failure);
  if (failure) refuse_to_write(file.parent_path(), failure.value());
  const int error = write_whole_file(file, bytes);
  if (error != 0) refuse_to_write(file, error);
}

[[noreturn]] void refuse_to_look_into(const fs::path& folder, int error) {
  if (error == ENOMEM) throw std::bad_alloc();
  refuse_to_read(folder, system_words(error));
}

/// Text of the root file; nullopt if there is none.
std::optional<std::string> root_text(const fs::path& folder) {
  int error = 0;
  std::optional<std::string> text = read_whole_file(folder / store_root, error);
  if (!text && error != ENOENT && error != ENOTDIR) refuse_to_look_into(folder, error);
  return text;
}

bool holds_nothing_but(const fs::path& folder, const std::vector<std::string>& known) {
  std::error_code error;
  if (fs::is_symlink(folder, error)) return false;
  fs::directory_iterator entries(folder, error);
  if (error == std::errc::no_such_file_or_directory) return true;
  if (error == std::errc::not_a_directory) return false;
  if (error) refuse_to_look_into(folder, error.value());
  for (const fs::directory_entry& entry : entries) {
    const std::string name = entry.path().filename().string();
    if (std::count(known.begin(), known.end(), name) == 0 && !name_behind_temporary(name))
      return false;
  }
  return true;
}

/// Whether the folder is empty, or has only leftovers of a store without root and chunks. Chunks
/// without a root cannot be assigned to a computation.
bool may_begin_store(const fs::path& folder, const StoreDescription& description) {
  const std::vector<StoreArray> arrays = arrays_of(description);
  std::vector<std::string> known = {FolderLock::file_name};
  for (std::size_t k = 0; k < arrays.size(); ++k) {
    known.push_back(arrays[k].name);
    if (k >= description.axes.size() && !holds_nothing_but(folder / arrays[k].name, {store_root}))
      return false;
  }
  return holds_nothing_but(folder, known);
}

/// Documents without the root, which has its own checksum.
auto documents_but_root(const StoreDescription& store) {
  auto documents = store_documents(store);
  documents.pop_back();
  return documents;
}

/// Name of the root file of a store that is being removed.
constexpr const char* removed_root = ".removed";

/// Description in the text of a root file; nullopt if holdfast did not write it.
std::optional<StoreDescription> description_in(const std::string& root) {
  try {
    return read_description(root);
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
}

/// Description of a store whose removal was interrupted; nullopt if there is none.
std::optional<StoreDescription> removed_store_in(const fs::path& folder) {
  int error = 0;
  const std::optional<std::string> text = read_whole_file(folder / removed_root, error);
  if (!text) return std::nullopt;
  return description_in(*text);
}

/// Whether the text is a number below `end` as in file names: no sign, no leading zeros.
bool is_index_below(std::string_view text, std::size_t end) {
  std::size_t number = 0;
  const auto [rest, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
  return fault == std::errc() && number < end && std::to_string(number) == text &&
         rest == text.data() + text.size();
}

/// Whether a file name is that of a chunk, `c.4.0`.
bool is_chunk_name(std::string_view name, const ChunkGrid& grid) {
  std::vector<std::string_view> parts = split(name, '.');
  if (parts.front() != "c") return false;
  parts.erase(parts.begin());
  if (parts.size() != grid.shape.size()) return false;
  for (std::size_t axis = 0; axis < parts.size(); ++axis)
    if (!is_index_below(parts[axis], static_cast<std::size_t>(grid.along(axis)))) return false;
  return true;
}

[[noreturn]] void refuse_link(const fs::path& path) {
  throw WrongInput("cannot write " + path.string() +
                   ": it is a symbolic link, which holdfast does not follow; remove the link");
}

[[noreturn]] void refuse_folder(const fs::path& folder) {
  throw WrongInput("cannot write " + folder.string() +
                   ": this name exists and is no store; give another name");
}

void require_same_plan(const fs::path& folder, const StoreDescription& before,
                       const StoreDescription& now) {
  const std::string differences = plan_differences(before.plan, now.plan);
  if (!differences.empty())
    throw WrongInput(folder.string() + " holds the cells of another computation: " + differences +
                     "; give the same options, another --output, or remove the folder");
}

}  // namespace

std::optional<StoreDescription> store_in(const fs::path& folder) {
  const std::optional<std::string> text = root_text(folder);
  return text ? description_in(*text) : std::nullopt;
}

StoreFolder StoreFolder::enter(const fs::path& folder, const StoreDescription& description) {
  StoreFolder store(folder, description);
  store.refuse_links();
  std::optional<StoreDescription> there = store_in(folder);
  if (!there) {
    remove_store(folder);
    if (may_begin_store(folder, description)) store.begin();
    // Read again: another process may have created a store meanwhile, this one or another.
    there = store_in(folder);
  }
  if (!there) refuse_folder(folder);
  require_same_plan(folder, *there, description);
  store.description_.packing = there->packing;
  there->axes = description.axes;
  store.mend(documents_but_root(*there));
  return store;
}

StoreFolder StoreFolder::open(const fs::path& folder) {
  std::optional<StoreDescription> there = store_in(folder);
  if (!there)
    throw WrongInput(folder.string() +
                     " is no Zarr 3 store that holdfast has written; give the .zarr folder of one");
  StoreFolder store(folder, std::move(*there));
  store.read_axes();
  store.require(documents_but_root(store.description_));
  return store;
}

/// Refuses arrays behind links, which would be written elsewhere.
void StoreFolder::refuse_links() const {
  std::error_code error;
  for (const StoreArray& array : arrays_)
    if (fs::is_symlink(folder_ / array.name, error)) refuse_link(folder_ / array.name);
}

/// Writes axes and descriptions of a new store; on failure removes it if no other process began it.
void StoreFolder::begin() const {
  try {
    each_axis_file([&](std::size_t axis, std::int64_t chunk) {
      throw_if_interrupted();
      write_axis(axis, chunk);
    });
    for (const auto& [path, text] : store_documents(description_)) write_file(folder_ / path, text);
  } catch (...) {
    if (!store_in(folder_)) remove();
    throw;
  }
}

/// Seal of a file of the store: its name and the identity of the plan.
std::string StoreFolder::seal_of(const fs::path& file) const {
  return file.lexically_relative(folder_).generic_string() + " of " + identity_;
}

/// Packed content of an array's file; cells beyond the values have the fill value.
std::string StoreFolder::packed(const StoreArray& array, std::int64_t chunk,
                                const std::vector<double>& values) const {
  const auto count = static_cast<std::size_t>(array.grid.cells_of_file());
  return packed_chunk(bytes_of(values, count, array.type), description_.packing,
                      seal_of(file_of(array, chunk)));
}

/// Values in a file; nullopt if it is missing, damaged or unreadable.
std::optional<std::vector<double>> StoreFolder::values_in(const StoreArray& array,
                                                          std::int64_t chunk) const {
  const fs::path file = file_of(array, chunk);
  int ignored = 0;
  const std::optional<std::string> packed = read_whole_file(file, ignored);
  if (!packed) return std::nullopt;
  const auto count = static_cast<std::size_t>(array.grid.cells_of_file());
  const std::optional<std::string> bytes =
      unpacked_chunk(*packed, count * size_of(array.type), description_.packing, seal_of(file));
  if (!bytes) return std::nullopt;
  return values_of(*bytes, static_cast<std::size_t>(array.grid.cells_of(chunk)), array.type);
}

/// Calls `call(axis, chunk)` for every file of every axis.
template <class Call>
void StoreFolder::each_axis_file(const Call& call) const {
  for (std::size_t axis = 0; axis < description_.axes.size(); ++axis)
    for (std::int64_t chunk = 0; chunk < arrays_[axis].grid.chunks(); ++chunk) call(axis, chunk);
}

void StoreFolder::write_axis(std::size_t axis, std::int64_t chunk) const {
  const StoreArray& array = arrays_[axis];
  const auto first = static_cast<std::size_t>(array.grid.first_cell(chunk));
  std::vector<double> values(static_cast<std::size_t>(array.grid.cells_of(chunk)));
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = description_.axes[axis].at(first + i);
  write_file(file_of(array, chunk), packed(array, chunk, values));
}

/// Repairs damaged axes, and descriptions that differ from the given ones.
void StoreFolder::mend(const Documents& documents) const {
  each_axis_file([&](std::size_t axis, std::int64_t chunk) {
    if (!values_in(arrays_[axis], chunk)) write_axis(axis, chunk);
  });
  int ignored = 0;
  for (const auto& [path, text] : documents)
    if (read_whole_file(folder_ / path, ignored) != text) write_file(folder_ / path, text);
}

void StoreFolder::require(const Documents& documents) const {
  for (const auto& [path, text] : documents) {
    int error = 0;
    const std::optional<std::string> there = read_whole_file(folder_ / path, error);
    if (there != text)
      refuse_to_read(folder_ / path, there ? "it is damaged" : system_words(error));
  }
}

void StoreFolder::read_axes() {
  std::vector<std::vector<double>> values(description_.axes.size());
  each_axis_file([&](std::size_t axis, std::int64_t chunk) {
    const auto part = values_in(arrays_[axis], chunk);
    if (!part) refuse_to_read(file_of(arrays_[axis], chunk), "it is missing or damaged");
    values[axis].insert(values[axis].end(), part->begin(), part->end());
  });
  for (std::size_t axis = 0; axis < values.size(); ++axis)
    description_.axes[axis].values = std::move(values[axis]);
}

/// Path of a chunk's file. All files of an array are in one folder, which costs the system least.
fs::path StoreFolder::file_of(const StoreArray& array, std::int64_t chunk) const {
  if (chunk < 0 || chunk >= array.grid.chunks())
    throw std::out_of_range("no such chunk in the store");
  std::string file = "c";
  for (const std::int64_t index : array.grid.place(chunk)) file += "." + std::to_string(index);
  return folder_ / array.name / file;
}

bool StoreFolder::has(std::int64_t chunk) const {
  std::error_code error;
  return fs::is_regular_file(file_of(chunk), error);
}

std::optional<std::vector<double>> StoreFolder::read_column(std::size_t column,
                                                            std::int64_t chunk) const {
  auto values = values_in(array_of(column), chunk);
  return values && fit(description_.columns[column], *values) ? std::move(values) : std::nullopt;
}

std::optional<ChunkValues> StoreFolder::read(std::int64_t chunk) const {
  ChunkValues values;
  for (std::size_t column = 0; column < description_.columns.size(); ++column) {
    auto of_column = read_column(column, chunk);
    if (!of_column) return std::nullopt;
    values.push_back(std::move(*of_column));
  }
  return values;
}

void StoreFolder::put(std::int64_t chunk, const ChunkValues& values) const {
  for (std::size_t column = values.size(); column-- > 0;) {
    const fs::path file = file_of(array_of(column), chunk);
    std::error_code ignored;
    if (fs::is_symlink(file, ignored)) refuse_link(file);
    const int error = write_whole_file(file, packed(array_of(column), chunk, values[column]));
    if (error != 0) throw OutputError("cannot write " + file.string() + ": " + system_words(error));
  }
}

void StoreFolder::remove_leftovers(std::int64_t chunk) const {
  for (std::size_t column = 0; column < description_.columns.size(); ++column) {
    const fs::path file = file_of(array_of(column), chunk);
    const OwnFolder array(file.parent_path());
    if (!array.is_open()) continue;
    for (const std::string& name : array.names())
      if (name_behind_temporary(name) == file.filename().string()) array.remove_file(name);
  }
}

std::optional<std::int64_t> StoreFolder::chunks_done_in(const fs::path& folder) {
  std::optional<StoreDescription> there = store_in(folder);
  if (!there) return std::nullopt;
  return StoreFolder(folder, std::move(*there)).chunks_done();
}

std::int64_t StoreFolder::chunks_done() const {
  // Existing files are counted, since the number of chunks in a root file may be wrong.
  std::error_code error;
  std::int64_t done = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_ / array_of(0).name, error))
    if (is_chunk_name(entry.path().filename().string(), grid()) && entry.is_regular_file(error))
      ++done;
  return done;
}

/// Whether a name is one that holdfast gives in an array's folder: of a chunk, its claim, a
/// document, or a temporary file of these.
bool StoreFolder::gives(const std::string& name, const ChunkGrid& grid) const {
  constexpr std::string_view claim = ".claim";
  const std::string whole = name_behind_temporary(name).value_or(name);
  if (whole == store_root) return true;
  std::string_view chunk = whole;
  if (chunk.size() > claim.size() && chunk.substr(chunk.size() - claim.size()) == claim)
    chunk = chunk.substr(1, chunk.size() - 1 - claim.size());
  return is_chunk_name(chunk, grid);
}

void StoreFolder::remove_array(const OwnFolder& folder, const StoreArray& array) const {
  const OwnFolder own(folder, array.name);
  if (!own.is_open()) return;
  for (const std::string& file : own.names())
    if (gives(file, array.grid)) own.remove_file(file);
  folder.remove_empty_folder(array.name);
}

void StoreFolder::remove() const {
  const OwnFolder folder(folder_);
  if (!folder.is_open()) return;
  folder.rename(store_root, removed_root);
  for (const StoreArray& array : arrays_) remove_array(folder, array);
  folder.remove_file(removed_root);
  for (const std::string& name : folder.names())
    if (name_behind_temporary(name) == store_root) folder.remove_file(name);
  folder.remove_file(FolderLock::file_name, true);
  rmdir(folder_.c_str());
}

void remove_store(const fs::path& folder) {
  std::optional<StoreDescription> there = store_in(folder);
  if (!there) there = removed_store_in(folder);
  if (there) StoreFolder(folder, std::move(*there)).remove();
}

}  // namespace holdfast::program
