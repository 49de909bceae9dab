#include "sweep/tiles/tile_file.hpp"

#include "process/errors.hpp"
#include "support/testing.hpp"

namespace holdfast::program {
namespace {

TileResult made_tile() {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  return {3, {1.5, -0.0, infinite, 1e-310, std::nan(""), 7.0}, 60'003, 1, 2, "no such case"};
}

TEST(TileResult, ComesBackFromItsBytesBitByBit) {
  const TileResult tile = made_tile();
  const TileResult back = tile_of_bytes(tile_bytes(tile), 3, 2);
  EXPECT_EQ(tile_bytes(back), tile_bytes(tile));
  EXPECT_EQ(back.cells, 3);
  EXPECT_EQ(back.samples, 60'003);
  EXPECT_EQ(back.diverging, 1);
  EXPECT_EQ(back.without_motion, 2);
  EXPECT_EQ(back.first_fault, "no such case");
  EXPECT_EQ(back.column(0)[0], 1.5);
  EXPECT_TRUE(std::signbit(back.column(0)[1]));
  EXPECT_EQ(back.column(1)[0], 1e-310);
  EXPECT_TRUE(std::isnan(back.column(1)[1]));
}

TEST(TileResult, OfOtherSizeIsRefused) {
  const std::string bytes = tile_bytes(made_tile());
  EXPECT_THROW(tile_of_bytes(bytes, 2, 2), OutputError);
  EXPECT_THROW(tile_of_bytes(bytes, 4, 2), OutputError);
  EXPECT_THROW(tile_of_bytes(bytes, 3, 4), OutputError);
  EXPECT_THROW(tile_of_bytes("", 3, 2), OutputError);
}

}  // namespace
}  // namespace holdfast::program
