#include "holdfast/sweep/event_metrics.hpp"
#include "holdfast/sweep/event_metric_batch.hpp"

#include "motion/batch/event_pack_setting.hpp"
#include "support/lagging_plant.hpp"
#include "sweep/sweep_setting.hpp"

namespace holdfast {
namespace {

MotionMetrics event_metrics_of(const SweepMotion& motion, double duration) {
  return event_metrics(implemented_loop(motion.loop), motion.initial_state, duration);
}

/// The metrics of another way to compute them: counts identical, lengths to 1e-12 of the motion's
/// reach, and forces to 1e-12 of what the gains make of the reach and of the fastest velocity that
/// the plant can give to it, since the terms of a force may cancel.
void expect_same_motion(const MotionMetrics& metrics, const MotionMetrics& expected,
                        const SweepMotion& motion, double duration) {
  const double reach = test::reach_of(test::record(motion, duration));
  const PdGains<double>& gains = motion.loop.gains;
  const double terms =
      reach * (std::abs(gains.proportional) +
               std::abs(gains.differential) * balanced_norm(motion.loop.plant.state_matrix()));
  EXPECT_EQ(metrics.end, expected.end);
  EXPECT_EQ(metrics.samples, expected.samples);
  EXPECT_TRUE(test::agree(metrics.engaged_fraction, expected.engaged_fraction, 0.0));
  EXPECT_TRUE(test::agree(metrics.reversals_per_s, expected.reversals_per_s, 0.0));
  const auto expect_close = [](double is, double should_be, double size) {
    EXPECT_EQ(std::isnan(is), std::isnan(should_be));
    if (std::isnan(is)) return;
    EXPECT_LE(std::abs(is - should_be), 1e-12 * size);
  };
  expect_close(metrics.first_peak, expected.first_peak, reach);
  expect_close(metrics.steady_peak, expected.steady_peak, reach);
  expect_close(metrics.steady_rms, expected.steady_rms, reach);
  expect_close(metrics.absorber_stroke, expected.absorber_stroke, reach);
  expect_close(metrics.force_peak, expected.force_peak, terms);
  expect_close(metrics.force_rms, expected.force_rms, terms);
}

/// @return how many of the motions switch
int expect_those_of_the_batch(const std::vector<SweepMotion>& motions, double duration) {
  const auto expected = test::metrics_of(motions, duration);
  int switching = 0;
  for (std::size_t k = 0; k < motions.size(); ++k) {
    SCOPED_TRACE(k);
    expect_same_motion(event_metrics_of(motions[k], duration), expected[k], motions[k], duration);
    switching += expected[k].engaged_fraction < 1.0 ? 1 : 0;
  }
  return switching;
}

TEST(EventMetrics, OfTheLoopOfThePaperAreThoseOfTheBatch) {
  std::vector<SweepMotion> motions;
  for (const ForceHold hold : {ForceHold::sampled, ForceHold::exact})
    for (const double width : {0.0, 0.0005, 0.002})
      for (const double period : {0.001, 0.003})
        motions.push_back(test::kollar_motion(period, width, hold));
  EXPECT_EQ(expect_those_of_the_batch(motions, 20.0), 8);
  for (const SweepMotion& motion : motions) {
    const double reach = test::reach_of(test::record(motion, 20.0));
    const auto expected = test::metrics_of({motion}, 20.0).front();
    EXPECT_TRUE(test::agree(event_metrics_of(motion, 20.0), expected, 1e-12, reach));
  }
}

TEST(EventMetrics, OfAnyLoopOfTheModelAreThoseOfTheBatch) {
  EXPECT_GT(expect_those_of_the_batch(test::random_sweep_motions(300, 911, 0.006), 0.2), 75);
}

TEST(EventMetrics, OfAMotionThatDivergesAreThoseOfTheBatch) {
  auto motions = test::random_sweep_motions(200, 912, 20.0);
  for (auto& motion : motions) motion.loop.backlash_width = 0.0;
  const auto expected = test::metrics_of(motions, 4.0);
  int diverged = 0;
  for (std::size_t k = 0; k < motions.size(); ++k) {
    if (expected[k].end != MotionEnd::diverged) continue;
    ++diverged;
    const auto metrics = event_metrics_of(motions[k], 4.0);
    EXPECT_EQ(metrics.end, MotionEnd::diverged) << k;
    // The sample at which a sum leaves the range depends on the order of its terms.
    EXPECT_NEAR(static_cast<double>(metrics.samples), static_cast<double>(expected[k].samples), 1.0)
        << k;
    EXPECT_TRUE(test::agree(metrics.first_peak, expected[k].first_peak, 1e-12)) << k;
    EXPECT_EQ(metrics.steady_peak, std::numeric_limits<double>::infinity());
    EXPECT_TRUE(std::isnan(metrics.reversals_per_s));
  }
  EXPECT_GT(diverged, 25);
}

// A plant that pushes out over the edge of the dead zone, and a command that pushes in.
TEST(EventMetrics, OfAMotionWhoseContactsAccumulateAreNotNumbers) {
  ImplementedLoop loop{{1.0, 1.0, 0.0, 1.0, 1.0, 300.0}, {{0.5, 0.0}, {-10.0, 0.0}, {}}};
  loop.digital.force.record = std::make_shared<const RecordedForce>(
      std::vector<double>{-1.0, 10.0}, std::vector<double>{-10.0, -10.0},
      RecordInterpolation::held);
  loop.digital.hold = ForceHold::exact;
  loop.backlash = {ContactLaw::dead_zone, 0.02};
  loop.switching = Switching::exact;
  const auto metrics = event_metrics(loop, Vector<double, 4>(-1.0, 0.0, -0.99, 0.001), 5.0);
  EXPECT_EQ(metrics.end, MotionEnd::accumulates);
  EXPECT_EQ(metrics.samples, 1);
  for (const double value : {metrics.first_peak, metrics.steady_peak, metrics.force_rms})
    EXPECT_TRUE(std::isnan(value));
}

TEST(EventMetrics, OfShortMotionsAreThoseOfTheBatch) {
  auto motion = test::kollar_motion(0.01, 0.0005);
  motion.initial_state << 0.001, 0.0, 0.003, 0.0;
  for (const double duration : {0.0, 0.009, 0.01, 0.02, 0.05})
    expect_those_of_the_batch({motion}, duration);
}

/// The metrics by their definitions, from all samples of a motion of a built loop.
MotionMetrics defined_metrics_of(const ImplementedLoop& loop, double duration) {
  test::RecordedMotion recorded{TrajectoryOutcome::completed, {}};
  for (auto motion = event_motion(loop, Vector<double, 4>::Zero());
       not_before(duration, motion.time()); motion.advance())
    recorded.samples.push_back(motion.sense());
  return test::metrics_by_definition(recorded, duration);
}

void expect_defined(const ImplementedLoop& loop, double duration) {
  const auto metrics = event_metrics(loop, Vector<double, 4>::Zero(), duration);
  const auto expected = defined_metrics_of(loop, duration);
  EXPECT_GT(expected.steady_peak, 0.0);
  EXPECT_TRUE(test::agree(metrics, expected, 1e-12, 0.0));
}

TEST(EventMetrics, AreTheirDefinitionsOfLoopsAsTheyAreBuilt) {
  for (const Switching switching : {Switching::sampled, Switching::exact}) {
    for (const ContactLaw law : {ContactLaw::kollar, ContactLaw::immediate, ContactLaw::play,
                                 ContactLaw::dead_zone, ContactLaw::none}) {
      ImplementedLoop loop = implemented_loop(test::kollar_motion(0.001, 0.001).loop);
      loop.backlash = {law, 0.001, 500.0, 1.0};
      loop.switching = switching;
      expect_defined(loop, 3.0);
      loop.digital.limits.displacement_quantum = 1e-4;
      loop.digital.limits.velocity = VelocitySensing::difference;
      loop.digital.limits.largest_force = 0.4;
      loop.digital.force.harmonics.push_back({0.2, 7.3, 1.0});
      loop.digital.force.record = std::make_shared<RecordedForce>(
          std::vector<double>{0.1, 1.0, 2.5}, std::vector<double>{0.1, -0.2, 0.3},
          RecordInterpolation::linear);
      loop.digital.hold = ForceHold::exact;
      expect_defined(loop, 3.0);
    }
  }
}

TEST(EventMetrics, OfAJitteringClockHaveItsTimes) {
  ImplementedLoop loop = implemented_loop(test::kollar_motion(0.003, 0.0005).loop);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    loop.digital.jitter = {0.0014, seed};
    // About a sample of the grid, before and after which the clock's may fall.
    for (const double duration : {1.5, 1.5005, 1.4995, 1.5015}) expect_defined(loop, duration);
  }
}

TEST(EventMetrics, TheSamplesOfAJitteringClockAreThoseWithinTheDuration) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const SamplingClock clock(0.01, {0.0049, seed});
    for (const double duration : {0.0, 0.002, 0.006, 0.012, 0.1, 0.104, 0.096, 7.0}) {
      const auto span = detail::sample_span(0, duration, clock);
      EXPECT_LE(clock.time(span.samples - 1), duration);
      EXPECT_GT(clock.time(span.samples), duration);
      EXPECT_TRUE(span.first_steady == span.samples ||
                  clock.time(span.first_steady) >= 0.5 * duration);
      EXPECT_TRUE(span.first_steady == 0 || clock.time(span.first_steady - 1) < 0.5 * duration);
    }
  }
}

