#include "holdfast/motion/batch/lane_excitation.hpp"

#include "holdfast/excitation/force_over_samples.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

DigitalLoop forced_loop(ForceHold hold) {
  DigitalLoop loop;
  loop.sampling = {0.003, 0.001};
  loop.hold = hold;
  loop.force.harmonics = {{0.5, 10.0, 0.3}, {0.2, 31.0, -2.0}};
  return loop;
}

TEST(LaneExcitation, IsTheForceOverSamples) {
  for (const ForceHold hold : {ForceHold::sampled, ForceHold::exact}) {
    const DigitalLoop loop = forced_loop(hold);
    LaneExcitation<double> lanes([&](std::size_t) -> const DigitalLoop& { return loop; });
    ForceOverSamples alone(loop.force, hold, loop.sampling.period);
    EXPECT_EQ(lanes.lines(), 2U);
    EXPECT_EQ(lanes.is_held(0), hold == ForceHold::sampled);
    std::vector<LanePhasor<double>> phasors(lanes.lines());
    const std::vector<double> instants{0.0, 0.0007, 0.003};
    lanes.fix_instants(instants);
    std::vector<LanePhasor<double>> fixed(lanes.lines());
    for (std::int64_t j = 0; j < 40; ++j) {
      lanes.begin_sample(j);
      alone.begin_sample(j, static_cast<double>(j) * loop.sampling.period);
      for (std::size_t k = 0; k < instants.size(); ++k) {
        lanes.turned(instants[k], phasors);
        EXPECT_NEAR(LaneExcitation<double>::force(phasors), alone.at(instants[k]), 1e-14);
        EXPECT_EQ(lanes.force_at(k), LaneExcitation<double>::force(phasors));
        lanes.turned_to(k, fixed);
        for (std::size_t l = 0; l < fixed.size(); ++l) {
          EXPECT_EQ(fixed[l].angular_frequency, phasors[l].angular_frequency);
          EXPECT_EQ(fixed[l].phase.cosine, phasors[l].phase.cosine);
          EXPECT_EQ(fixed[l].phase.sine, phasors[l].phase.sine);
        }
      }
    }
  }
}

TEST(LaneExcitation, WithoutHarmonicsThereIsNone) {
  DigitalLoop loop = forced_loop(ForceHold::exact);
  loop.force.harmonics.clear();
  LaneExcitation<double> lanes([&](std::size_t) -> const DigitalLoop& { return loop; });
  std::vector<LanePhasor<double>> phasors(lanes.lines());
  lanes.begin_sample(0);
  lanes.turned(0.001, phasors);
  EXPECT_EQ(LaneExcitation<double>::force(phasors), 0.0);
}

}  // namespace
}  // namespace holdfast
