#include "io/grid/cell_blocks.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <numeric>
#include <random>
#include <stdexcept>

namespace holdfast::program {
namespace {

using GridShape = std::vector<std::size_t>;

std::size_t product_of(const GridShape& shape) {
  return std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>());
}

/// The number of a cell of the grid.
std::size_t number_of_cell(const GridShape& shape, const GridShape& place) {
  std::size_t number = 0;
  for (std::size_t axis = 0; axis < shape.size(); ++axis) {
    EXPECT_LT(place[axis], shape[axis]);
    number = number * shape[axis] + place[axis];
  }
  return number;
}

/// The numbers of a box's cells, its last axis fastest.
void append_numbers(std::vector<std::size_t>& numbers, const GridShape& shape,
                    const CellBlock& block) {
  for (std::size_t i = 0; i < product_of(block.count); ++i) {
    GridShape place = block.start;
    std::size_t rest = i;
    for (std::size_t axis = shape.size(); axis-- > 0; rest /= block.count[axis])
      place[axis] += rest % block.count[axis];
    numbers.push_back(number_of_cell(shape, place));
  }
}

void expect_the_run(const GridShape& shape, std::size_t first, std::size_t cells) {
  const std::vector<CellBlock> blocks = cell_blocks(shape, first, cells);
  EXPECT_LE(blocks.size(), 2 * shape.size() - 1);
  std::vector<std::size_t> numbers, expected(cells);
  for (const CellBlock& block : blocks) {
    EXPECT_GE(product_of(block.count), 1U);
    append_numbers(numbers, shape, block);
  }
  std::iota(expected.begin(), expected.end(), first);
  EXPECT_EQ(numbers, expected) << first << " + " << cells << " in "
                               << ::testing::PrintToString(shape);
}

TEST(CellBlocks, HoldARunOnceAndInOrder) {
  std::mt19937_64 random(7);
  for (int trial = 0; trial < 400; ++trial) {
    GridShape shape(1 + random() % 5);
    for (std::size_t& count : shape) count = 1 + random() % 5;
    const std::size_t all = product_of(shape);
    const std::size_t first = random() % (all + 1);
    expect_the_run(shape, first, random() % (all - first + 1));
    expect_the_run(shape, 0, all);
  }
}

TEST(CellBlocks, OfEveryRunOfASmallGrid) {
  for (const GridShape& shape : {GridShape{3, 2, 4}, GridShape{1, 3, 1, 2}, GridShape{11}}) {
    const std::size_t all = product_of(shape);
    for (std::size_t first = 0; first <= all; ++first)
      for (std::size_t cells = 0; cells <= all - first; ++cells)
        expect_the_run(shape, first, cells);
  }
}

TEST(CellBlocks, AreOneForTheWholeAndAsManyAsTheyMayBeForAllButTheEnds) {
  const GridShape shape = {4, 3, 5};
  EXPECT_EQ(cell_blocks(shape, 0, 60).size(), 1U);
  EXPECT_EQ(cell_blocks(shape, 15, 30).size(), 1U);
  EXPECT_EQ(cell_blocks(shape, 1, 58).size(), 5U);
  EXPECT_TRUE(cell_blocks(shape, 60, 0).empty());
}

TEST(CellBlocks, OfARunThatLeavesTheGridAreADefect) {
  constexpr std::size_t most = std::numeric_limits<std::size_t>::max();
  EXPECT_THROW(cell_blocks({2, 3}, 4, 3), std::logic_error);
  EXPECT_THROW(cell_blocks({2, 3}, 7, 0), std::logic_error);
  EXPECT_THROW(cell_blocks({2, 3}, 1, most), std::logic_error);
  EXPECT_THROW(cell_blocks({}, 0, 1), std::logic_error);
}

}  // namespace
}  // namespace holdfast::program
