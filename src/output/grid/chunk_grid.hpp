#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace holdfast::program {

/// Most values of a chunk: enough for the compression to pay and few enough to keep in memory.
constexpr std::size_t values_in_chunk = std::size_t{1} << 16;

/// A shape of chunks that are contiguous when cells are numbered with the last axis fastest: whole
/// along the last axes, one cell along the first ones, in part along one between them.
/// @param most  cells of a chunk, at least 1
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

/// The cells of a grid in chunks of such a shape, both numbered with the last axis fastest: a chunk
/// is a run of cells. At the end of the axis that is cut, a chunk has fewer cells than the others;
/// in its file the rest are filled.
struct ChunkGrid {
  std::vector<std::size_t> shape;  ///< cells along each axis, at least 1
  std::vector<std::size_t> chunk;  ///< as chunk_shape() gives it

  std::int64_t cells() const { return product(shape); }
  /// Cells of a file.
  std::int64_t cells_of_file() const { return product(chunk); }

  /// Chunks along an axis.
  std::int64_t along(std::size_t axis) const {
    return (length(shape, axis) - 1) / length(chunk, axis) + 1;
  }

  std::int64_t chunks() const {
    std::int64_t all = 1;
    for (std::size_t axis = 0; axis < shape.size(); ++axis) all *= along(axis);
    return all;
  }

  /// The place of a chunk along each axis.
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

/// Cells of a grid that come in order, kept until a chunk of it is full.
class WaitingCells {
 public:
  WaitingCells(ChunkGrid grid, std::size_t columns) : grid_(std::move(grid)), values_(columns) {}

  /// Takes the next cells, one entry a column, and hands every chunk that is full to `put`: its
  /// number and the values of each column.
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
      // Behind the last one there is none to be asked for.
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
