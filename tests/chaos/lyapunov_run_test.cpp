#include "holdfast/chaos/lyapunov_run.hpp"

#include "holdfast/chaos/event_lyapunov.hpp"
#include "support/contacts.hpp"
#include "support/dense_routes.hpp"
#include "support/kollar_case.hpp"
#include "support/random_loop.hpp"

namespace holdfast {
namespace {

test::KollarCase flickering(double period) {
  test::KollarCase which;
  which.sampling_period = period;
  which.width = 0.002;
  return which;
}

/// The sampled map, by the products of its contacts.
struct SampledRun {
  static auto motion(const test::KollarCase& which) { return which.motion(); }
  template <class Motion>
  static LyapunovResult run(Motion& motion, const test::KollarCase& which, const LyapunovRun& run) {
    return run_lyapunov(motion, std::make_shared<const ItineraryBlocks>(which.loop(), which.gains),
                        run);
  }
};

/// The event-driven flow, by its tangents.
struct EventRun {
  static auto motion(const test::KollarCase& which) {
    const ImplementedLoop loop = implemented_loop(which.ideal_loop());
    return EventMotion<>(loop.digital, test::exact_backlash(loop.plant, loop.backlash.width),
                         which.initial_state);
  }
  template <class Motion>
  static LyapunovResult run(Motion& motion, const test::KollarCase&, const LyapunovRun& run) {
    return run_event_lyapunov(motion, run);
  }
};

template <class Model>
class LyapunovRunOf : public testing::Test {
 protected:
  static LyapunovResult run_of(const test::KollarCase& which, const LyapunovRun& run) {
    auto motion = Model::motion(which);
    return Model::run(motion, which, run);
  }
};

using RunModels = testing::Types<SampledRun, EventRun>;
TYPED_TEST_SUITE(LyapunovRunOf, RunModels, );

LyapunovResult run_of(const test::KollarCase& which, const LyapunovRun& run) {
  auto motion = which.motion();
  return SampledRun::run(motion, which, run);
}

TYPED_TEST(LyapunovRunOf, LeavesOutTheSamplesToBeDiscardedAndTheMotionAfterTheLastOne) {
  for (const double period : {0.001, 0.011}) {
    const auto which = flickering(period);
    auto motion = TypeParam::motion(which);
    const auto result = TypeParam::run(motion, which, {1299, 701});
    EXPECT_FALSE(result.diverged);
    EXPECT_EQ(motion.index(), 2000);
    EXPECT_EQ(result.samples + result.settling, 1299);
  }
}

TYPED_TEST(LyapunovRunOf, AveragesLongerToASmallerError) {
  const auto which = flickering(0.011);
  LyapunovRun run{5000, 2000};
  const auto result = this->run_of(which, run);
  EXPECT_EQ(result.standard_errors[4], 0.0);
  const auto longer = this->run_of(which, {20 * run.samples, run.discard});
  EXPECT_LT(longer.standard_errors[0], 0.5 * result.standard_errors[0]);
  EXPECT_NEAR(result.exponents[0], longer.exponents[0],
              4.0 * (result.standard_errors[0] + longer.standard_errors[0]));
  run.scope = LyapunovScope::largest;
  const auto largest = this->run_of(which, run);
  EXPECT_TRUE(std::isfinite(largest.exponents[0]));
  EXPECT_TRUE(std::isnan(largest.exponents[1]) && std::isnan(largest.standard_errors[4]));
}

TYPED_TEST(LyapunovRunOf, ADivergingMotionHasTheExponentsOfTheSamplesBeforeItLeft) {
  test::KollarCase which = flickering(0.011);
  which.width = 0.0;
  which.processing_delay = 0.011;  // S has an eigenvalue outside the unit circle
  auto motion = TypeParam::motion(which);
  const auto result = TypeParam::run(motion, which, {100000});
  EXPECT_TRUE(result.diverged);
  EXPECT_EQ(result.samples + result.settling, motion.index());
  EXPECT_GT(result.exponents[0], 0.1);
  const auto early = this->run_of(which, {10, 99999});
  EXPECT_TRUE(early.diverged);
  EXPECT_EQ(early.samples, 0);
  EXPECT_TRUE(std::isnan(early.exponents[0]));
}

TYPED_TEST(LyapunovRunOf, RefusesWhatIsNoRun) {
  const auto which = flickering(0.011);
  EXPECT_THROW(this->run_of(which, {0}), InvalidParameter);
  EXPECT_THROW(this->run_of(which, {10, -1}), InvalidParameter);
}

TEST(LyapunovRun, TakesAllSamples) {
  for (const double period : {0.001, 0.011}) {
    for (const std::int64_t samples : {1, 4, 6, 1001}) {
      const auto which = flickering(period);
      const auto result = run_of(which, {samples});
      LyapunovObserver observer(which.loop(), which.gains);
      auto motion = which.motion();
      run_trajectory(motion, samples, std::nullopt, observer);
      EXPECT_EQ(result.samples + result.settling, samples);
      const auto settled = observer.spectrum().settled();
      EXPECT_EQ(result.settling, settled.left_out);
      EXPECT_EQ(result.exponents, settled.means);
    }
  }
}

TEST(LyapunovRun, KnowsTheSignThatItsStandardErrorLeavesNoDoubtOf) {
  EXPECT_TRUE(run_of(flickering(0.001), {200000, 2000}).sign_is_known());
  EXPECT_FALSE(run_of(flickering(0.011), {12}).sign_is_known()) << "too short to have an error";
  LyapunovResult result = run_of(flickering(0.011), {1200});
  result.standard_errors[0] = 1e-3;
  for (const double sign : {-1.0, 1.0}) {
    result.exponents[0] = sign * 2.7e-3;
    EXPECT_FALSE(result.sign_is_known());
    result.exponents[0] = sign * 2.8e-3;
    EXPECT_TRUE(result.sign_is_known());
  }
  result.exponents[0] = -std::numeric_limits<double>::infinity();
  EXPECT_TRUE(result.sign_is_known());
}

/// The largest exponent of a loop that always transmits, from all tangent vectors or from one, the
/// tangents from any start.
ExponentEstimate of_linear_loop(const IdealLoop<double>& loop, LyapunovScope scope,
                                std::int64_t samples) {
  auto motion = harmonically_forced_motion(loop, Vector<double, 4>::Zero());
  const auto blocks =
      std::make_shared<const ItineraryBlocks>(sampled_loop(loop.plant, loop.sampling), loop.gains);
  const LyapunovResult found = run_lyapunov(motion, blocks, {samples, 0, scope});
  return exponent_estimate(found.exponents[0], found.standard_errors[0]);
}

double log_radius(const IdealLoop<double>& loop) {
  return test::log_moduli_of(sampled_loop(loop.plant, loop.sampling).engaged_map(loop.gains))[0];
}

/// Moves D between itself and 0 to where ln rho is `target`. @return whether it can
bool move_to(double target, IdealLoop<double>& loop) {
  double far = loop.gains.differential, near = 0.0;
  const auto excess = [&](double gain) {
    loop.gains.differential = gain;
    return log_radius(loop) - target;
  };
  const bool is_above = excess(far) > 0.0;
  if (is_above == (excess(near) > 0.0)) return false;
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = 0.5 * (near + far);
    ((excess(middle) > 0.0) == is_above ? far : near) = middle;
  }
  return std::abs(excess(near)) < 1e-3 * std::abs(target);
}

TEST(LyapunovRun, HoldsTheExponentsOfLinearLoopsWithinTheirIntervals) {
  // From the first sample on, tangents as they come: half of the loops within 10⁻⁴ of the boundary.
  constexpr int loops = 1000;
  constexpr std::int64_t samples = 6000;
  int found = 0, covered = 0, near_covered = 0, told = 0;
  for (std::uint64_t seed = 1; found < loops; ++seed) {
    test::Random random(seed);
    const auto plant = test::random_plant(random);
    const auto sampling = test::random_sampling(plant, random);
    IdealLoop<double> loop{
        plant, sampling, test::random_gains(plant, sampling.period, random), {0.0, 1.0}};
    const bool is_near = found % 2 != 0;
    if (is_near && !move_to(random.sign() * random.log_uniform(1e-6, 1e-4), loop)) continue;
    const double exact = log_radius(loop);
    if (!is_near && !(exact < 0.01)) continue;
    ++found;
    const auto scope = random.unit() < 0.5 ? LyapunovScope::all : LyapunovScope::largest;
    const ExponentEstimate estimate = of_linear_loop(loop, scope, samples);
    const bool holds = std::abs(estimate.value - exact) <= estimate.half_width;
    covered += holds ? 1 : 0;
    near_covered += is_near && holds ? 1 : 0;
    told += estimate.half_width < 30.0 / samples ? 1 : 0;
  }
  std::printf("  %d of %d, %d of the near half, %d of them sharp\n", covered, found, near_covered,
              told);
  EXPECT_GE(covered, loops * 98 / 100);
  EXPECT_GE(near_covered, loops / 2 * 98 / 100);
  EXPECT_GE(told, loops * 9 / 10) << "and not by being wide";
}

TEST(LyapunovRun, DoesNotCallALoopUnstableForTheStartOfItsTangents) {
  // ln rho = −4.8e-6 a sample, of a pair whose partner decays within a thousand.
  test::KollarCase which;
  which.width = 0.0;
  which.gains.differential = 5.579;
  const auto exact = test::log_moduli_of(which.loop().engaged_map(which.gains))[0];
  EXPECT_NEAR(exact, -4.8e-6, 1e-7);
  const auto result = run_of(which, {100000});
  EXPECT_NEAR(result.exponents[0], exact, 2.6 * result.standard_errors[0]);
  EXPECT_LT(result.standard_errors[0], 2e-5);
}

}  // namespace
}  // namespace holdfast
