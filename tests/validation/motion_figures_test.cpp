// Kollár 2022, Fig. 6 and §4.2: how much the control attenuates, with and without backlash.

#include "holdfast/orbit/orbit_search.hpp"
#include "holdfast/orbit/periodic_orbit.hpp"

#include "support/kollar_case.hpp"

namespace holdfast {
namespace {

using test::KollarCase;

/// The first local maximum of z₁ in the first second, or of −z₁.
double first_peak(const KollarCase& which, double sign) {
  const auto samples = test::record(which, 1.0);
  for (std::size_t j = 1; j + 1 < samples.size(); ++j) {
    const auto height = [&](std::size_t k) { return sign * samples[k].state[0]; };
    if (height(j) > height(j - 1) && height(j) > height(j + 1)) return height(j);
  }
  return 0.0;
}

double steady_amplitude(const KollarCase& which) {
  // From 9 s on, ten whole forcing periods.
  PhaseExtent extent(9.0 - 1e-9);
  auto motion = which.motion();
  run_trajectory(motion, 10000, std::nullopt, extent);
  return extent.displacement();
}

TEST(Figure6, WithBacklashTheSteadyAmplitudeIsAlmostHalfOfThatWithoutControl) {
  const double ratio =
      steady_amplitude(KollarCase{}) / steady_amplitude(KollarCase{}.without_control());
  EXPECT_NEAR(ratio, 0.540, 0.0005);
}

TEST(Figure6, WithBacklashTheFirstPeakIsAboutTwoThirdsOfThatWithoutControl) {
  const double ratio =
      first_peak(KollarCase{}, 1.0) / first_peak(KollarCase{}.without_control(), 1.0);
  EXPECT_NEAR(ratio, 0.610, 0.0005);
  EXPECT_NEAR(ratio, 0.63, 0.025) << "the paper reads about 63 %";
}

TEST(Figure6, WithoutBacklashThePeakAboveTheEquilibriumIsAboutFourTimesSmaller) {
  KollarCase ideal;
  ideal.width = 0.0;
  const double ratio = first_peak(KollarCase{}.without_control(), -1.0) / first_peak(ideal, -1.0);
  EXPECT_NEAR(ratio, 3.86, 0.05);
  EXPECT_NEAR(ratio, 4.0, 0.5) << "the paper says about four";
}

TEST(Figure6, ABacklashOfAboutThreeMillimetresLeavesNoControlAtAll) {
  KollarCase wide;
  wide.width = 0.0028;
  const auto samples = test::record(wide, 35.0);
  const auto idle = test::record(wide.without_control(), 35.0);
  for (std::size_t j = 30000; j < samples.size(); ++j) {
    ASSERT_FALSE(samples[j].engaged) << samples[j].time;
    ASSERT_NEAR(samples[j].state[0], idle[j].state[0], 1e-8);
  }
}

TEST(Figure6, AtTwoAndAHalfMillimetresTheControlStillActs) {
  KollarCase narrower;
  narrower.width = 0.0025;
  int engaged = 0;
  const auto samples = test::record(narrower, 35.0);
  for (std::size_t j = 30000; j < samples.size(); ++j) engaged += samples[j].engaged ? 1 : 0;
  EXPECT_GT(engaged, 0);
}

// Kollár 2022, Fig. 8: the instants at which the drive enters and leaves its backlash.

struct Change {
  std::int64_t index;
  bool entered;
  friend bool operator==(const Change& a, const Change& b) {
    return a.index == b.index && a.entered == b.entered;
  }
};

std::ostream& operator<<(std::ostream& out, const Change& change) {
  return out << (change.entered ? "in at " : "out at ") << change.index << " ms";
}

/// The changes of contact from `from` ms to `to` ms.
template <class Law>
std::vector<Change> changes_between(std::int64_t from, std::int64_t to) {
  SwitchLog log;
  auto motion = test::KollarCase{}.motion<Law>();
  run_trajectory(motion, to + 1, std::nullopt, log);
  std::vector<Change> result;
  for (const auto& change : log.switches()) {
    if (change.index >= from) result.push_back({change.index, change.entered});
  }
  return result;
}

/// Another reading of the rule: a sample that leaves the gap may enter the next one at once.
class ReenteringBacklash {
 public:
  explicit ReenteringBacklash(double width) : width_(width) {}

  bool step(double displacement, double velocity) {
    if (inside_ && (displacement < lower_ || displacement > upper_)) inside_ = false;
    if (!inside_ && previous_ != 0.0 && previous_ * velocity <= 0.0) {
      inside_ = true;
      lower_ = previous_ > 0.0 ? displacement - width_ : displacement;
      upper_ = lower_ + width_;
    }
    previous_ = velocity;
    return !inside_;
  }

