// Exponents and verdicts of a plant of another order than that of the two masses.

#include "holdfast/chaos/event_lyapunov.hpp"
#include "holdfast/chaos/motion_classification.hpp"
#include "support/lagging_loop.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

template <class Plant>
StateOf<Plant> rest_of_plant(const ImplementedLoopOf<Plant>& loop) {
  return StateOf<Plant>::Zero(loop.plant.state_matrix().rows());
}

template <class Plant>
LyapunovResult exponents_from_rest(const ImplementedLoopOf<Plant>& loop, const LyapunovRun& run) {
  auto motion = event_motion(loop, rest_of_plant(loop));
  return run_event_lyapunov(motion, run);
}

/// A loop under two frequencies that have no common period, whose verdict rests on its samples.
template <class Plant>
ImplementedLoopOf<Plant> without_common_period(ImplementedLoopOf<Plant> loop) {
  loop.digital.force.harmonics.push_back({0.2, 10.0 * std::sqrt(2.0)});
  return loop;
}

TEST(VerdictOfAnyOrder, OfSevenIsPeriodicWithTheExponentOfItsMultiplier) {
  for (const Switching switching : {Switching::sampled, Switching::exact}) {
    const auto loop = test::lagging_loop(test::lagging_plant(), switching);
    const auto found = classify_motion(loop, rest_of_plant(loop));
    EXPECT_EQ(found.classification.kind, AttractorType::periodic);
    ASSERT_TRUE(found.search.orbit.has_value());
    EXPECT_EQ(found.classification.period, found.search.orbit->period_samples());
    const double expected = found.search.orbit->multipliers.front().log_modulus /
                            static_cast<double>(found.search.orbit->period_samples());
    const LyapunovRun run{100000, 2000};
    const LyapunovResult result = exponents_from_rest(loop, run);
    std::cout << "exponent " << expected << ", over the run less " << result.exponents[0] - expected
              << "\n";
    EXPECT_NEAR(result.exponents[0], expected, 3.0 / static_cast<double>(run.samples));
  }
}

TEST(VerdictOfAnyOrder, OfSevenUnderTwoFrequenciesIsJudgedByItsSamples) {
  const auto plant = test::lagging_plant();
  const auto loop = without_common_period(test::lagging_loop(plant, Switching::exact));
  const auto found = classify_motion(loop, rest_of_plant(loop));
  EXPECT_EQ(found.search.outcome, OrbitOutcome::incommensurate);
  EXPECT_EQ(found.classification.kind, AttractorType::quasi_periodic);
  EXPECT_TRUE(found.indicators.largest_exponent->negative());
}

}  // namespace
}  // namespace holdfast
