// Kollár 2022, Fig. 3: stability of the continuous loop without delay.

#include "holdfast/plant/two_mass.hpp"
#include "holdfast/stability/boundary/boundary.hpp"
#include "holdfast/stability/boundary/stable_intervals.hpp"
#include "holdfast/stability/polynomial/characteristic_polynomial.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

TEST(Figure3, TheEdgeAtTheTunedGainIsWhereThePaperReadsIt) {
  const auto polynomial = characteristic_polynomial(kollar2022_plant());
  const auto intervals = stable_differential_gains(polynomial, -557.0);
  ASSERT_FALSE(intervals.empty());
  EXPECT_NEAR(intervals.front().lower, -33.7, 0.05);
}

TEST(Figure3, TheEdgeIsAPairOnTheImaginaryAxis) {
  const auto polynomial = characteristic_polynomial(kollar2022_plant());
  const auto points = stability_boundary(polynomial, {-558.0, -556.0});
  bool found = false;
  for (const auto& point : points) {
    found = found || (point.curve == BoundaryCurve::imaginary_pair &&
                      std::abs(point.gains.differential + 33.7) < 0.1);
  }
  EXPECT_TRUE(found);
}

}  // namespace
}  // namespace holdfast