 private:
  double width_, lower_ = 0.0, upper_ = 0.0, previous_ = 0.0;
  bool inside_ = false;
};

TEST(Figure8, TheFourSwitchesOfThePaperHappenAtTheirSamples) {
  const std::vector<Change> paper = {{9065, true}, {9068, false}, {9069, true}, {9095, false}};
  EXPECT_EQ((changes_between<Backlash<double>>(9060, 9100)), paper);
}

TEST(Figure8, TheRelativeVelocityIsNegativeForTwoStepsAfterTheEntry) {
  const auto samples = test::record(test::KollarCase{}, 9.1);
  const auto relative_velocity = [&](std::size_t ms) {
    return samples[ms].state[3] - samples[ms].state[1];
  };
  EXPECT_GT(relative_velocity(9064), 0.0);
  EXPECT_LT(relative_velocity(9065), 0.0);
  EXPECT_LT(relative_velocity(9066), 0.0);
  EXPECT_GT(relative_velocity(9067), 0.0);
  EXPECT_LT(relative_velocity(9069), 0.0);
}

TEST(Figure8, TestingEntryAtTheSampleOfTheExitWouldBeAnotherMotion) {
  const std::vector<Change> other = {{9064, true}, {9086, false}};
  EXPECT_EQ(changes_between<ReenteringBacklash>(9060, 9090), other);
}

// Kollár 2022, Fig. 9: the steady motions in the phase plane, and how often they repeat.

using test::kollar_case;

/// Largest |z(t + lag) − z(t)| over the last `lag` samples, relative to the motion's size.
double closure(const KollarCase& which, double duration, std::size_t lag) {
  const auto samples = test::record(which, duration);
  double gap = 0, size = 0;
  for (std::size_t j = samples.size() - lag; j < samples.size(); ++j) {
    gap = std::max(gap, (samples[j].state - samples[j - lag].state).norm());
    size = std::max(size, samples[j].state.norm());
  }
  return gap / size;
}

TEST(Figure9, TheMotionOfHalfAMillimetreRepeatsWithTheForcing) {
  EXPECT_LT(closure(kollar_case(0.001, 0.0005), 60.0, 100), 1e-9);
}

TEST(Figure9, TheMotionOfTwoMillimetresRepeatsEveryFiveForcingPeriods) {
  EXPECT_LT(closure(kollar_case(0.001, 0.002), 60.0, 500), 1e-9);
  for (const std::size_t forcing_periods : {1U, 2U, 3U, 4U}) {
    EXPECT_GT(closure(kollar_case(0.001, 0.002), 60.0, 100 * forcing_periods), 1e-3)
        << forcing_periods;
  }
}

TEST(Figure9, TheIrregularMotionOfElevenMillisecondsIsBounded) {
  for (const auto& sample : test::record(kollar_case(0.011, 0.002), 1000.0)) {
    ASSERT_LT(sample.state.cwiseAbs().maxCoeff(), 1.0);
  }
}

TEST(Figure9, TheIrregularMotionRepeatsAfterTwentyThreeSeconds) {
  EXPECT_LT(closure(kollar_case(0.011, 0.002), 1000.0, 2100), 1e-9);
  EXPECT_GT(closure(kollar_case(0.011, 0.002), 1000.0, 100), 1e-3);
}

TEST(Figure9, AForceAWholePeriodLateWouldMakeThatMotionDiverge) {
  KollarCase late = kollar_case(0.011, 0.0);
  late.processing_delay = 0.011;
  auto motion = late.motion();
  EXPECT_EQ(run_trajectory(motion, 100'000, std::nullopt), TrajectoryOutcome::diverged);
}

// What the motions of Kollár 2022, §4.4, really are: periodic ones, each with its certificate.

PeriodicOrbit certified_motion(double period, double width, double displacement = 0.0) {
  const IdealLoop<double> loop = test::kollar_loop(period, width);
  const OrbitResult found = find_periodic_orbit(loop, {displacement, 0.0, 0.0, 0.0});
  EXPECT_EQ(found.outcome, OrbitOutcome::certified);
  PeriodicOrbit orbit = found.orbit.value();
  EXPECT_TRUE(orbit.is_attracting());
  EXPECT_LE(orbit.closure_error, 1e-12);
  const OrbitVerification verification = verify_orbit<long double>(loop, orbit);
  EXPECT_TRUE(verification.same_itinerary);
  EXPECT_LE(verification.displacement_difference, 1e-12);
  return orbit;
}

struct KnownMotion {
  double sampling_period, width;  // s, m
  std::int64_t samples, forcing_periods;
};

TEST(Motions, RepeatAfterTheirForcingPeriods) {
  for (const KnownMotion& known : {KnownMotion{0.001, 0.0005, 100, 1},
                                   {0.001, 0.002, 500, 5},
                                   {0.01, 0.002, 30, 3},
                                   {0.011, 0.002, 2100, 231},
                                   {0.011, 0.001, 1700, 187}}) {
    const PeriodicOrbit orbit = certified_motion(known.sampling_period, known.width);
    EXPECT_EQ(orbit.period_samples(), known.samples);
    EXPECT_EQ(orbit.forcing_periods(), known.forcing_periods);
    EXPECT_NEAR(orbit.period(), 0.1 * static_cast<double>(known.forcing_periods), 1e-12);
  }
}

TEST(Motions, TheIrregularOneForgetsWhereItBegan) {
  EXPECT_NEAR(certified_motion(0.011, 0.002).largest_multiplier(), 1.8e-11, 0.1e-11);
}

TEST(Motions, AtThreeMillisecondsTwoMotionsCoexist) {
  const PeriodicOrbit from_rest = certified_motion(0.003, 0.002);
  const PeriodicOrbit from_beside = certified_motion(0.003, 0.002, 1e-5);
  EXPECT_NEAR(from_rest.period(), 5.7, 1e-12);
  EXPECT_NEAR(from_beside.period(), 0.3, 1e-12);
}

}  // namespace
}  // namespace holdfast