TEST(EventMetrics, ASaturatedDriveDeliversNoMore) {
  ImplementedLoop loop = implemented_loop(test::kollar_motion(0.001, 0.0).loop);
  const double free = event_metrics(loop, Vector<double, 4>::Zero(), 2.0).force_peak;
  loop.digital.limits.largest_force = 0.5 * free;
  EXPECT_EQ(event_metrics(loop, Vector<double, 4>::Zero(), 2.0).force_peak, 0.5 * free);
}

TEST(EventMetrics, WithExactSwitchingTheDriveReversesTwiceInEachForcingPeriod) {
  ImplementedLoop loop =
      implemented_loop(test::kollar_motion(0.001, 0.0005, ForceHold::exact).loop);
  loop.switching = Switching::exact;
  const auto metrics = event_metrics(loop, Vector<double, 4>::Zero(), 20.0);
  EXPECT_NEAR(metrics.reversals_per_s, 20.0, 0.2);
  EXPECT_GT(metrics.engaged_fraction, 0.0);
  EXPECT_LT(metrics.engaged_fraction, 1.0);
}

TEST(EventMetrics, PauseIsCalledNowAndThenAndMayEndAll) {
  const ImplementedLoop loop = implemented_loop(test::kollar_motion(0.001, 0.0).loop);
  int pauses = 0;
  event_metrics(loop, Vector<double, 4>::Zero(), 40.0, [&] { ++pauses; });
  EXPECT_EQ(pauses, 3) << "at samples 0, 16384 and 32768";
  struct Ended {};
  EXPECT_THROW(event_metrics(loop, Vector<double, 4>::Zero(), 40.0, [] { throw Ended(); }), Ended);
}

