// Kollár 2022, Fig. 8: the instants at which the drive enters and leaves its backlash.

#include "support/kollar_case.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

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

}  // namespace
}  // namespace holdfast
