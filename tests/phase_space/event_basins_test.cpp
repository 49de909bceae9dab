#include "holdfast/phase_space/event_basins.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "holdfast/phase_space/basins.hpp"
#include "support/kollar_case.hpp"
#include "support/random.hpp"

namespace holdfast {
namespace {

constexpr auto event_tiles_in_order = [](std::size_t count, std::size_t tile, const auto& job) {
  for (std::size_t first = 0; first < count; first += tile)
    job(first, std::min(tile, count - first));
};

IdealLoop<double> event_basin_ideal_loop(double period, double width) {
  test::KollarCase which;
  which.sampling_period = period;
  which.width = width;
  return which.ideal_loop();
}

ImplementedLoop event_basin_loop(double period, double width,
                                 Switching switching = Switching::exact) {
  ImplementedLoop loop = implemented_loop(event_basin_ideal_loop(period, width));
  loop.switching = switching;
  return loop;
}

std::vector<Vector<double, 4>> event_basin_states(std::size_t count) {
  test::Random random(871);
  std::vector<Vector<double, 4>> states;
  for (std::size_t k = 0; k < count; ++k) {
    const Vector<double, 4> unit = random.matrix<Vector<double, 4>>();
    states.push_back(unit.cwiseProduct(Vector<double, 4>(0.005, 0.2, 0.005, 0.2)));
  }
  return states;
}

EventBasinMap event_basins(const ImplementedLoop& loop,
                           const std::vector<Vector<double, 4>>& states,
                           const OrbitLimits& limits = {20000, 0}) {
  return find_event_basins(loop, states, limits, event_tiles_in_order);
}

struct AloneFound {
  OrbitOutcome outcome;
  std::optional<EventOrbit> orbit;
};

AloneFound found_alone(const ImplementedLoop& loop, const Vector<double, 4>& state) {
  return with_motion(loop, state, [](const auto& motion) {
    auto found = find_event_orbit(motion, {20000, 0});
    return AloneFound{found.outcome, std::move(found.orbit)};
  });
}

TEST(EventBasins, EveryStateHasTheLabelThatItHasAlone) {
  const Switching sampled = Switching::sampled;
  for (const auto& loop : {event_basin_loop(0.01, 0.002), event_basin_loop(0.003, 0.002),
                           event_basin_loop(0.003, 0.002, sampled)}) {
    const auto states = event_basin_states(24);
    const EventBasinMap map = event_basins(loop, states);
    ASSERT_EQ(map.labels.size(), states.size());
    for (std::size_t k = 0; k < states.size(); ++k) {
      const AloneFound alone = found_alone(loop, states[k]);
      ASSERT_EQ(map.labels[k].outcome, alone.outcome) << k;
      if (alone.outcome != OrbitOutcome::certified) continue;
      const auto number = static_cast<std::size_t>(map.labels[k].attractor);
      EXPECT_TRUE(is_phase_shifted_copy(map.attractors.at(number).orbit, *alone.orbit)) << k;
    }
  }
}

TEST(EventBasins, OfSampledSwitchingAreThoseOfTheModelOfThePaper) {
  const auto forced = event_basin_ideal_loop(0.003, 0.002);
  const auto states = event_basin_states(60);
  const BasinMap paper = find_basins<double>(forced, states, {20000, 0}, event_tiles_in_order);
  const EventBasinMap map = event_basins(implemented_loop(forced), states);
  ASSERT_GE(paper.attractors.size(), 2U);
  ASSERT_EQ(map.attractors.size(), paper.attractors.size());
  for (std::size_t k = 0; k < states.size(); ++k) {
    EXPECT_EQ(map.labels[k].outcome, paper.labels[k].outcome) << k;
    EXPECT_EQ(map.labels[k].attractor, paper.labels[k].attractor) << k;
  }
  for (std::size_t k = 0; k < map.attractors.size(); ++k) {
    EXPECT_EQ(map.attractors[k].orbit.period_samples(), paper.attractors[k].orbit.period_samples());
    EXPECT_EQ(map.attractors[k].fraction, paper.attractors[k].fraction);
    EXPECT_EQ(map.attractors[k].standard_error, paper.attractors[k].standard_error);
    EXPECT_EQ(map.attractors[k].mirror_image, paper.attractors[k].mirror_image);
  }
}

TEST(EventBasins, DoNotDependOnTheOrderOfTheTilesOrOnThreads) {
  const auto loop = event_basin_loop(0.003, 0.002, Switching::sampled);
  const auto states = event_basin_states(40);
  const auto backwards = [](std::size_t count, std::size_t tile, const auto& job) {
    const std::size_t tiles = (count + tile - 1) / tile;
    for (std::size_t k = tiles; k-- > 0;) job(k * tile, std::min(tile, count - k * tile));
  };
  const auto threaded = [](std::size_t count, std::size_t, const auto& job) {
    std::atomic<std::size_t> next{0};
    std::vector<std::thread> threads;
    for (int k = 0; k < 3; ++k)
      threads.emplace_back([&] {
        for (std::size_t first = next++; first < count; first = next++) job(first, 1);
      });
    for (std::thread& thread : threads) thread.join();
  };
  const EventBasinMap map = event_basins(loop, states);
  for (const EventBasinMap& other : {find_event_basins(loop, states, {20000, 0}, backwards),
                                     find_event_basins(loop, states, {20000, 0}, threaded)}) {
    ASSERT_EQ(map.attractors.size(), other.attractors.size());
    for (std::size_t k = 0; k < states.size(); ++k) {
      EXPECT_EQ(map.labels[k].outcome, other.labels[k].outcome);
      EXPECT_EQ(map.labels[k].attractor, other.labels[k].attractor);
    }
    for (std::size_t k = 0; k < map.attractors.size(); ++k)
      EXPECT_EQ(map.attractors[k].orbit.states, other.attractors[k].orbit.states);
  }
}

TEST(EventBasins, WithoutBacklashOneOrbitTakesAll) {
  for (const Switching switching : {Switching::sampled, Switching::exact}) {
    const EventBasinMap map =
        event_basins(event_basin_loop(0.01, 0.0, switching), event_basin_states(40));
    ASSERT_EQ(map.attractors.size(), 1U);
    EXPECT_EQ(map.attractors[0].states, 40U);
    EXPECT_EQ(map.attractors[0].fraction, 1.0);
    EXPECT_EQ(map.attractors[0].standard_error, 0.0);
    EXPECT_FALSE(map.attractors[0].mirror_image.has_value());
  }
}

TEST(EventBasins, OfAGrowingLoopAreEmpty) {
  for (const auto& [switching, width] :
       {std::pair{Switching::sampled, 0.002}, std::pair{Switching::exact, 0.0}}) {
    ImplementedLoop loop = event_basin_loop(0.011, width, switching);
    loop.digital.sampling.processing_delay = 0.011;
    const EventBasinMap map = event_basins(loop, event_basin_states(10));
    EXPECT_TRUE(map.attractors.empty());
    for (const BasinLabel& label : map.labels) EXPECT_EQ(label.outcome, OrbitOutcome::diverges);
  }
}

TEST(EventBasins, WithoutACommonPeriodThereAreNone) {
  ImplementedLoop irrational = event_basin_loop(0.01, 0.002);
  irrational.digital.force.harmonics.front().frequency = 10.0 * std::sqrt(0.5);
  ImplementedLoop straying = event_basin_loop(0.01, 0.002);
  straying.digital.jitter = {1e-4, 3};
  for (const ImplementedLoop& loop : {irrational, straying}) {
    const EventBasinMap map = event_basins(loop, event_basin_states(5));
    EXPECT_TRUE(map.attractors.empty());
    ASSERT_EQ(map.labels.size(), 5U);
    for (const BasinLabel& label : map.labels)
      EXPECT_EQ(label.outcome, OrbitOutcome::incommensurate);
  }
}

TEST(EventBasins, WhatIsNotFoundInTimeIsSaidToBe) {
  const EventBasinMap map = event_basins(event_basin_loop(0.011, 0.002, Switching::sampled),
                                         event_basin_states(12), {100, 200});
  for (const BasinLabel& label : map.labels) {
    EXPECT_NE(label.outcome, OrbitOutcome::certified) << "200 samples are too few to come anywhere";
    EXPECT_EQ(label.attractor, -1);
  }
  const EventBasinMap none =
      event_basins(event_basin_loop(0.011, 0.002), event_basin_states(3), {99, 0});
  for (const BasinLabel& label : none.labels) EXPECT_EQ(label.outcome, OrbitOutcome::none_found);
}

TEST(EventBasins, OfNoStatesAreEmpty) {
  const EventBasinMap map = event_basins(event_basin_loop(0.01, 0.002), {});
  EXPECT_TRUE(map.labels.empty());
  EXPECT_TRUE(map.attractors.empty());
}

TEST(EventBasins, MayBeEndedByTheWatch) {
  OrbitLimits limits{20000, 0};
  limits.watch = [] { throw std::runtime_error("enough"); };
  EXPECT_THROW(event_basins(event_basin_loop(0.01, 0.002), event_basin_states(3), limits),
               std::runtime_error);
}

TEST(EventBasins, WhatIsOutOfRangeIsRefused) {
  auto states = event_basin_states(3);
  EXPECT_THROW(event_basins(event_basin_loop(0.01, -0.002), states), InvalidParameter);
  EXPECT_THROW(event_basins(event_basin_loop(0.01, 0.002), states, {0, 0}), InvalidParameter);
  states[1][3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(event_basins(event_basin_loop(0.01, 0.002), states), InvalidParameter);
}

}  // namespace
}  // namespace holdfast
