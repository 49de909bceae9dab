#include "holdfast/core/types.hpp"
#include "holdfast/core/select.hpp"
#include "holdfast/core/version.hpp"

#include "support/testing.hpp"

namespace holdfast {
namespace {

TEST(Types, PiIsHalfATurnToThePrecisionOfTheNumberType) {
  EXPECT_EQ(pi<double>, std::acos(-1.0));
  EXPECT_EQ(pi<float>, std::acos(-1.0F));
  EXPECT_EQ(pi<long double>, std::acos(-1.0L));
}

TEST(Types, MatricesAreSquareUnlessTwoSizesAreGiven) {
  EXPECT_EQ((Matrix<double, 4>::ColsAtCompileTime), 4);
  EXPECT_EQ((Matrix<double, 4, 2>::ColsAtCompileTime), 2);
  EXPECT_EQ((Vector<double, 3>::ColsAtCompileTime), 1);
  EXPECT_EQ((RowVector<double, 3>::RowsAtCompileTime), 1);
}

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

TEST(Version, parts_and_text_are_the_same_version) {
  const std::string joined = std::to_string(version_major) + "." + std::to_string(version_minor) +
                             "." + std::to_string(version_patch);
  EXPECT_EQ(joined, version_string);
}

TEST(Version, parts_of_more_than_one_digit_are_read_whole) {
  EXPECT_EQ(detail::version_part("10.203.4", 0), 10);
  EXPECT_EQ(detail::version_part("10.203.4", 1), 203);
  EXPECT_EQ(detail::version_part("10.203.4", 2), 4);
}

TEST(Version, header_and_build_system_agree) { EXPECT_EQ(version_string, HOLDFAST_VERSION); }

}  // namespace
}  // namespace holdfast
