#include "holdfast/simd/motion_metrics.hpp"

#include "sweep/sweep_setting.hpp"

namespace holdfast {
namespace {

using MetricPack = simd::Pack<double>;

/// Whether the drive transmits, at every sample of every motion.
class SwitchingRecord : public detail::SweepMatrices {
 public:
  SwitchingRecord(const std::vector<SweepMotion>& motions, double duration) {
    for (const auto& motion : motions) {
      const auto samples = samples_within(duration, motion.loop.sampling.period);
      engaged_.emplace_back(static_cast<std::size_t>(samples), std::uint8_t{2});
    }
  }

  void operator()(const std::size_t* numbers, std::int64_t index, const Mask<MetricPack>& engaged) {
    std::uint8_t flags[Lanes<MetricPack>::count];
    Lanes<MetricPack>::store_flags(engaged, flags);
    for (std::size_t lane = 0; lane < Lanes<MetricPack>::count; ++lane) {
      auto& of_motion = engaged_[numbers[lane]];
      const auto j = static_cast<std::size_t>(index);
      if (j < of_motion.size()) of_motion[j] = flags[lane];
    }
  }

  const std::vector<std::uint8_t>& seen_of(std::size_t motion) const { return engaged_[motion]; }

 private:
  std::vector<std::vector<std::uint8_t>> engaged_;
};

std::vector<MotionMetrics> pack_metrics(const std::vector<SweepMotion>& motions, double duration) {
  std::vector<MotionMetrics> results(motions.size());
  simd::motion_metrics(motions.data(), motions.size(), duration, results.data());
  return results;
}

std::vector<std::uint8_t> switching_of(const test::RecordedMotion& motion) {
  std::vector<std::uint8_t> engaged;
  for (const auto& sample : motion.samples) engaged.push_back(sample.engaged ? 1 : 0);
  return engaged;
}

/// Compares 10⁴ motions, each of which differs in every parameter, with the library's stepper.
/// @param compare  (metrics on packs, metrics by their definitions, the recorded motion)
template <class Compare>
void compare_with_stepper(double gain_share, double duration, const Compare& compare) {
  const auto motions = test::random_sweep_motions(10'000, 921, gain_share);
  SwitchingRecord switching(motions, duration);
  std::vector<MotionMetrics> results(motions.size());
  motion_metrics<MetricPack>(motions.data(), motions.size(), duration, results.data(), switching);
  std::size_t samples_in_gap = 0;
  for (std::size_t k = 0; k < motions.size(); ++k) {
    const auto recorded = test::record(motions[k], duration);
    const auto engaged = switching_of(recorded);
    auto seen = switching.seen_of(k);
    seen.resize(std::min(seen.size(), engaged.size()));  // beyond that the motion has diverged
    ASSERT_EQ(seen, engaged) << k;
    samples_in_gap += static_cast<std::size_t>(std::count(engaged.begin(), engaged.end(), 0));
    compare(results[k], test::metrics_by_definition(recorded, duration), recorded);
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(samples_in_gap, 100'000U);
}

TEST(SimdMotionMetrics, PacksSwitchAsTheStepperDoesAndGiveItsMetrics) {
  // Gains at which rounding does not grow, so that contracted multiply-adds cannot matter.
  compare_with_stepper(0.006, 0.2,
                       [](const auto& result, const auto& expected, const auto& motion) {
                         EXPECT_TRUE(test::agree(result, expected, 1e-12, test::reach_of(motion)));
                       });
}

#ifndef __FMA__
// Stable, unstable and irregular motions alike: where no multiply-adds are contracted every lane
// does what the stepper does.
TEST(SimdMotionMetrics, ArePicturesOfTheSteppersMotionToTheLastBit) {
  compare_with_stepper(1.0, 1.0, [](const auto& result, const auto& expected, const auto&) {
    ASSERT_EQ(result.end, expected.end);
    ASSERT_EQ(result.samples, expected.samples);
    EXPECT_TRUE(test::agree(result.first_peak, expected.first_peak, 0.0));
    EXPECT_TRUE(test::agree(result.steady_peak, expected.steady_peak, 0.0));
    EXPECT_TRUE(test::agree(result.steady_rms, expected.steady_rms, 1e-12));
    EXPECT_TRUE(test::agree(result.engaged_fraction, expected.engaged_fraction, 0.0));
    EXPECT_TRUE(test::agree(result.force_peak, expected.force_peak, 0.0));
    EXPECT_TRUE(test::agree(result.force_rms, expected.force_rms, 1e-12));
    EXPECT_TRUE(test::agree(result.reversals_per_s, expected.reversals_per_s, 1e-12));
    EXPECT_TRUE(test::agree(result.absorber_stroke, expected.absorber_stroke, 0.0));
  });
}
#endif

TEST(SimdMotionMetrics, TheObserverSeesAndChangesNothing) {
  const auto motions = test::random_sweep_motions(50, 922, 0.006);
  SwitchingRecord switching(motions, 0.2);
  std::vector<MotionMetrics> results(motions.size());
  motion_metrics<MetricPack>(motions.data(), motions.size(), 0.2, results.data(), switching);
  const auto alone = pack_metrics(motions, 0.2);
  for (std::size_t k = 0; k < motions.size(); ++k)
    EXPECT_TRUE(test::agree(results[k], alone[k], 1e-12, alone[k].absorber_stroke)) << k;
}

TEST(SimdMotionMetrics, AreTheSameBitsInAnyPartition) {
  // Half of the motions are unstable, some diverge, and all numbers of samples differ.
  const auto motions = test::random_sweep_motions(300, 923, 2.0);
  const auto whole = pack_metrics(motions, 2.0);
  for (const std::size_t part : {1U, 3U, 7U, 64U}) {
    std::vector<MotionMetrics> parts(motions.size());
    for (std::size_t first = 0; first < motions.size(); first += part) {
      simd::motion_metrics(motions.data() + first, std::min(part, motions.size() - first), 2.0,
                           parts.data() + first);
    }
    for (std::size_t k = 0; k < motions.size(); ++k)
      EXPECT_TRUE(test::same_bits(parts[k], whole[k])) << part << " " << k;
  }
  int diverged = 0;
  for (const auto& metrics : whole) diverged += metrics.end == MotionEnd::diverged ? 1 : 0;
  EXPECT_GT(diverged, 5);
  EXPECT_LT(diverged, 250);
}

TEST(SimdMotionMetrics, AreTheSameBitsInAnyOrder) {
  const auto motions = test::random_sweep_motions(200, 924, 1.0);
  const auto expected = pack_metrics(motions, 1.0);
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < motions.size(); ++k) order.push_back(k * 73 % motions.size());
  std::vector<SweepMotion> shuffled;
  for (const std::size_t k : order) shuffled.push_back(motions[k]);
  const auto results = pack_metrics(shuffled, 1.0);
  for (std::size_t k = 0; k < motions.size(); ++k)
    EXPECT_TRUE(test::same_bits(results[k], expected[order[k]])) << k;
}

TEST(SimdMotionMetrics, ALaneThatDivergesAtOnceLeavesTheOthersAlone) {
  auto motions = test::random_sweep_motions(20, 925, 0.006);
  const auto before = pack_metrics(motions, 0.5);
  motions[5] = motions[6];
  motions[5].loop.sampling = {0.001, 0.0};
  motions[5].loop.gains = {0.0, 1e40};
  motions[5].loop.backlash_width = 0.0;
  const auto expected = test::metrics_by_definition(test::record(motions[5], 0.5), 0.5);
  const auto results = pack_metrics(motions, 0.5);
  ASSERT_EQ(expected.end, MotionEnd::diverged);
  EXPECT_EQ(results[5].end, MotionEnd::diverged);
  EXPECT_EQ(results[5].samples, expected.samples);
  for (std::size_t k = 0; k < motions.size(); ++k) {
    if (k == 5) continue;
    EXPECT_TRUE(test::same_bits(results[k], before[k])) << k;
  }
}

}  // namespace
}  // namespace holdfast
