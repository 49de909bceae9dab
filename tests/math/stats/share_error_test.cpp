#include "holdfast/math/stats/share_error.hpp"

#include "holdfast/core/types.hpp"
#include "support/random.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

TEST(ShareError, IsThatOfALargeSample) {
  for (const std::size_t count : {2000U, 5000U, 9999U}) {
    const double share = static_cast<double>(count) / 10000.0;
    const double sample = std::sqrt(share * (1.0 - share) / 10000.0);
    EXPECT_NEAR(share_error(count, 10000) / sample, 1.0, count == 9999U ? 0.3 : 1e-3);
  }
}

TEST(ShareError, IsNotZeroWhereNoneOrAllWereSeen) {
  EXPECT_GT(share_error(0, 100), 0.0);
  EXPECT_DOUBLE_EQ(share_error(0, 100), share_error(100, 100));
  EXPECT_LT(share_error(0, 1000), share_error(0, 100));
}

/// The mean square of how far a uniformly drawn share is from that seen is as large as it says.
TEST(ShareError, IsHowFarTheShareIs) {
  test::Random random(3);
  for (const std::size_t all : {5U, 40U}) {
    double square = 0.0, claimed = 0.0;
    constexpr int trials = 40000;
    for (int trial = 0; trial < trials; ++trial) {
      const double angle = 0.5 * pi<double> * random.unit();  // shares by Jeffreys's prior
      const double share = std::sin(angle) * std::sin(angle);
      std::size_t count = 0;
      for (std::size_t k = 0; k < all; ++k) count += random.unit() < share ? 1U : 0U;
      const double middle = (static_cast<double>(count) + 0.5) / (static_cast<double>(all) + 1.0);
      square += (share - middle) * (share - middle);
      claimed += share_error(count, all) * share_error(count, all);
    }
    EXPECT_NEAR(square / claimed, 1.0, 0.03) << all;
  }
}

}  // namespace
}  // namespace holdfast
