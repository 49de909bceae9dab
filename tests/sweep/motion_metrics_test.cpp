#include "holdfast/sweep/motion_metrics.hpp"

#include "sweep/sweep_setting.hpp"

namespace holdfast {
namespace {

using test::kollar_motion;
using test::metrics_by_definition;
using test::metrics_of;

MotionMetrics metrics_of(const SweepMotion& motion, double duration) {
  return metrics_of(std::vector<SweepMotion>{motion}, duration).front();
}

/// How many of the motions enter their gap.
int expect_definitions(const std::vector<SweepMotion>& motions, double duration) {
  const auto results = metrics_of(motions, duration);
  int switching = 0;
  for (std::size_t k = 0; k < motions.size(); ++k) {
    const auto recorded = test::record(motions[k], duration);
    const auto expected = metrics_by_definition(recorded, duration);
    EXPECT_TRUE(test::agree(results[k], expected, 1e-12, test::reach_of(recorded))) << k;
    switching += expected.engaged_fraction < 1.0 ? 1 : 0;
  }
  return switching;
}

TEST(MotionMetrics, AreTheirDefinitionsOnAnyLoop) {
  EXPECT_GT(expect_definitions(test::random_sweep_motions(2000, 901, 0.006), 0.2), 500);
}

TEST(MotionMetrics, AreTheirDefinitionsInTheCaseOfThePaper) {
  for (const ForceHold hold : {ForceHold::sampled, ForceHold::exact}) {
    std::vector<SweepMotion> motions{kollar_motion(), kollar_motion(0.003, 0.002),
                                     kollar_motion(0.001, 0.0)};
    for (auto& motion : motions) motion.loop.hold = hold;
    EXPECT_EQ(expect_definitions(motions, 20.0), 2);
  }
}

TEST(MotionMetrics, WithoutBacklashTheDriveAlwaysTransmits) {
  const auto metrics = metrics_of(kollar_motion(0.001, 0.0), 5.0);
  EXPECT_EQ(metrics.engaged_fraction, 1.0);
  EXPECT_NEAR(metrics.reversals_per_s, 20.0, 1.0) << "two in each period of the forcing";
}

TEST(MotionMetrics, OfAMotionAtRestAreZero) {
  auto motion = kollar_motion();
  motion.loop.excitation.amplitude = 0.0;
  const auto metrics = metrics_of(motion, 1.0);
  EXPECT_EQ(metrics.end, MotionEnd::completed);
  EXPECT_TRUE(std::isnan(metrics.first_peak));
  for (const double zero : {metrics.steady_peak, metrics.steady_rms, metrics.force_peak,
                            metrics.force_rms, metrics.reversals_per_s, metrics.absorber_stroke})
    EXPECT_EQ(zero, 0.0);
  EXPECT_EQ(metrics.engaged_fraction, 1.0);
}

TEST(MotionMetrics, ADivergingMotionEndsAtItsLastFiniteSample) {
  auto motions = test::random_sweep_motions(400, 902, 20.0);
  // With a gap a motion that grows may be chaotic, and the sample that overflows not sharp.
  for (auto& motion : motions) motion.loop.backlash_width = 0.0;
  const double duration = 4.0;
  const auto results = metrics_of(motions, duration);
  int diverged = 0, with_peak = 0;
  for (std::size_t k = 0; k < motions.size(); ++k) {
    const auto expected = metrics_by_definition(test::record(motions[k], duration), duration);
    if (expected.end != MotionEnd::diverged) continue;
    ++diverged;
    with_peak += std::isnan(expected.first_peak) ? 0 : 1;
    EXPECT_EQ(results[k].end, MotionEnd::diverged) << k;
    EXPECT_EQ(results[k].samples, expected.samples) << k;
    EXPECT_TRUE(test::agree(results[k].first_peak, expected.first_peak, 1e-12)) << k;
    EXPECT_EQ(results[k].steady_rms, std::numeric_limits<double>::infinity());
    EXPECT_EQ(results[k].absorber_stroke, std::numeric_limits<double>::infinity());
    EXPECT_TRUE(std::isnan(results[k].engaged_fraction));
    EXPECT_TRUE(std::isnan(results[k].reversals_per_s));
  }
  EXPECT_GT(diverged, 50);
  EXPECT_GT(with_peak, 20);
}

TEST(MotionMetrics, AMotionThatOutgrowsEverythingAtOnceIsSeen) {
  // Each sample multiplies the state by some 10³⁰: the range ends within a dozen samples.
  auto motion = kollar_motion(0.001, 0.0);
  motion.loop.gains = {0.0, 1e32};
  const auto expected = metrics_by_definition(test::record(motion, 1.0), 1.0);
  const auto metrics = metrics_of(motion, 1.0);
  ASSERT_EQ(expected.end, MotionEnd::diverged);
  EXPECT_EQ(metrics.end, MotionEnd::diverged);
  EXPECT_EQ(metrics.samples, expected.samples);
  EXPECT_TRUE(test::agree(metrics.first_peak, expected.first_peak, 1e-12));
}

TEST(MotionMetrics, AHugeMotionThatComesBackIsCompleted) {
  auto motion = kollar_motion();
  motion.initial_state << 1e70, 0.0, -1e70, 0.0;
  EXPECT_EQ(expect_definitions({motion}, 2.0), 1);
}

TEST(MotionMetrics, OfOneSampleHaveNoSteadyPart) {
  auto motion = kollar_motion(0.01);
  motion.initial_state << 0.001, 0.0, 0.003, 0.0;
  const auto metrics = metrics_of(motion, 0.009);
  EXPECT_EQ(metrics.samples, 1);
  for (const double none : {metrics.first_peak, metrics.steady_peak, metrics.steady_rms,
                            metrics.engaged_fraction, metrics.force_rms, metrics.reversals_per_s})
    EXPECT_TRUE(std::isnan(none));
  EXPECT_DOUBLE_EQ(metrics.force_peak, 0.557);
  EXPECT_EQ(metrics.absorber_stroke, 0.0);
}

TEST(MotionMetrics, WithoutDurationTheFirstSampleIsSteady) {
  auto motion = kollar_motion();
  motion.initial_state << -0.001, 0.0, 0.003, 0.0;
  const auto metrics = metrics_of(motion, 0.0);
  EXPECT_EQ(metrics.samples, 1);
  EXPECT_EQ(metrics.steady_peak, 0.001);
  EXPECT_EQ(metrics.steady_rms, 0.001);
  EXPECT_EQ(metrics.engaged_fraction, 1.0);
  EXPECT_TRUE(std::isnan(metrics.reversals_per_s));
}

TEST(MotionMetrics, TheSteadyPartBeginsAtHalfTheDurationInSpiteOfRoundOff) {
  for (const double period : {0.011, 0.003, 0.0007, 0.1}) {
    for (const int samples : {2, 10, 70, 1000}) {
      const auto span = detail::sample_span(0, samples * period, SamplingClock(period));
      EXPECT_EQ(span.samples, samples + 1) << period << " " << samples;
      EXPECT_EQ(span.first_steady, (samples + 1) / 2) << period << " " << samples;
    }
  }
}

TEST(MotionMetrics, DoNotDependOnTheOtherMotions) {
  auto motions = test::random_sweep_motions(60, 903, 1.0);
  for (const double width : {0.0, 0.001, 0.002}) motions.push_back(kollar_motion(0.002, width));
  const auto together = metrics_of(motions, 1.0);
  for (std::size_t k = 0; k < motions.size(); ++k)
    EXPECT_TRUE(test::same_bits(metrics_of(motions[k], 1.0), together[k])) << k;
}

TEST(MotionMetrics, RefuseWhatIsNotAdmissible) {
  auto motion = kollar_motion();
  EXPECT_THROW(metrics_of(motion, -1.0), InvalidParameter);
  EXPECT_TRUE(metrics_of(std::vector<SweepMotion>{}, 1.0).empty());
  motion.initial_state[2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(metrics_of(motion, 1.0), InvalidParameter);
  motion = kollar_motion();
  motion.loop.sampling.period = 0.0;
  EXPECT_THROW(metrics_of(motion, 1.0), InvalidParameter);
}

}  // namespace
}  // namespace holdfast
