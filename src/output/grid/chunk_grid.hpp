#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace holdfast::program {

/// Largest number of values of a chunk: enough for good compression, few enough to keep in memory.
constexpr std::size_t values_in_chunk = std::size_t{1} << 16;

/// A chunk shape that makes chunks contiguous when cells are numbered with the last axis fastest:
/// the full length along the last axes, part of one axis, one cell along the first axes.
/// @param most  largest number of cells of a chunk, at least 1
inline std::vector<std::size_t> chunk_shape(const std::vector<std::size_t>& shape,
                                            std::size_t most) {
  std::vector<std::size_t> chunk(shape.size(), 1);
  std::size_t cells = 1;
  for (std::size_t axis = shape.size(); axis-- > 0 && cells < most;) {
    chunk[axis] = std::max(std::min(shape[axis], most / cells), std::size_t{1});
    cells *= shape[axis];
  }
  return chunk;
}

/// A grid of cells divided into chunks of a chunk_shape(). Cells and chunks are numbered with the
/// last axis fastest, so a chunk is a run of consecutive cells. The last chunk along the divided
/// axis may have fewer cells; its file is padded.
struct ChunkGrid {
  std::vector<std::size_t> shape;  ///< cells along each axis, at least 1
  std::vector<std::size_t> chunk;  ///< cells of a chunk along each axis, by chunk_shape()

  std::int64_t cells() const { return product(shape); }
  /// Number of cells in the file of a chunk, padding included.
  std::int64_t cells_of_file() const { return product(chunk); }

  /// Number of chunks along an axis.
  std::int64_t along(std::size_t axis) const {
    return (length(shape, axis) - 1) / length(chunk, axis) + 1;
  }

  std::int64_t chunks() const {
    std::int64_t all = 1;
    for (std::size_t axis = 0; axis < shape.size(); ++axis) all *= along(axis);
    return all;
  }

  /// Index of a chunk along each axis.
  std::vector<std::int64_t> place(std::int64_t number) const {
    std::vector<std::int64_t> places(shape.size());
    for (std::size_t axis = shape.size(); axis-- > 0; number /= along(axis))
      places[axis] = number % along(axis);
    return places;
  }

  std::int64_t first_cell(std::int64_t number) const {
    const std::vector<std::int64_t> places = place(number);
    std::int64_t cell = 0;
    for (std::size_t axis = 0; axis < shape.size(); ++axis)
      cell = cell * length(shape, axis) + places[axis] * length(chunk, axis);
    return cell;
  }

  std::int64_t cells_of(std::int64_t number) const {
    const std::vector<std::int64_t> places = place(number);
    std::int64_t cells = 1;
    for (std::size_t axis = 0; axis < shape.size(); ++axis) {
      const std::int64_t taken = places[axis] * length(chunk, axis);
      cells *= std::min(length(chunk, axis), length(shape, axis) - taken);
    }
    return cells;
  }

 private:
  static std::int64_t length(const std::vector<std::size_t>& lengths, std::size_t axis) {
    return static_cast<std::int64_t>(lengths[axis]);
  }
  static std::int64_t product(const std::vector<std::size_t>& lengths) {
    std::int64_t all = 1;
    for (const std::size_t count : lengths) all *= static_cast<std::int64_t>(count);
    return all;
  }
};

/// Buffer for the cells of a grid, appended in order, until a chunk is full.
class WaitingCells {
 public:
  WaitingCells(ChunkGrid grid, std::size_t columns) : grid_(std::move(grid)), values_(columns) {}

  /// Appends the next cells, with one pointer per column. Calls `put(number, values)` for every
  /// full chunk, with its number and one list of values per column.
  template <class Put>
  void append(std::size_t cells, const std::vector<const double*>& columns, const Put& put) {
    for (std::size_t done = 0; done < cells;) {
      const auto wanted = static_cast<std::size_t>(grid_.cells_of(chunk_));
      const std::size_t taken = std::min(wanted - waiting_, cells - done);
      for (std::size_t k = 0; k < columns.size(); ++k)
        values_[k].insert(values_[k].end(), columns[k] + done, columns[k] + done + taken);
      done += taken;
      waiting_ += taken;
      if (waiting_ < wanted) continue;
      put(chunk_, values_);
      for (std::vector<double>& column : values_) column.clear();
      waiting_ = 0;
      // No chunk follows the last one.
      if (chunk_ + 1 < grid_.chunks()) ++chunk_;
    }
  }

 private:
  ChunkGrid grid_;
  std::vector<std::vector<double>> values_;
  std::size_t waiting_ = 0;
  std::int64_t chunk_ = 0;
};

}  // namespace holdfast::program
