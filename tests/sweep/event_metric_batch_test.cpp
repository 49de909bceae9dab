#include "holdfast/sweep/event_metric_batch.hpp"

#include "holdfast/sweep/event_metrics.hpp"
#include "motion/batch/event_pack_setting.hpp"
#include "support/testing.hpp"
#include "sweep/sweep_setting.hpp"

namespace holdfast {
namespace {

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
