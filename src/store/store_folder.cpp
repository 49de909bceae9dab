#include "store/store_folder.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <limits>
#include <new>
#include <stdexcept>

#include "io/file/folder_lock.hpp"
#include "io/file/whole_file.hpp"
#include "io/grid/grid_attributes.hpp"
#include "process/errors.hpp"
#include "process/interrupt.hpp"
#include "process/system_words.hpp"

namespace holdfast::program {
namespace {

namespace fs = std::filesystem;

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "a store's numbers are little-endian");

template <class Number>
std::string bytes_as(const std::vector<double>& values, std::size_t count, Number fill) {
  std::vector<Number> numbers(count, fill);
  std::transform(values.begin(), values.end(), numbers.begin(),
                 [](double value) { return static_cast<Number>(value); });
  return {reinterpret_cast<const char*>(numbers.data()), count * sizeof(Number)};
}

/// The bytes of a file of `count` cells; those beyond the values are filled.
std::string bytes_of(const std::vector<double>& values, std::size_t count, ElementType type) {
  if (type == ElementType::byte) return bytes_as<std::int8_t>(values, count, -1);
  if (type == ElementType::integer)
    return bytes_as<std::int64_t>(values, count, std::numeric_limits<std::int64_t>::min());
  return bytes_as<double>(values, count, std::numeric_limits<double>::quiet_NaN());
}

template <class Number>
std::vector<double> values_as(const std::string& bytes, std::size_t count) {
  std::vector<Number> numbers(count);
  std::memcpy(numbers.data(), bytes.data(), count * sizeof(Number));
  return {numbers.begin(), numbers.end()};
}

std::vector<double> values_of(const std::string& bytes, std::size_t count, ElementType type) {
  if (type == ElementType::byte) return values_as<std::int8_t>(bytes, count);
  if (type == ElementType::integer) return values_as<std::int64_t>(bytes, count);
  return values_as<double>(bytes, count);
}

/// Whether every value is one that the column may have.
bool fit(const CellColumn& column, const std::vector<double>& values) {
  if (column.words.empty()) return true;
  return std::all_of(values.begin(), values.end(), [&](double value) {
    return value >= 0.0 && value < static_cast<double>(column.words.size());
  });
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) refuse_to_write(folder, error.value());
}

void write_file(const fs::path& file, std::string_view bytes) {
  make_folder(file.parent_path());
  const int error = write_whole_file(file, bytes);
  if (error != 0) refuse_to_write(file, error);
}

[[noreturn]] void refuse_to_look_into(const fs::path& folder, int error) {
  if (error == ENOMEM) throw std::bad_alloc();
  refuse_to_read(folder, system_words(error));
}

/// What the format says a root is; nothing where there is no such file.
std::optional<std::string> root_text(const fs::path& folder, int format) {
  int error = 0;
  std::optional<std::string> text =
      read_whole_file(folder / (format == 2 ? root_of_format_2 : root_of_format_3), error);
  if (!text && error != ENOENT && error != ENOTDIR) refuse_to_look_into(folder, error);
  return text;
}

