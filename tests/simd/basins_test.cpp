#include "holdfast/simd/basins.hpp"

#include "support/kollar_case.hpp"
#include "support/random_states.hpp"

namespace holdfast {
namespace {

using MotionPack = simd::Pack<double>;

std::vector<Vector<double, 4>> packed_states(std::size_t count) {
  return test::random_states(881, count);
}

void expect_same_map(const BasinMap& one, const BasinMap& other) {
  ASSERT_EQ(one.labels.size(), other.labels.size());
  ASSERT_EQ(one.attractors.size(), other.attractors.size());
  for (std::size_t k = 0; k < one.labels.size(); ++k) {
    EXPECT_EQ(one.labels[k].outcome, other.labels[k].outcome) << k;
    EXPECT_EQ(one.labels[k].attractor, other.labels[k].attractor) << k;
  }
  for (std::size_t k = 0; k < one.attractors.size(); ++k) {
    EXPECT_EQ(one.attractors[k].states, other.attractors[k].states);
    EXPECT_EQ(one.attractors[k].mirror_image, other.attractors[k].mirror_image);
    EXPECT_TRUE(is_phase_shifted_copy(one.attractors[k].orbit, other.attractors[k].orbit));
  }
}

TEST(PackedBasins, AreThoseOfOneLaneOnAnyNumberOfThreads) {
  const auto one_after_the_other = [](std::size_t count, std::size_t tile, const auto& job) {
    for (std::size_t first = 0; first < count; first += tile)
      job(first, std::min(tile, count - first));
  };
  const auto states = packed_states(200);
  const OrbitLimits limits{20000, 0};
  for (const auto& loop : {test::kollar_loop(0.003, 0.002), test::kollar_loop(0.01, 0.002),
                           test::kollar_loop(0.01, 0.0)}) {
    const BasinMap scalar = find_basins<double>(loop, states, limits, one_after_the_other);
    const BasinMap alone = simd::find_basins(loop, states, limits, 1);
    const BasinMap together = simd::find_basins(loop, states, limits, 2);
    expect_same_map(alone, together);
    expect_same_map(scalar, alone);
  }
}

TEST(PackedBasins, OfAGrowingLoopAreEmpty) {
  IdealLoop<double> loop = test::kollar_loop(0.011, 0.002);
  loop.sampling.processing_delay = loop.sampling.period;
  const BasinMap map = simd::find_basins(loop, packed_states(50), {1000, 0}, 2);
  EXPECT_TRUE(map.attractors.empty());
  for (const BasinLabel& label : map.labels) EXPECT_EQ(label.outcome, OrbitOutcome::diverges);
}

TEST(PackedMemory, EveryLaneHoldsItsOwnMemory) {
  constexpr std::size_t count = Lanes<MotionPack>::count;
  test::Random random(882);
  for (std::size_t inside = 0; inside < (std::size_t{1} << count); ++inside) {
    std::vector<ForcedMotionMemory<double>> memories;
    for (std::size_t lane = 0; lane < count; ++lane) {
      memories.push_back(
          {random.matrix<Vector<double, 4>>(),
           random.unit(),
           {((inside >> lane) & 1U) != 0, random.unit(), random.unit(), random.unit()}});
    }
    const auto packed =
        detail::packed_memory<MotionPack>([&](std::size_t lane) { return memories[lane]; });
    for (std::size_t lane = 0; lane < count; ++lane) {
      const auto back = detail::memory_of_lane(packed, lane);
      EXPECT_EQ(back.state, memories[lane].state);
      EXPECT_EQ(back.previous_force, memories[lane].previous_force);
      EXPECT_EQ(back.backlash.inside, memories[lane].backlash.inside);
      EXPECT_EQ(back.backlash.lower, memories[lane].backlash.lower);
      EXPECT_EQ(back.backlash.upper, memories[lane].backlash.upper);
      EXPECT_EQ(back.backlash.previous_velocity, memories[lane].backlash.previous_velocity);
    }
  }
}

}  // namespace
}  // namespace holdfast
