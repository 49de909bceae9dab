#include "holdfast/core/select.hpp"

#include "support/testing.hpp"

namespace holdfast {
namespace {

TEST(Select, PicksOneOfTwoValuesByTheMask) {
  EXPECT_EQ(select(true, 1.5, 2.5), 1.5);
  EXPECT_EQ(select(false, 1.5, 2.5), 2.5);
  EXPECT_TRUE(without<double>(true, false));
  EXPECT_FALSE(without<double>(true, true));
  EXPECT_FALSE(without<double>(false, false));
}

TEST(Select, TheMaskOfAPlainNumberIsBool) {
  EXPECT_TRUE((std::is_same_v<Mask<double>, bool>));
  EXPECT_TRUE((std::is_same_v<Mask<float>, bool>));
}

TEST(Select, AnyAndAllOfOneLaneAreTheLane) {
  EXPECT_TRUE(any(true) && all(true));
  EXPECT_FALSE(any(false) || all(false));
}

}  // namespace
}  // namespace holdfast
