#include "holdfast/simd/lyapunov.hpp"

#include "support/random.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

using LanePack = simd::Pack<double>;

IdealLoop<double> flickering_loop(double period, double delay_fraction, double frequency = 10.0) {
  return {kollar2022_plant(),
          {period, delay_fraction * period},
          {-557.0, -13.0},
          {0.5, frequency},
          0.002};
}

std::vector<Vector<double, 4>> random_states(std::size_t count, std::uint64_t seed) {
  test::Random random(seed);
  std::vector<Vector<double, 4>> states;
  for (std::size_t k = 0; k < count; ++k) {
    const double size = random.log_uniform(1e-5, 1e-1);
    states.push_back(size * random.matrix<Vector<double, 4>>());
  }
  return states;
}

/// The scalar engine, one trajectory at a time.
LyapunovResult scalar_result(const IdealLoop<double>& loop, const Vector<double, 4>& state,
                             const LyapunovRun& run) {
  const auto sampled = sampled_loop(loop.plant, loop.sampling);
  const auto blocks = std::make_shared<const ItineraryBlocks>(sampled, loop.gains);
  if (const auto ratio = forcing_ratio(loop)) {
    auto motion = periodically_forced_motion(loop, *ratio, state);
    return run_lyapunov(motion, blocks, run);
  }
  SampledMotion<double> motion(sampled, loop.gains, held_harmonic(sampled), loop.excitation,
                               Backlash<double>(loop.backlash_width), state);
  return run_lyapunov(motion, blocks, run);
}

void expect_scalar_results(const IdealLoop<double>& loop,
                           const std::vector<Vector<double, 4>>& states, const LyapunovRun& run) {
  const auto results = simd::lyapunov_spectra(loop, states, run, 1);
  ASSERT_EQ(results.size(), states.size());
  for (std::size_t k = 0; k < states.size(); ++k) {
    const LyapunovResult expected = scalar_result(loop, states[k], run);
    EXPECT_EQ(results[k].outcome, expected.outcome) << k;
    EXPECT_EQ(results[k].samples, expected.samples) << k;
    for (int i = 0; i < 5; ++i) {
      if (std::isfinite(expected.exponents[i])) {
        EXPECT_NEAR(results[k].exponents[i], expected.exponents[i], 1e-10) << k << " " << i;
        EXPECT_NEAR(results[k].standard_errors[i], expected.standard_errors[i], 1e-10) << k;
      } else {
        EXPECT_EQ(std::isnan(results[k].exponents[i]), std::isnan(expected.exponents[i])) << k;
        EXPECT_EQ(results[k].exponents[i] < 0, expected.exponents[i] < 0) << k;
      }
    }
  }
}

TEST(LaneMaps, HoldTheMapOfEachLanesWord) {
  const auto loop = flickering_loop(0.01, 0.5);
  const ItineraryBlocks blocks(sampled_loop(loop.plant, loop.sampling), loop.gains);
  LaneBlocks<LanePack> lanes;
  for (std::size_t lane = 0; lane < lanes.size(); ++lane)
    lanes[lane] = static_cast<ItineraryBlock>(64 + 7 * lane);
  const LaneMaps<LanePack> maps(blocks, lanes);
  for (int row = 0; row < 5; ++row) {
    for (int column = 0; column < 5; ++column) {
      double values[Lanes<LanePack>::count];
      Lanes<LanePack>::store(maps(row, column), values);
      for (std::size_t lane = 0; lane < lanes.size(); ++lane)
        EXPECT_EQ(values[lane], blocks.map(lanes[lane])(row, column));
    }
  }
}

TEST(SimdLyapunov, LanesAreTheScalarEngine) {
  for (const double period : {0.001, 0.011}) {
    for (const double fraction : {0.0, 0.3}) {
      const auto loop = flickering_loop(period, fraction);
      for (const std::size_t count : {1U, 3U, 29U})
        expect_scalar_results(loop, random_states(count, 601), {2003, 101});
    }
  }
}

