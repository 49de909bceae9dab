#include "holdfast/orbit/itinerary_maps.hpp"

#include "support/kollar_case.hpp"
#include "support/random.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

TEST(ItineraryMaps, StepTheMotionItself) {
  for (const double fraction : {0.0, 0.4, 1.0}) {
    const IdealLoop<double> loop = test::kollar_loop(0.003, 0.002, fraction);
    const Rational ratio = forcing_ratio(loop).value();
    const ItineraryMaps<double> maps(loop, ratio);
    ASSERT_EQ(maps.samples_of_forcing(), 100U);
    auto motion = periodically_forced_motion(loop, ratio, Vector<double, 4>::Zero().eval());
    int inside = 0;
    for (std::size_t j = 0; j < 400; ++j) {
      const auto memory = motion.memory();
      Vector<double, 5> state;
      state << memory.state, memory.previous_force;
      const auto sample = motion.sense();
      motion.advance();
      const Vector<double, 5> next = maps.step(state, sample.engaged, j % 100);
      ASSERT_LE((next.head<4>() - motion.state()).cwiseAbs().maxCoeff(), 1e-14);
      ASSERT_NEAR(next[4], sample.control_force, 1e-12);
      inside += sample.engaged ? 0 : 1;
    }
    EXPECT_GT(inside, 10);
  }
}

TEST(MapsOfBlocks, TogetherAreTheWholeSequence) {
  test::Random random(810);
  for (const double period : {0.001, 0.01, 0.05}) {
    const IdealLoop<double> loop = test::kollar_loop(period, 0.002, 0.3);
    const ItineraryMaps<double> maps(loop, forcing_ratio(loop).value());
    Itinerary itinerary;
    for (int j = 0; j < 300; ++j) itinerary.push_back(random.unit() < 0.5 ? 1 : 0);
    Vector<double, 5> by_samples = random.matrix<Vector<double, 5>>();
    Vector<double, 5> by_blocks = by_samples.cwiseQuotient(maps.units());
    const auto blocks = maps_of_blocks(maps, itinerary);
    for (const auto& block : blocks) by_blocks = block * by_blocks;
    for (const std::uint8_t contact : itinerary) by_samples = maps.map(contact != 0) * by_samples;
    by_blocks = by_blocks.cwiseProduct(maps.units());
    EXPECT_LE((by_blocks - by_samples).norm(), 1e-11 * by_samples.norm()) << period;
    EXPECT_LE(blocks.size(), itinerary.size()) << period;
    if (period == 0.001) {
      EXPECT_LT(2 * blocks.size(), itinerary.size()) << "they are what saves the work";
    }
  }
}

TEST(MapsOfBlocks, OfAGrowingLoopStayShort) {
  IdealLoop<double> loop = test::kollar_loop(0.05, 0.002, 0.0);
  loop.gains = {-5000.0, -200.0};
  const ItineraryMaps<double> maps(loop, forcing_ratio(loop).value());
  const Itinerary itinerary(64, 1);
  const double one = maps_of_blocks(maps, {1}).front().cwiseAbs().maxCoeff();
  for (const auto& block : maps_of_blocks(maps, itinerary))
    EXPECT_LE(block.cwiseAbs().maxCoeff(), 5.0 * one * 1e3);
}

}  // namespace
}  // namespace holdfast