TEST(EventMetrics, RefuseWhatIsNotAdmissible) {
  ImplementedLoop loop = implemented_loop(test::kollar_motion(0.001, 0.0).loop);
  Vector<double, 4> state = Vector<double, 4>::Zero();
  EXPECT_THROW(event_metrics(loop, state, -1.0), InvalidParameter);
  state[1] = std::numeric_limits<double>::infinity();
  EXPECT_THROW(event_metrics(loop, state, 1.0), InvalidParameter);
  state[1] = 0.0;
  loop.backlash.width = -1.0;
  EXPECT_THROW(event_metrics(loop, state, 1.0), InvalidParameter);
}

TEST(EventMetrics, OfTheTwoMassesAsALinearPlantAreTheSame) {
  for (const Switching switching : {Switching::sampled, Switching::exact}) {
    const SweepMotion motion = test::kollar_motion(0.001, 0.0005);
    ImplementedLoop loop = implemented_loop(motion.loop);
    loop.switching = switching;
    const ImplementedLoopOf<LinearPlant<double>> same{test::through_ports(loop.plant), loop.digital,
                                                      loop.backlash, loop.switching};
    SCOPED_TRACE(static_cast<int>(switching));
    expect_same_motion(event_metrics(same, motion.initial_state, 3.0),
                       event_metrics(loop, motion.initial_state, 3.0), motion, 3.0);
  }
}

