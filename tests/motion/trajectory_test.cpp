#include "holdfast/motion/trajectory.hpp"

#include "support/kollar_case.hpp"
#include "support/random.hpp"

namespace {
std::size_t allocations = 0;
}  // namespace

// Every allocation of this program is counted, so that a test can show that a loop makes none. Not
// inlined: a compiler that sees `free` beside a call of `new` takes the pair for a mistake.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace holdfast {
namespace {

using test::KollarCase;

TEST(SamplesWithin, CountsBothEndsOfWholeMultiplesInSpiteOfRoundOff) {
  EXPECT_EQ(samples_within(0.3, 0.1), 4);
  EXPECT_EQ(samples_within(10.0, 0.001), 10001);
  EXPECT_EQ(samples_within(23.1, 0.011), 2101);
  EXPECT_EQ(samples_within(0.0, 0.001), 1);
  test::Random random(101);
  for (int draw = 0; draw < 10000; ++draw) {
    const auto microseconds = static_cast<std::int64_t>(1 + random.index(50'000));
    const auto periods = static_cast<std::int64_t>(random.index(1'000'000));
    const double duration = static_cast<double>(microseconds * periods) / 1e6;
    ASSERT_EQ(samples_within(duration, static_cast<double>(microseconds) / 1e6), periods + 1);
  }
}

TEST(SamplesWithin, ASampleAfterTheEndIsNotCounted) {
  EXPECT_EQ(samples_within(0.2999, 0.1), 3);
  EXPECT_EQ(samples_within(10.0, 0.011), 910);  // 909 · 0.011 = 9.999
  EXPECT_EQ(samples_within(0.05, 0.1), 1);
}

TEST(SamplesWithin, WhatIsOutOfRangeIsRefused) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
  for (const double duration : {-1.0, infinity, not_a_number}) {
    EXPECT_THROW(samples_within(duration, 0.1), InvalidParameter) << duration;
  }
  for (const double period : {0.0, -0.1, infinity, not_a_number}) {
    EXPECT_THROW(samples_within(1.0, period), InvalidParameter) << period;
  }
  EXPECT_THROW(samples_within(1e10, 1e-10), InvalidParameter);
}

TEST(Trajectory, ShowsEverySampleOnceToEveryObserver) {
  auto motion = KollarCase{}.motion();
  Recorder first(100), second(100);
  EXPECT_EQ(run_trajectory(motion, 100, std::nullopt, first, second), TrajectoryOutcome::completed);
  ASSERT_EQ(first.samples().size(), 100U);
  ASSERT_EQ(second.samples().size(), 100U);
  for (std::size_t j = 0; j < 100; ++j) {
    EXPECT_EQ(first.samples()[j].index, static_cast<std::int64_t>(j));
    EXPECT_EQ(second.samples()[j].state, first.samples()[j].state);
  }
}

TEST(Trajectory, GoesOnWhereItStopped) {
  auto whole = KollarCase{}.motion(), parts = KollarCase{}.motion();
  Recorder expected(5000), found(5000);
  run_trajectory(whole, 5000, std::nullopt, expected);
  for (const std::int64_t length : {1, 0, 2345, 2654})
    run_trajectory(parts, length, std::nullopt, found);
  ASSERT_EQ(found.samples().size(), 5000U);
  for (std::size_t j = 0; j < 5000; ++j) {
    ASSERT_EQ(found.samples()[j].index, expected.samples()[j].index);
    ASSERT_EQ(found.samples()[j].state, expected.samples()[j].state);
    ASSERT_EQ(found.samples()[j].engaged, expected.samples()[j].engaged);
  }
}

TEST(Trajectory, TheKickActsAtItsSampleAndOnlyThere) {
  KollarCase which;
  which.width = 0.0;
  const auto calm = test::record(which, 1.0), kicked = test::record(which, 1.0, Kick{0.84, 0.003});
  for (std::size_t j = 0; j < 840; ++j) ASSERT_EQ(kicked[j].state, calm[j].state);
  EXPECT_DOUBLE_EQ(kicked[840].state[0] - calm[840].state[0], 0.003);
  EXPECT_EQ(kicked[840].state.tail<3>(), calm[840].state.tail<3>());
  // Without backlash the difference of the two motions is the free motion of the loop.
  const Matrix<double, 5> step = which.loop().engaged_map(which.gains);
  Vector<double, 5> free = Vector<double, 5>::Unit(0) * 0.003;
  for (std::size_t j = 840; j < calm.size(); ++j) {
    ASSERT_LE((kicked[j].state - calm[j].state - free.head<4>()).cwiseAbs().maxCoeff(), 1e-14);
    free = step * free;
  }
}

TEST(Trajectory, AKickBetweenSamplesActsAtTheNext) {
  KollarCase which;
  which.sampling_period = 0.01;
  const auto calm = test::record(which, 0.2),
             kicked = test::record(which, 0.2, Kick{0.0951, 0.003});
  EXPECT_EQ(kicked[9].state, calm[9].state);
  EXPECT_DOUBLE_EQ(kicked[10].state[0] - calm[10].state[0], 0.003);
}

TEST(Trajectory, AKickMeantForASampleIsNotLateByRoundOff) {
  // 5 · 0.011 is below 0.055 in binary.
  for (int j = 1; j <= 1000; ++j) {
    KollarCase which;
    which.sampling_period = 0.011;
    which.excitation.amplitude = 0.0;
    auto motion = which.motion();
    double first_moved = -1;
    run_trajectory(motion, j + 2, Kick{static_cast<double>(11 * j) / 1000.0, 0.003},
                   [&](const auto& sample) {
                     if (first_moved < 0 && sample.state[0] != 0.0)
                       first_moved = static_cast<double>(sample.index);
                   });
    ASSERT_EQ(first_moved, j);
  }
}

TEST(Trajectory, AStateBeyondTheNumbersIsReportedAsDiverged) {
  KollarCase which;
  which.gains = {0.0, 5000.0};
  which.width = 0.0;
  auto motion = which.motion();
  std::int64_t seen = 0;
  bool all_finite = true;
  const auto outcome = run_trajectory(motion, 1'000'000, std::nullopt, [&](const auto& sample) {
    ++seen;
    all_finite = all_finite && sample.state.allFinite();
  });
  EXPECT_EQ(outcome, TrajectoryOutcome::diverged);
  EXPECT_GT(seen, 10);
  EXPECT_LT(seen, 1'000'000);
  EXPECT_TRUE(all_finite);
}

TEST(Trajectory, TheLoopOverSamplesAllocatesNothing) {
  auto motion = KollarCase{}.motion();
  PhaseExtent peak(0.0);
  Recorder recorder(10'000);
  const std::size_t before = allocations;
  run_trajectory(motion, 10'000, Kick{0.95, 0.003}, peak, recorder);
  EXPECT_EQ(allocations, before);
  EXPECT_GT(before, 0U) << "the counter must be the one in use";
  EXPECT_EQ(recorder.samples().size(), 10'000U);
}

}  // namespace
}  // namespace holdfast
