#include "sweep/tiles/tile_file.hpp"

#include "support/testing.hpp"

namespace holdfast::program {
namespace {

constexpr TileLabel label_of_test{0x0123456789ABCDEF, 7};
const std::string content_of_test("\0\xFF two\nlines\0", 13);

TEST(TileFile, GivesBackWhatItHolds) {
  const std::string large(1 << 20, '\x80');
  for (const std::string& content : {std::string(), content_of_test, large}) {
    const std::string file = tile_file(label_of_test, content);
    EXPECT_EQ(file.size(), 48 + content.size());
    EXPECT_EQ(tile_content(label_of_test, file), content);
  }
}

TEST(TileFile, HoldsTheLargestNumbers) {
  const TileLabel largest{std::numeric_limits<std::uint64_t>::max(),
                          std::numeric_limits<std::int64_t>::max()};
  EXPECT_EQ(tile_content(largest, tile_file(largest, "x")), "x");
}

TEST(TileFile, BeginsAsDocumented) {
  const std::string file = tile_file({0x0102030405060708, 0x1122}, "abc");
  EXPECT_EQ(file.substr(0, 8), "holdtile");
  EXPECT_EQ(file.substr(8, 8), std::string("\1\0\0\0\0\0\0\0", 8));
  EXPECT_EQ(file.substr(16, 8), "\x08\x07\x06\x05\x04\x03\x02\x01");
  EXPECT_EQ(file.substr(24, 8), std::string("\x22\x11\0\0\0\0\0\0", 8));
  EXPECT_EQ(file.substr(32, 8), std::string("\3\0\0\0\0\0\0\0", 8));
  EXPECT_EQ(file.substr(48), "abc");
}

TEST(TileFile, IsRefusedWhenTruncatedAtAnyLength) {
  const std::string file = tile_file(label_of_test, content_of_test);
  for (std::size_t length = 0; length < file.size(); ++length) {
    EXPECT_FALSE(tile_content(label_of_test, file.substr(0, length))) << length;
  }
}

TEST(TileFile, IsRefusedWhenContinued) {
  const std::string file = tile_file(label_of_test, content_of_test);
  for (int byte = 0; byte < 256; ++byte) {
    EXPECT_FALSE(tile_content(label_of_test, file + static_cast<char>(byte))) << byte;
  }
}

TEST(TileFile, IsRefusedWhenAnyBitIsFlipped) {
  const std::string file = tile_file(label_of_test, content_of_test);
  for (std::size_t bit = 0; bit < 8 * file.size(); ++bit) {
    std::string altered = file;
    altered[bit / 8] = static_cast<char>(altered[bit / 8] ^ (1 << (bit % 8)));
    EXPECT_FALSE(tile_content(label_of_test, altered)) << bit;
  }
}

TEST(TileFile, IsRefusedForAnotherTileOrPlan) {
  const std::string file = tile_file(label_of_test, content_of_test);
  EXPECT_FALSE(tile_content({label_of_test.plan, 8}, file));
  EXPECT_FALSE(tile_content({label_of_test.plan + 1, 7}, file));
}

}  // namespace
}  // namespace holdfast::program