std::vector<MotionMetrics> batch_of(const std::vector<test::ExactMotion>& motions,
                                    double duration) {
  std::vector<EventSweepMotion> of;
  for (const auto& motion : motions) of.push_back({&motion.loop, motion.state});
  std::vector<MotionMetrics> results(motions.size());
  event_metrics<double>(of.data(), of.size(), duration, results.data(), [] {});
  return results;
}

void expect_same(const MotionMetrics& is, const MotionMetrics& should_be, double share) {
  EXPECT_EQ(is.end, should_be.end);
  EXPECT_EQ(is.samples, should_be.samples);
  for (const auto member :
       {&MotionMetrics::first_peak, &MotionMetrics::steady_peak, &MotionMetrics::steady_rms,
        &MotionMetrics::engaged_fraction, &MotionMetrics::force_peak, &MotionMetrics::force_rms,
        &MotionMetrics::reversals_per_s, &MotionMetrics::absorber_stroke})
    EXPECT_TRUE(test::agree(is.*member, should_be.*member, share));
}

TEST(EventMetricBatch, OfRegularMotionsAreThoseOfEventMetrics) {
  // Periods of all kinds beside each other; a tail of fewer than any pack has lanes.
  std::vector<test::ExactMotion> motions;
  for (const double period : {0.001, 0.005, 0.011})
    for (const double width : {0.0, 0.0005, 0.002})
      motions.push_back(test::kollar_exact(period, width));
  for (const double duration : {0.0, 0.02, 4.0}) {
    const auto metrics = batch_of(motions, duration);
    for (std::size_t k = 0; k < motions.size(); ++k) {
      SCOPED_TRACE(k);
      expect_same(metrics[k], event_metrics(motions[k].loop, motions[k].state, duration), 1e-11);
    }
  }
}

TEST(EventMetricBatch, AMotionThatDivergesEndsThere) {
  std::vector<test::ExactMotion> motions(3, test::kollar_exact(0.005, 0.001));
  motions[1].loop.digital.gains = {3e5, 3e5};
  const auto metrics = batch_of(motions, 20.0);
  EXPECT_EQ(metrics[1].end, MotionEnd::diverged);
  for (const std::size_t k : {0U, 1U, 2U}) {
    const MotionMetrics alone = event_metrics(motions[k].loop, motions[k].state, 20.0);
    EXPECT_EQ(metrics[k].end, alone.end);
    EXPECT_EQ(metrics[k].samples, alone.samples);
  }
}

TEST(EventMetricBatch, RefusesWhatIsNotAdmissible) {
  std::vector<test::ExactMotion> motions(2, test::kollar_exact(0.005, 0.001));
  motions[1].state[2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(batch_of(motions, 1.0), InvalidParameter);
  motions[1].state[2] = 0.0;
  motions[1].loop.plant.absorber_mass = 0.0;
  EXPECT_THROW(batch_of(motions, 1.0), InvalidParameter);
  EXPECT_TRUE(batch_of({}, 1.0).empty());
}

TEST(EventMetricBatch, APauseMayEndAll) {
  const test::ExactMotion motion = test::kollar_exact(0.005, 0.001);
  const EventSweepMotion of{&motion.loop, motion.state};
  MotionMetrics result{};
  int calls = 0;
  const auto stop = [&] {
    if (++calls == 3) throw std::runtime_error("stopped");
  };
  EXPECT_THROW(event_metrics<double>(&of, 1, 20.0, &result, stop), std::runtime_error);
}

}  // namespace
}  // namespace holdfast
