#include "holdfast/stability/chart/loop_chart.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

/// All numbers of a loop in the order of LoopParameter.
std::array<double, 10> numbers_of(const OperatingPoint& point) {
  const TwoMass<double>& plant = point.plant;
  return {plant.conductor_mass,    plant.conductor_stiffness,       plant.conductor_damping,
          plant.absorber_mass,     plant.absorber_stiffness,        plant.absorber_damping,
          point.sampling.period,   point.sampling.processing_delay, point.gains.proportional,
          point.gains.differential};
}

OperatingPoint some_point() { return {kollar2022_plant(), {0.010, 0.004}, {-557.0, -13.0}}; }

TEST(OperatingPoint, AParameterIsSetAndNoOther) {
  for (int k = 0; k < 10; ++k) {
    const auto parameter = static_cast<LoopParameter>(k);
    if (parameter == LoopParameter::sampling_period) continue;
    auto expected = numbers_of(some_point());
    expected[static_cast<std::size_t>(k)] = 0.0123;
    OperatingPoint point = some_point();
    set(point, parameter, 0.0123);
    EXPECT_EQ(numbers_of(point), expected) << k;
    EXPECT_EQ(is_gain(parameter), k >= 8) << k;
  }
}

TEST(OperatingPoint, TheDelayKeepsItsFractionOfTheSamplingPeriod) {
  auto expected = numbers_of(some_point());
  OperatingPoint point = some_point();
  set(point, LoopParameter::sampling_period, 0.020);
  expected[6] = 0.020;
  expected[7] = 0.008;
  EXPECT_EQ(numbers_of(point), expected);
}

}  // namespace
}  // namespace holdfast
