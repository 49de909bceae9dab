#include "holdfast/phase_space/motion_batch.hpp"
#include "holdfast/orbit/orbit_search.hpp"
#include "holdfast/phase_space/attractor_set.hpp"
#include "holdfast/phase_space/lane_scheduler.hpp"

#include "motion/batch/event_pack_setting.hpp"
#include "support/kollar_case.hpp"
#include "support/move_samples.hpp"
#include "support/random.hpp"

namespace holdfast {
namespace {

MotionBatch<double> batch_of(const IdealLoop<double>& loop) {
  return MotionBatch<double>(periodically_forced_motion(loop, forcing_ratio(loop).value(),
                                                        Vector<double, 4>::Zero().eval()));
}

std::vector<ActiveTrajectory> random_motions(std::size_t count) {
  test::Random random(861);
  std::vector<ActiveTrajectory> motions;
  for (std::size_t k = 0; k < count; ++k)
    motions.push_back({k, memory_of_start(0.05 * random.matrix<Vector<double, 4>>())});
  return motions;
}

TEST(MotionBatch, WithoutOrbitsMovesEveryMotionAsIfAlone) {
  const auto loop = test::kollar_loop(0.01, 0.002, 0.3);
  const Rational ratio = forcing_ratio(loop).value();
  auto motions = random_motions(7);
  const auto starts = motions;
  batch_of(loop).run(motions.data(), motions.size(), 1000, AttractorSet(loop));
  for (std::size_t k = 0; k < motions.size(); ++k) {
    auto alone = periodically_forced_motion(loop, ratio, Vector<double, 4>::Zero().eval());
    alone.restore(starts[k].memory);
    // A whole number of common periods, at least as many samples as were asked for.
    bool met = false;
    for (int j = 0; j <= 1100 && !met; ++j) {
      met = j >= 1000 && alone.state() == motions[k].memory.state;
      if (met) break;
      alone.sense();
      alone.advance();
    }
    EXPECT_TRUE(met) << k;
    EXPECT_EQ(alone.index() % 10, 0);
    EXPECT_EQ(alone.memory().previous_force, motions[k].memory.previous_force);
    EXPECT_EQ(alone.law().inside(), motions[k].memory.backlash.inside);
    EXPECT_EQ(motions[k].orbit, -1);
    EXPECT_FALSE(motions[k].diverged);
    EXPECT_EQ(motions[k].number, k);
  }
}

TEST(MotionBatch, MarksAttractedMotions) {
  const auto loop = test::kollar_loop(0.01, 0.002);
  AttractorSet attractor_set(loop);
  attractor_set.add(find_periodic_orbit(loop, Vector<double, 4>::Zero(), {3000, 0}).orbit.value());
  auto motions = random_motions(50);
  batch_of(loop).run(motions.data(), motions.size(), 20000, attractor_set);
  int captured = 0;
  for (const auto& motion : motions) {
    if (motion.orbit < 0) continue;
    EXPECT_EQ(attractor_set.attracted_by(motion.memory), motion.orbit);
    ++captured;
  }
  EXPECT_GT(captured, 0);
}

TEST(MotionBatch, MarksDivergedMotions) {
  const auto loop = test::kollar_loop(0.01, 0.002, 1.0);
  IdealLoop<double> growing = loop;
  growing.gains.differential *= 3.0;
  auto motions = random_motions(5);
  batch_of(growing).run(motions.data(), motions.size(), 5000, AttractorSet(growing));
  for (const auto& motion : motions) EXPECT_TRUE(motion.diverged);
}

/// Hands out some starts, each for so many periods, and keeps where they came to.
class CountedScheduler final : public LaneScheduler {
 public:
  CountedScheduler(std::vector<Vector<double, 4>> starts, std::int64_t period, int periods)
      : starts_(std::move(starts)), period_(period), periods_(periods), ends(starts_.size()) {}

  bool next(std::size_t lane, Vector<double, 4>& start) override {
    if (given_ == starts_.size()) return false;
    places_[lane] = {given_, -1};
    start = starts_[given_++];
    return true;
  }
  bool goes_on(std::size_t lane, const Vector<double, 4>& state, bool is_followed) override {
    EXPECT_TRUE(is_followed);
    auto& [number, done] = places_[lane];
    ends[number] = state;
    // Each goes on for one period longer than the one before.
    return ++done < periods_ + static_cast<int>(number % 3);
  }
  void took(std::size_t /*lane*/, ContactMode /*mode*/) override { ++samples; }
  std::int64_t period() const override { return period_; }

 private:
  std::vector<Vector<double, 4>> starts_;
  std::int64_t period_;
  int periods_;
  std::size_t given_ = 0;
  std::array<std::pair<std::size_t, int>, 8> places_{};

 public:
  std::vector<Vector<double, 4>> ends;
  std::int64_t samples = 0;
};

TEST(LaneScheduler, EachMotionIsThatOfEventMotion) {
  const test::ExactMotion motion = test::kollar_exact(0.005, 0.001);
  test::Random random(3);
  std::vector<Vector<double, 4>> starts;
  for (int k = 0; k < 7; ++k) starts.push_back(0.003 * random.matrix<Vector<double, 4>>());
  CountedScheduler scheduler(starts, 20, 5);
  run_on_lanes<double>(motion.loop, scheduler);
  std::int64_t samples = 0;
  for (std::size_t k = 0; k < starts.size(); ++k) {
    auto alone = event_motion(motion.loop, starts[k]);
    const std::int64_t of_it = 20 * (5 + static_cast<std::int64_t>(k % 3));
    test::move_samples(alone, of_it);
    samples += of_it;
    EXPECT_LE((alone.state() - scheduler.ends[k]).cwiseAbs().maxCoeff(), 1e-12) << k;
  }
  EXPECT_EQ(scheduler.samples, samples);
}

TEST(LaneScheduler, OfNothingEndAtOnce) {
  CountedScheduler none({}, 20, 5);
  run_on_lanes<double>(test::kollar_exact(0.005, 0.001).loop, none);
  EXPECT_EQ(none.samples, 0);
}

}  // namespace
}  // namespace holdfast
