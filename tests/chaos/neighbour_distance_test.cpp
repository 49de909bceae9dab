#include "holdfast/chaos/neighbour_distance.hpp"

#include "holdfast/motion/implemented_loop.hpp"
#include "holdfast/phase_space/deviation.hpp"
#include "support/kollar_case.hpp"

namespace holdfast {
namespace {

/// A loop whose neighbours part: D beyond the stable ones, the backlash keeps the growth in bounds.
test::KollarCase parting_loop() {
  test::KollarCase which;
  which.sampling_period = 0.01;
  which.gains.differential = -20.0;
  which.excitation.frequency = 6.0;
  return which;
}

/// The plant without damping, control and force, released with z₁ displaced.
SampledMotion<double> undamped_motion(double displacement) {
  TwoMass<double> plant = kollar2022_plant();
  plant.conductor_damping = plant.absorber_damping = 0.0;
  const SampledLoop<double> loop = sampled_loop(plant, Sampling<double>{0.01, 0.0});
  return {loop,
          PdGains<double>{0.0, 0.0},
          held_harmonic(loop),
          HarmonicExcitation<double>{},
          Backlash<double>(0.0),
          {displacement, 0.0, 0.0, 0.0}};
}

TEST(NeighbourDistance, StaysWhatItWasWhereNothingDecays) {
  const auto found = neighbour_distance(undamped_motion(0.002), 5000, 50000);
  ASSERT_TRUE(found.has_value());
  EXPECT_GT(*found, 0.05 * neighbour_start);
  EXPECT_LT(*found, 5.0 * neighbour_start);
}

TEST(NeighbourDistance, DiesDownWithTheSpectralRadius) {
  test::KollarCase which;
  which.width = 0.0;
  const auto settled = neighbour_distance(which.motion(), 20000, 20000);
  ASSERT_TRUE(settled.has_value());
  EXPECT_LT(*settled, 1e-3 * neighbour_start);
}

TEST(NeighbourDistance, PartsAsTwoMotionsSideBySideDo) {
  const auto found = neighbour_distance(parting_loop().motion(), 20000, 20000);
  ASSERT_TRUE(found.has_value());
  EXPECT_GE(*found, neighbour_parted);
  // The same by run_deviation(): from 10⁻¹² m the two come apart by more than a hundredth of z₁.
  auto first = parting_loop().motion();
  auto second = first;
  second.displace_conductor(1e-12);
  double largest = 0.0, apart = 0.0;
  run_deviation(first, second, 40000, [&](const Deviation& deviation) {
    largest = std::max(largest, std::abs(first.state()[0]));
    if (deviation.time > 300.0) apart += std::abs(deviation.displacement) / 10000;
  });
  EXPECT_GT(apart, 0.01 * largest);
}

TEST(NeighbourDistance, IsThatOfTheEventDrivenMotionToo) {
  const ImplementedLoop loop = implemented_loop(parting_loop().ideal_loop());
  const auto found =
      neighbour_distance(event_motion(loop, Vector<double, 4>::Zero()), 20000, 20000);
  ASSERT_TRUE(found.has_value());
  EXPECT_GE(*found, neighbour_parted);
}

TEST(NeighbourDistance, OfAMotionAtRestOrBeyondAllBoundsThereIsNone) {
  EXPECT_FALSE(neighbour_distance(undamped_motion(0.0), 100, 100).has_value());
  test::KollarCase which;
  which.width = 0.0;
  which.sampling_period = which.processing_delay = 0.011;
  EXPECT_FALSE(neighbour_distance(which.motion(), 1000, 100000).has_value());
}

TEST(NeighbourDistance, TooFewSamplesAreRefused) {
  EXPECT_THROW(neighbour_distance(undamped_motion(0.002), 1, 100), InvalidParameter);
  EXPECT_THROW(neighbour_distance(undamped_motion(0.002), 100, 3), InvalidParameter);
}

}  // namespace
}  // namespace holdfast
