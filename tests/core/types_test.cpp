#include "holdfast/core/types.hpp"

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

}  // namespace
}  // namespace holdfast
