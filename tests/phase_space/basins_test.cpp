#include "holdfast/phase_space/basins.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "support/kollar_case.hpp"
#include "support/random.hpp"

namespace holdfast {
namespace {

constexpr auto one_after_the_other = [](std::size_t count, std::size_t tile, const auto& job) {
  for (std::size_t first = 0; first < count; first += tile)
    job(first, std::min(tile, count - first));
};

IdealLoop<double> basin_loop(double period, double width, double delay_fraction = 0.0) {
  test::KollarCase which;
  which.sampling_period = period;
  which.width = width;
  which.processing_delay = delay_fraction * period;
  return which.ideal_loop();
}

std::vector<Vector<double, 4>> basin_states(std::size_t count) {
  test::Random random(871);
  std::vector<Vector<double, 4>> states;
  for (std::size_t k = 0; k < count; ++k) {
    const Vector<double, 4> unit = random.matrix<Vector<double, 4>>();
    states.push_back(unit.cwiseProduct(Vector<double, 4>(0.005, 0.2, 0.005, 0.2)));
  }
  return states;
}

BasinMap scalar_basins(const IdealLoop<double>& loop, const std::vector<Vector<double, 4>>& states,
                       const OrbitLimits& limits = {20000, 0}) {
  return find_basins<double>(loop, states, limits, one_after_the_other);
}

TEST(Basins, EveryStateHasTheLabelThatItHasAlone) {
  for (const auto& loop : {basin_loop(0.003, 0.002), basin_loop(0.01, 0.002),
                           basin_loop(0.01, 0.002, 0.5), basin_loop(0.011, 0.002)}) {
    const auto states = basin_states(40);
    const BasinMap map = scalar_basins(loop, states);
    ASSERT_EQ(map.labels.size(), states.size());
    for (std::size_t k = 0; k < states.size(); ++k) {
      const OrbitResult alone = find_periodic_orbit(loop, states[k], {20000, 0});
      ASSERT_EQ(map.labels[k].outcome, alone.outcome) << loop.sampling.period << ' ' << k;
      if (alone.outcome != OrbitOutcome::certified) continue;
      const auto number = static_cast<std::size_t>(map.labels[k].attractor);
      EXPECT_TRUE(is_phase_shifted_copy(map.attractors.at(number).orbit, *alone.orbit))
          << loop.sampling.period << ' ' << k;
    }
  }
}

TEST(Basins, FractionsAndErrorsAreThoseOfTheCounts) {
  const auto states = basin_states(200);
  const BasinMap map = scalar_basins(basin_loop(0.003, 0.002), states);
  EXPECT_GE(map.attractors.size(), 2U);
  std::size_t counted = 0;
  int highest = -1;
  for (const BasinLabel& label : map.labels) {
    EXPECT_EQ(label.outcome, OrbitOutcome::certified);
    EXPECT_LE(label.attractor, highest + 1) << "numbered as they are met";
    highest = std::max(highest, label.attractor);
  }
  EXPECT_EQ(highest + 1, static_cast<int>(map.attractors.size()));
  double fractions = 0.0;
  for (std::size_t number = 0; number < map.attractors.size(); ++number) {
    const BasinAttractor& attractor = map.attractors[number];
    const auto members = std::count_if(
        map.labels.begin(), map.labels.end(),
        [&](const BasinLabel& label) { return label.attractor == static_cast<int>(number); });
    EXPECT_EQ(attractor.states, static_cast<std::size_t>(members));
    EXPECT_DOUBLE_EQ(attractor.fraction, static_cast<double>(members) / 200.0);
    const double variance = attractor.fraction * (1.0 - attractor.fraction) / 200.0;
    EXPECT_DOUBLE_EQ(attractor.standard_error, std::sqrt(variance));
    counted += attractor.states;
    fractions += attractor.fraction;
    for (std::size_t earlier = 0; earlier < number; ++earlier)
      EXPECT_FALSE(is_phase_shifted_copy(attractor.orbit, map.attractors[earlier].orbit));
    if (attractor.mirror_image) {
      const auto image = static_cast<std::size_t>(*attractor.mirror_image);
      ASSERT_LT(image, number);
      EXPECT_TRUE(is_mirror_image(attractor.orbit, map.attractors[image].orbit));
    }
  }
  EXPECT_EQ(counted, 200U);
  EXPECT_NEAR(fractions, 1.0, 1e-12);
}

TEST(Basins, DoNotDependOnTheOrderOfTheTiles) {
  const auto loop = basin_loop(0.003, 0.002);
  const auto states = basin_states(150);
  const auto backwards = [](std::size_t count, std::size_t tile, const auto& job) {
    const std::size_t tiles = (count + tile - 1) / tile;
    for (std::size_t k = tiles; k-- > 0;) job(k * tile, std::min(tile, count - k * tile));
  };
  const BasinMap map = scalar_basins(loop, states);
  const BasinMap other = find_basins<double>(loop, states, {20000, 0}, backwards);
  ASSERT_EQ(map.attractors.size(), other.attractors.size());
  for (std::size_t k = 0; k < states.size(); ++k)
    EXPECT_EQ(map.labels[k].attractor, other.labels[k].attractor);
}

TEST(Basins, OfAGrowingLoopAreEmpty) {
  for (const double width : {0.0, 0.002}) {
    const BasinMap map = scalar_basins(basin_loop(0.011, width, 1.0), basin_states(30));
    EXPECT_TRUE(map.attractors.empty());
    for (const BasinLabel& label : map.labels) EXPECT_EQ(label.outcome, OrbitOutcome::diverges);
  }
}

TEST(Basins, WithoutACommonPeriodThereAreNone) {
  IdealLoop<double> loop = basin_loop(0.01, 0.002);
  loop.excitation.frequency = 10.0 * std::sqrt(0.5);
  const BasinMap map = scalar_basins(loop, basin_states(5));
  EXPECT_TRUE(map.attractors.empty());
  ASSERT_EQ(map.labels.size(), 5U);
  for (const BasinLabel& label : map.labels) EXPECT_EQ(label.outcome, OrbitOutcome::incommensurate);
}

TEST(Basins, WithoutBacklashOneOrbitTakesAll) {
  const BasinMap map = scalar_basins(basin_loop(0.01, 0.0), basin_states(100));
  ASSERT_EQ(map.attractors.size(), 1U);
  EXPECT_EQ(map.attractors[0].states, 100U);
  EXPECT_EQ(map.attractors[0].fraction, 1.0);
  EXPECT_EQ(map.attractors[0].standard_error, 0.0);
}

TEST(Basins, WhatIsNotFoundInTimeIsSaidToBe) {
  // One common period is no time for motions of 2100 samples.
  const BasinMap map = scalar_basins(basin_loop(0.011, 0.002), basin_states(40), {100, 100});
  int none_found = 0;
  for (const BasinLabel& label : map.labels) {
    if (label.outcome == OrbitOutcome::none_found) {
      EXPECT_EQ(label.attractor, -1);
      ++none_found;
      continue;
    }
    ASSERT_EQ(label.outcome, OrbitOutcome::certified);
    const auto number = static_cast<std::size_t>(label.attractor);
    EXPECT_EQ(map.attractors.at(number).orbit.period_samples(), 100);
  }
  EXPECT_GE(none_found, 8) << "those that are searched first";
}

TEST(Basins, OfNoStatesAreEmpty) {
  const BasinMap map = scalar_basins(basin_loop(0.01, 0.002), {});
  EXPECT_TRUE(map.labels.empty());
  EXPECT_TRUE(map.attractors.empty());
}

TEST(Basins, WhatIsOutOfRangeIsRefused) {
  auto states = basin_states(3);
  EXPECT_THROW(scalar_basins(basin_loop(0.01, -0.002), states), InvalidParameter);
  EXPECT_THROW(scalar_basins(basin_loop(0.01, 0.002), states, {0, 0}), InvalidParameter);
  states[1][3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(scalar_basins(basin_loop(0.01, 0.002), states), InvalidParameter);
}

}  // namespace
}  // namespace holdfast
