#pragma once

#include <cstddef>
#include <vector>

namespace holdfast::program {

/// A box of cells of a grid: from `start` on `count` cells along each axis.
struct CellBlock {
  std::vector<std::size_t> start;
  std::vector<std::size_t> count;  // each ≥ 1
};

/// The boxes that a run of cells is made of, the cells being numbered with the last axis fastest:
/// `cells` of them from number `first` on. One after the other the boxes hold the run in its order,
/// and they are 2 n − 1 at most for n axes: lines up to the end of a plane, planes, lines of the
/// last plane.
///
///     cell_blocks({3, 4}, 2, 9)   // {0, 2} by {1, 2}; {1, 0} by {1, 4}; {2, 0} by {1, 3}
///
/// Throws std::logic_error for a run that leaves the grid and for a grid without axes.
/// @param shape  how many cells along each axis; their product is a std::size_t
std::vector<CellBlock> cell_blocks(const std::vector<std::size_t>& shape, std::size_t first,
                                   std::size_t cells);

/// How many values of a column are written at a time: enough for the compression to pay and few
/// enough to keep in memory.
constexpr std::size_t values_in_block = std::size_t{1} << 16;

/// A chunk that is contiguous when cells are written in order, the last axis fastest: whole along
/// the last axes, one cell along the first ones, and of values_in_block values at most. Only along
/// the last axis it may be longer, up to `longest_line`.
std::vector<std::size_t> chunk_shape(const std::vector<std::size_t>& shape,
                                     std::size_t longest_line);

}  // namespace holdfast::program
