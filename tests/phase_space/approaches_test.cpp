#include "holdfast/phase_space/approaches.hpp"

#include "motion/batch/event_pack_setting.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

/// Hands out some starts, each for so many periods, and keeps where they came to.
class CountedApproaches final : public LaneApproaches {
 public:
  CountedApproaches(std::vector<Vector<double, 4>> starts, std::int64_t period, int periods)
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

TEST(Approaches, EachMotionIsThatOfEventMotion) {
  const test::ExactMotion motion = test::kollar_exact(0.005, 0.001);
  test::Random random(3);
  std::vector<Vector<double, 4>> starts;
  for (int k = 0; k < 7; ++k) starts.push_back(0.003 * random.matrix<Vector<double, 4>>());
  CountedApproaches approaches(starts, 20, 5);
  run_approaches<double>(motion.loop, approaches);
  std::int64_t samples = 0;
  for (std::size_t k = 0; k < starts.size(); ++k) {
    auto alone = event_motion(motion.loop, starts[k]);
    const std::int64_t of_it = 20 * (5 + static_cast<std::int64_t>(k % 3));
    for (std::int64_t j = 0; j < of_it; ++j) {
      alone.sense();
      alone.advance();
    }
    samples += of_it;
    EXPECT_LE((alone.state() - approaches.ends[k]).cwiseAbs().maxCoeff(), 1e-12) << k;
  }
  EXPECT_EQ(approaches.samples, samples);
}

TEST(Approaches, OfNothingEndAtOnce) {
  CountedApproaches none({}, 20, 5);
  run_approaches<double>(test::kollar_exact(0.005, 0.001).loop, none);
  EXPECT_EQ(none.samples, 0);
}

}  // namespace
}  // namespace holdfast
