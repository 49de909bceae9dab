// What the instants of switching and the hold of the force make of the motions of Kollár 2022,
// §4.2: the largest |z₁| in the second half of three seconds from rest, and the modes of the drive.

#include "holdfast/motion/implemented_loop.hpp"
#include "support/contacts.hpp"
#include "support/kollar_case.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

struct SwitchingTableRow {
  double sampling_period, width, duration;  // s, m, s
  double held, sampled, exact;              // mm
};

constexpr std::array<SwitchingTableRow, 4> switching_table{{
    {0.001, 0.0005, 3.0, 0.699, 0.719, 0.6963},
    {0.001, 0.002, 3.0, 1.011, 0.969, 1.0029},
    {0.005, 0.001, 3.0, 0.652, 0.746, 0.7332},
    {0.011, 0.002, 3.003, 1.172, 1.299, 1.0089},
}};

ImplementedLoop table_loop(const SwitchingTableRow& row, ForceHold hold, Switching switching) {
  ImplementedLoop loop = implemented_loop(test::kollar_loop(row.sampling_period, row.width));
  loop.digital.hold = hold;
  loop.switching = switching;
  return loop;
}

/// Largest |z₁| (mm) at the samples of the second half.
double late_amplitude(const SwitchingTableRow& row, ForceHold hold, Switching switching) {
  auto motion = event_motion(table_loop(row, hold, switching), Vector<double, 4>::Zero());
  double largest = 0.0;
  run_trajectory(motion, samples_within(row.duration, row.sampling_period), std::nullopt,
                 [&](const MotionSample<double>& sample) {
                   if (not_before(sample.time, 0.5 * row.duration))
                     largest = std::max(largest, std::abs(sample.state[0]));
                 });
  return 1e3 * largest;
}

using ModeCounts = std::array<std::int64_t, 3>;  // engaged, gap, stick

/// How often each mode has begun by the samples that whole half cycles of the force end with.
std::vector<ModeCounts> modes_begun(const SwitchingTableRow& row) {
  const auto half_cycle = static_cast<std::int64_t>(std::lround(0.05 / row.sampling_period));
  EventMotion<> motion(table_loop(row, ForceHold::exact, Switching::exact).digital,
                       test::exact_backlash(kollar2022_plant(), row.width),
                       Vector<double, 4>::Zero());
  std::vector<ModeCounts> begun{motion.counts().entered};
  while (!not_before(motion.time(), row.duration)) {
    motion.sense();
    motion.advance();
    if (motion.index() % half_cycle == 0) begun.push_back(motion.counts().entered);
  }
  return begun;
}

TEST(SwitchingTable, LateAmplitudesAreTheStatedOnes) {
  for (const auto& row : switching_table) {
    SCOPED_TRACE(std::to_string(row.sampling_period) + " s, " + std::to_string(row.width) + " m");
    EXPECT_NEAR(late_amplitude(row, ForceHold::sampled, Switching::sampled), row.held, 0.0005);
    EXPECT_NEAR(late_amplitude(row, ForceHold::exact, Switching::sampled), row.sampled, 0.0005);
    EXPECT_NEAR(late_amplitude(row, ForceHold::exact, Switching::exact), row.exact, 0.00005);
  }
}

TEST(SwitchingTable, EveryHalfCycleHasOneStickOneGapAndOneEngagedPhase) {
  const std::vector<ModeCounts> begun = modes_begun(switching_table[0]);
  ASSERT_EQ(begun.size(), 61U);
  EXPECT_EQ(begun.back(), (ModeCounts{60, 60, 60}));
  for (std::size_t half = 31; half < begun.size(); ++half)
    for (std::size_t mode = 0; mode < 3; ++mode)
      EXPECT_EQ(begun[half][mode] - begun[half - 1][mode], 1) << "half cycle " << half;
}

}  // namespace
}  // namespace holdfast
