#include "holdfast/cable/statics.hpp"
#include "holdfast/plant/reduction.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

/// A law F(w) for the readings: linear, or bent by a cubic.
struct ForceLaw {
  double linear = 50.0, quadratic = 0.0, cubic = 0.0;
  double force(double w) const { return ((cubic * w + quadratic) * w + linear) * w; }
  double stiffness(double) const { return linear; }
};

TEST(ConductorStiffness, AStraightLineIsReadAlikeByAll) {
  for (const auto reading :
       {StiffnessReading::tangent, StiffnessReading::secant, StiffnessReading::least_squares})
    for (const ReadingRange& range : {ReadingRange{0.008, 0.007}, {0.01, 0.0}, {0.0, 0.003}})
      EXPECT_NEAR(conductor_stiffness(ForceLaw{}, reading, range), 50.0, 1e-11);
}

template <class Statics>
double regression_slope(const Statics& statics, const ReadingRange& range, int points) {
  const double middle = (range.below - range.above) / 2, width = range.below + range.above;
  double moment = 0.0, spread = 0.0;
  for (int k = 0; k < points; ++k) {
    const double offset = width * (static_cast<double>(k) / (points - 1) - 0.5);
    moment += offset * statics.force(middle + offset);
    spread += offset * offset;
  }
  return moment / spread;
}

TEST(ConductorStiffness, TheLeastSquaresLineIsThatOfManyPoints) {
  const auto expect_alike = [](const auto& statics, const ReadingRange& range, int points) {
    const double slope = conductor_stiffness(statics, StiffnessReading::least_squares, range);
    EXPECT_NEAR(slope / regression_slope(statics, range, points), 1.0, 1.0 / points);
  };
  const auto conductor = kollar2022_conductor();
  expect_alike(irvine_statics(conductor, 0.64, 0.16), {0.008, 0.007}, 20001);
  expect_alike(irvine_statics(conductor, 0.64, 0.16), {0.02, 0.0}, 20001);
  expect_alike(exact_statics(conductor, 0.64, 0.16), {0.008, 0.007}, 401);
}

TEST(ConductorStiffness, OnABentLawTheReadingsAreTheirClosedForms) {
  const ForceLaw law{50.0, 300.0, 2e4};
  const ReadingRange even{0.01, 0.01};
  EXPECT_EQ(conductor_stiffness(law, StiffnessReading::tangent, even), 50.0);
  // ∫ w F dw / ∫ w² dw over ± a: k + (3/5) c a²; the secant sees k + c a².
  EXPECT_NEAR(conductor_stiffness(law, StiffnessReading::least_squares, even),
              50.0 + 0.6 * 2e4 * 1e-4, 1e-10);
  EXPECT_NEAR(conductor_stiffness(law, StiffnessReading::secant, even), 50.0 + 2e4 * 1e-4, 1e-10);
}

TEST(ConductorStiffness, ANegativeOrEmptyRangeIsRefusedWhereOneIsRead) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const auto reading : {StiffnessReading::secant, StiffnessReading::least_squares})
    for (const ReadingRange& range :
         {ReadingRange{0.0, 0.0}, {-0.001, 0.01}, {0.01, -0.001}, {nan, 0.01}})
      EXPECT_THROW(conductor_stiffness(ForceLaw{}, reading, range), InvalidParameter);
  EXPECT_EQ(conductor_stiffness(ForceLaw{}, StiffnessReading::tangent, {0.0, 0.0}), 50.0);
  const auto statics = exact_statics(kollar2022_conductor(), 0.64, 0.16);
  EXPECT_THROW(conductor_stiffness(statics, StiffnessReading::secant, {0.01, 1.0}),
               InvalidParameter)
      << "a metre up is beyond what lifts the cable";
}

}  // namespace
}  // namespace holdfast
