#include "holdfast/motion/batch/lane_events.hpp"

#include "motion/batch/event_pack_setting.hpp"

namespace holdfast {
namespace {

/// The parabola of the largest curvature through both values is the lowest of all such functions.
TEST(LaneEvents, StaysAboveZeroWhereTheLowestParabolaDoes) {
  test::Random random(17);
  int stay = 0, fall = 0;
  for (int trial = 0; trial < 20'000; ++trial) {
    const double begin = random.log_uniform(1e-4, 1e2), end = random.log_uniform(1e-4, 1e2);
    const double drop = random.log_uniform(1e-4, 1e2);
    double least = std::min(begin, end);
    for (int k = 1; k < 1000; ++k) {
      const double x = 1e-3 * k;
      least = std::min(least, begin + (end - begin) * x - 4.0 * drop * x * (1.0 - x));
    }
    if (std::abs(least) < 1e-5 * drop) continue;  // between two of those x
    EXPECT_EQ(stays_above_zero(begin, end, drop), least > 0.0)
        << begin << ' ' << end << ' ' << drop;
    ++(least > 0.0 ? stay : fall);
    EXPECT_FALSE(stays_above_zero(-begin, end, drop));
    EXPECT_FALSE(stays_above_zero(begin, -end, drop));
  }
  EXPECT_GT(stay, 2000);
  EXPECT_GT(fall, 2000);
  EXPECT_FALSE(stays_above_zero(1.0, 1.0, std::numeric_limits<double>::infinity()));
  EXPECT_FALSE(stays_above_zero(1.0, std::numeric_limits<double>::quiet_NaN(), 1.0));
}

/// In the gap of a play, all lanes of one motion.
TEST(LaneEvents, AreThoseOfNextEvent) {
  test::Random random(61);
  int events = 0;
  LaneEventSearch<double> next_lane_event;
  for (int trial = 0; trial < 2000; ++trial) {
    test::ExactMotion motion = test::kollar_exact(0.005, 0.001);
    EventTable table(motion.loop);
    const LaneExcitation<double> excitation(
        [&](std::size_t) -> const DigitalLoop& { return motion.loop.digital; });
    LaneModes<double> modes({EventStart{&motion.loop, &table, motion.state}}, excitation);
    DriveContact<>& contact = modes.contact(0);
    contact.learn_sign(0, 1.0);
    const Vector<double, 4> z(0.001 * random.unit(), 0.1 * random.unit(), 0.001 * random.unit(),
                              0.0);
    ContactInstant now{z, 0.0, 0.0};
    now.state[3] = now.state[1];
    contact.reached(0, now);
    modes.enter(0);
    modes.flowed(0);
    Vector<double, 4> begin = now.state;
    begin[2] -= 0.0005;
    begin[3] += random.uniform(-1.0, 1.0);

    const double rate = modes.rate(), length = random.unit() / rate;
    const auto terms = LaneTerms<double>()(rate * length);
    const std::vector<LanePhasor<double>> none{{0.0, {0.0, 0.0}}};
    const TwoMassSeries<double> series(
        modes.accelerations(0.0), {begin[0], begin[1], begin[2], begin[3]}, none, length, terms);
    const LaneEvent<double> event = next_lane_event(modes, series, 0.0, true);
    const NextEvent<4> alone =
        next_event(table.motion(1).dynamics(), contact.guards(),
                   ModeStretch<4>{begin, 0.0, Series::Zero(terms.most), length});
    ASSERT_EQ(event.found, alone.guard >= 0);
    EXPECT_NEAR(event.at, alone.root.at, 1e-13);
    if (!event.found) continue;
    EXPECT_EQ(event.second, alone.guard == 1);
    EXPECT_FALSE(next_lane_event(modes, series, 0.0, false).found);
    ++events;
  }
  EXPECT_GT(events, 300);
}

}  // namespace
}  // namespace holdfast