TEST(SimdLyapunov, FollowsAForcingThatNeverRepeats) {
  const auto loop = flickering_loop(0.011, 0.0, 10.0 * std::sqrt(1.1));
  ASSERT_FALSE(forcing_ratio(loop).has_value());
  expect_scalar_results(loop, random_states(11, 602), {3001, 0});
}

TEST(SimdLyapunov, EveryLaneStopsWhenItIsAccurate) {
  const LyapunovRun run{60000, 50, 2e-4};
  const auto loop = flickering_loop(0.011, 0.0);
  const auto states = random_states(13, 603);
  expect_scalar_results(loop, states, run);
  bool early = false, differ = false;
  const auto results = simd::lyapunov_spectra(loop, states, run);
  for (const auto& result : results) {
    early = early || result.outcome == LyapunovOutcome::accurate;
    differ = differ || result.samples != results[0].samples;
  }
  EXPECT_TRUE(early && differ) << "lanes of a pack are meant to end at different samples";
}

TEST(SimdLyapunov, TheLargestAlone) {
  LyapunovRun run{1501, 10};
  run.scope = LyapunovScope::largest;
  expect_scalar_results(flickering_loop(0.001, 1.0), random_states(9, 604), run);
}

TEST(SimdLyapunov, ADivergingLaneLeavesTheOthersAlone) {
  // Without an excitation: at rest it stays, from anywhere else S throws it out.
  auto loop = flickering_loop(0.011, 1.0);
  loop.excitation.amplitude = 0.0;
  auto states = random_states(9, 605);
  states[1].setZero();
  states[6].setZero();
  const LyapunovRun run{20001, 0};
  expect_scalar_results(loop, states, run);
  const auto results = simd::lyapunov_spectra(loop, states, run);
  EXPECT_EQ(results[0].outcome, LyapunovOutcome::diverged);
  EXPECT_EQ(results[1].outcome, LyapunovOutcome::sample_limit);
  EXPECT_LT(results[0].samples, results[1].samples);
}

TEST(SimdLyapunov, DoesNotDependOnTheNumberOfThreads) {
  const auto loop = flickering_loop(0.011, 0.0);
  const auto states = random_states(45, 606);
  const auto one = simd::lyapunov_spectra(loop, states, {1000, 7}, 1);
  for (const int threads : {0, 2, 3}) {
    const auto several = simd::lyapunov_spectra(loop, states, {1000, 7}, threads);
    for (std::size_t k = 0; k < states.size(); ++k)
      EXPECT_EQ(several[k].exponents, one[k].exponents);
  }
}

TEST(SimdLyapunov, TakesTheTangentsOfAnotherSampling) {
  const auto loop = flickering_loop(0.011, 0.0);
  const auto states = random_states(2, 607);
  const Sampling<double> printed{0.011, 0.011};
  const auto blocks =
      std::make_shared<const ItineraryBlocks>(sampled_loop(loop.plant, printed), loop.gains);
  const auto results = simd::lyapunov_spectra(loop, states, {2000, 0}, printed, 1);
  for (std::size_t k = 0; k < states.size(); ++k) {
    auto motion = periodically_forced_motion(loop, *forcing_ratio(loop), states[k]);
    const auto expected = run_lyapunov(motion, blocks, {2000, 0});
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(results[k].exponents[i], expected.exponents[i], 1e-10);
  }
}

TEST(SimdLyapunov, RefusesWhatIsNotAdmissible) {
  auto loop = flickering_loop(0.011, 0.0);
  EXPECT_THROW(simd::lyapunov_spectra(loop, {}, {0}), InvalidParameter);
  EXPECT_TRUE(simd::lyapunov_spectra(loop, {}, {10}).empty());
  loop.backlash_width = -1.0;
  EXPECT_THROW(simd::lyapunov_spectra(loop, {}, {10}), InvalidParameter);
}

}  // namespace
}  // namespace holdfast
