#include "io/grid/cell_blocks.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace holdfast::program {
namespace {

/// How many cells there are in a step along each axis, and at last the cells of the grid in front.
std::vector<std::size_t> strides_of(const std::vector<std::size_t>& shape) {
  std::vector<std::size_t> strides(shape.size() + 1, 1);
  for (std::size_t axis = shape.size(); axis-- > 0;)
    strides[axis] = strides[axis + 1] * shape[axis];
  return strides;
}

}  // namespace

std::vector<CellBlock> cell_blocks(const std::vector<std::size_t>& shape, std::size_t first,
                                   std::size_t cells) {
  const std::vector<std::size_t> strides = strides_of(shape);
  if (shape.empty() || first > strides[0] || cells > strides[0] - first)
    throw std::logic_error("a run of cells that leaves its grid");
  std::vector<CellBlock> blocks;
  while (cells > 0) {
    CellBlock block{shape, std::vector<std::size_t>(shape.size(), 1)};
    for (std::size_t axis = 0; axis < shape.size(); ++axis)
      block.start[axis] = first % strides[axis] / strides[axis + 1];
    // The slowest axis along which there is a whole step from here; behind it all is whole.
    std::size_t axis = 0;
    while (first % strides[axis + 1] != 0 || cells < strides[axis + 1]) ++axis;
    block.count[axis] = std::min(shape[axis] - block.start[axis], cells / strides[axis + 1]);
    std::copy(shape.begin() + static_cast<std::ptrdiff_t>(axis) + 1, shape.end(),
              block.count.begin() + static_cast<std::ptrdiff_t>(axis) + 1);
    const std::size_t done = block.count[axis] * strides[axis + 1];
    first += done;
    cells -= done;
    blocks.push_back(std::move(block));
  }
  return blocks;
}

std::vector<std::size_t> chunk_shape(const std::vector<std::size_t>& shape,
                                     std::size_t longest_line) {
  std::vector<std::size_t> chunk(shape.size(), 1);
  if (shape.empty()) return chunk;
  chunk.back() = std::min(shape.back(), longest_line);
  std::size_t values = std::max(shape.back(), std::size_t{1});
  for (std::size_t axis = shape.size() - 1; axis-- > 0 && values < values_in_block;) {
    chunk[axis] = std::min(shape[axis], values_in_block / values);
    values *= shape[axis];
  }
  return chunk;
}

}  // namespace holdfast::program