bool holds_nothing_but(const fs::path& folder, const std::vector<std::string>& known) {
  std::error_code error;
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

/// Whether nothing is there, or leftovers of a store whose root was not written any more; without
/// chunks, of which nobody could tell what they belong to.
bool may_begin_store(const fs::path& folder, const StoreDescription& description) {
  std::vector<std::string> known = {".zgroup", ".zmetadata", FolderLock::file_name};
  for (const GridAxis& axis : description.axes) known.push_back(cf_name(axis.column.name));
  for (const CellColumn& cells : description.columns) {
    known.push_back(cf_name(cells.column.name));
    if (!holds_nothing_but(folder / known.back(), {root_of_format_3, root_of_format_2, ".zarray"}))
      return false;
  }
  return holds_nothing_but(folder, known);
}

[[noreturn]] void refuse_folder(const fs::path& folder) {
  throw WrongInput("cannot write " + folder.string() +
                   ": something else is there than a store of holdfast; give another name");
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
  for (const int format : {3, 2}) {
    const std::optional<std::string> text = root_text(folder, format);
    if (!text) continue;
    try {
      return read_description(*text, format);
    } catch (const std::invalid_argument&) {
      return std::nullopt;
    }
  }
  return std::nullopt;
}

StoreFolder StoreFolder::enter(const fs::path& folder, const StoreDescription& description) {
  StoreFolder store(folder, description);
  std::optional<StoreDescription> there = store_in(folder);
  if (!there) {
    if (may_begin_store(folder, description)) store.begin();
    // Read anew: another process may have begun a store meanwhile, this one or another.
    there = store_in(folder);
  }
  if (!there) refuse_folder(folder);
  require_same_plan(folder, *there, description);
  return store;
}

StoreFolder StoreFolder::open(const fs::path& folder) {
  std::optional<StoreDescription> there = store_in(folder);
  if (!there) throw WrongInput(folder.string() + " is no store of cells that holdfast has written");
  StoreFolder store(folder, std::move(*there));
  store.read_axes();
  return store;
}

/// Leaves nothing where it cannot come to its end, but what another process has begun meanwhile.
void StoreFolder::begin() const {
  try {
    write_documents();
  } catch (...) {
    if (!store_in(folder_)) remove();
    throw;
  }
}

void StoreFolder::write_documents() const {
  const auto documents = store_documents(description_);
  for (const GridAxis& axis : description_.axes) {
    const std::size_t length = coordinates_in_chunk(axis.count());
    for (std::size_t first = 0; first < axis.count(); first += length) {
      throw_if_interrupted();
      std::vector<double> values(std::min(length, axis.count() - first));
      for (std::size_t i = 0; i < values.size(); ++i) values[i] = axis.at(first + i);
      const auto place = {static_cast<std::int64_t>(first / length)};
      write_file(folder_ / chunk_file(cf_name(axis.column.name), place, description_.format),
                 packed_chunk(bytes_of(values, length, ElementType::real), description_.packing));
    }
  }
  for (const auto& [path, text] : documents) write_file(folder_ / path, text);
}

void StoreFolder::read_axes() {
  for (std::size_t k = 0; k < description_.axes.size(); ++k) {
    const std::string name = cf_name(description_.axes[k].column.name);
    const std::size_t count = grid().shape[k], length = coordinates_in_chunk(count);
    std::vector<double> values;
    for (std::size_t first = 0; first < count; first += length) {
      const auto place = {static_cast<std::int64_t>(first / length)};
      const fs::path file = folder_ / chunk_file(name, place, description_.format);
      int error = 0;
      const std::optional<std::string> packed = read_whole_file(file, error);
      const auto bytes =
          packed ? unpacked_chunk(*packed, length * sizeof(double), description_.packing)
                 : std::nullopt;
      if (!bytes) refuse_to_read(file, packed ? "it is damaged" : system_words(error));
      const std::vector<double> part =
          values_of(*bytes, std::min(length, count - first), ElementType::real);
      values.insert(values.end(), part.begin(), part.end());
    }
    description_.axes[k].values = std::move(values);
  }
}

fs::path StoreFolder::file_of(std::size_t column, std::int64_t chunk) const {
  if (chunk < 0 || chunk >= grid().chunks()) throw std::out_of_range("no such chunk in the store");
  return folder_ / chunk_file(cf_name(description_.columns[column].column.name),
                              grid().place(chunk), description_.format);
}

bool StoreFolder::has(std::int64_t chunk) const {
  std::error_code error;
  return fs::is_regular_file(file_of(0, chunk), error);
}

std::optional<std::vector<double>> StoreFolder::read_column(std::size_t column,
                                                            std::int64_t chunk) const {
  int ignored = 0;  // a file that cannot be read is as good as none
  const std::optional<std::string> file = read_whole_file(file_of(column, chunk), ignored);
  if (!file) return std::nullopt;
  const CellColumn& cells = description_.columns[column];
  const ElementType type = element_type_of(cells);
  const auto of_file = static_cast<std::size_t>(grid().cells_of_file());
  const std::optional<std::string> bytes =
      unpacked_chunk(*file, of_file * size_of(type), description_.packing);
  if (!bytes) return std::nullopt;
  std::vector<double> values =
      values_of(*bytes, static_cast<std::size_t>(grid().cells_of(chunk)), type);
  if (!fit(cells, values)) return std::nullopt;
  return values;
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
    const fs::path file = file_of(column, chunk);
    const ElementType type = element_type_of(description_.columns[column]);
    const auto of_file = static_cast<std::size_t>(grid().cells_of_file());
    const int error = write_whole_file(
        file, packed_chunk(bytes_of(values[column], of_file, type), description_.packing));
    if (error != 0) throw OutputError("cannot write " + file.string() + ": " + system_words(error));
  }
}

void StoreFolder::remove_leftovers(std::int64_t chunk) const {
  std::error_code error;
  for (std::size_t column = 0; column < description_.columns.size(); ++column) {
    const fs::path file = file_of(column, chunk);
    std::vector<fs::path> left;
    for (const fs::directory_entry& entry : fs::directory_iterator(file.parent_path(), error))
      if (name_behind_temporary(entry.path().filename().string()) == file.filename().string())
        left.push_back(entry.path());
    for (const fs::path& temporary : left) fs::remove(temporary, error);
  }
}

std::int64_t StoreFolder::chunks_done() const {
  std::int64_t done = 0;
  for (std::int64_t chunk = 0; chunk < grid().chunks(); ++chunk) done += has(chunk) ? 1 : 0;
  return done;
}

void StoreFolder::remove() const {
  std::error_code ignored;
  // The root last: until then the rest is known to be a store's.
  for (const GridAxis& axis : description_.axes)
    fs::remove_all(folder_ / cf_name(axis.column.name), ignored);
  for (const CellColumn& cells : description_.columns)
    fs::remove_all(folder_ / cf_name(cells.column.name), ignored);
  for (const char* name : {".zmetadata", ".zgroup", root_of_format_2, root_of_format_3})
    fs::remove(folder_ / name, ignored);
  rmdir(folder_.c_str());
}

}  // namespace holdfast::program
