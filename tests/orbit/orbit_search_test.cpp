#include "holdfast/orbit/orbit_search.hpp"

#include "holdfast/orbit/event/event_orbit_search.hpp"
#include "support/kollar_case.hpp"
#include "support/random.hpp"

namespace holdfast {
namespace {

/// The sampled map.
struct SampledSearch {
  static OrbitResult find(const IdealLoop<double>& loop, const Vector<double, 4>& state,
                          const OrbitLimits& limits) {
    return find_periodic_orbit(loop, state, limits);
  }
};

/// The event-driven flow, switching exactly.
struct EventSearch {
  static auto find(const IdealLoop<double>& loop, const Vector<double, 4>& state,
                   const OrbitLimits& limits) {
    ImplementedLoop exact = implemented_loop(loop);
    exact.switching = Switching::exact;
    return find_event_orbit(event_motion(exact, state), limits);
  }
};

template <class Model>
class OrbitSearchOf : public testing::Test {
 protected:
  static auto from_rest(const IdealLoop<double>& loop, const OrbitLimits& limits) {
    return Model::find(loop, Vector<double, 4>::Zero(), limits);
  }
};

using SearchModels = testing::Types<SampledSearch, EventSearch>;
TYPED_TEST_SUITE(OrbitSearchOf, SearchModels, );

TYPED_TEST(OrbitSearchOf, ACommonPeriodAboveTheLargestIsNotLookedFor) {
  const IdealLoop<double> loop = test::kollar_loop(0.011, 0.0);
  EXPECT_EQ(this->from_rest(loop, {99, 60000}).outcome, OrbitOutcome::none_found);
  EXPECT_EQ(this->from_rest(loop, {100, 60000}).outcome, OrbitOutcome::certified);
}

TYPED_TEST(OrbitSearchOf, AGrowingMotionDiverges) {
  for (const double width : {0.0, 0.002}) {
    const auto found = TypeParam::find(test::kollar_loop(0.011, width, 1.0),
                                       Vector<double, 4>(0.05, 0.0, 0.0, 0.0), {10000, 0});
    EXPECT_EQ(found.outcome, OrbitOutcome::diverges) << width;
    EXPECT_LE(found.samples, 80000);
    EXPECT_FALSE(found.orbit);
  }
}

TYPED_TEST(OrbitSearchOf, RestWithoutExcitationTouchesTheSurfaceOfReversal) {
  IdealLoop<double> loop = test::kollar_loop(0.001, 0.002);
  loop.excitation.amplitude = 0.0;
  const auto found = this->from_rest(loop, {1000, 0});
  ASSERT_EQ(found.outcome, OrbitOutcome::on_surface);
  EXPECT_EQ(found.orbit->amplitude(), 0.0);
  EXPECT_EQ(found.orbit->forcing_periods(), 0);
}

TYPED_TEST(OrbitSearchOf, AFreeVibrationEndsAtRestInItsGap) {
  IdealLoop<double> loop = test::kollar_loop(0.001, 0.002);
  loop.excitation.amplitude = 0.0;
  const auto found = TypeParam::find(loop, Vector<double, 4>(0.0002, 0.0, 0.0, 0.01), {20000, 0});
  ASSERT_EQ(found.outcome, OrbitOutcome::certified);
  EXPECT_EQ(found.orbit->period_samples(), 1);
  EXPECT_EQ(found.orbit->engaged_fraction(), 0.0);
  EXPECT_LT(found.orbit->states.front().norm(), 1e-12);
}

TYPED_TEST(OrbitSearchOf, LooksAtNoMoreSamplesThanAllowed) {
  for (const std::int64_t most : {1, 99, 100, 234}) {
    const auto found = this->from_rest(test::kollar_loop(0.011, 0.002), {1000, most});
    EXPECT_EQ(found.outcome, OrbitOutcome::none_found) << most;
    EXPECT_LE(found.samples, most);
  }
}

TYPED_TEST(OrbitSearchOf, WhatIsOutOfRangeIsRefused) {
  const IdealLoop<double> loop = test::kollar_loop(0.011, 0.002);
  for (const OrbitLimits& bad : {OrbitLimits{0, 0}, OrbitLimits{100'000'001, 0},
                                 OrbitLimits{100, -1}, OrbitLimits{100, 1'000'000'001}})
    EXPECT_THROW(this->from_rest(loop, bad), InvalidParameter);
  Vector<double, 4> start = Vector<double, 4>::Zero();
  start[2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(TypeParam::find(loop, start, {}), InvalidParameter);
  IdealLoop<double> wrong = loop;
  wrong.backlash_width = -1.0;
  EXPECT_THROW(this->from_rest(wrong, {}), InvalidParameter);
}

OrbitResult search_from_rest(const IdealLoop<double>& loop, const OrbitLimits& limits = {}) {
  return find_periodic_orbit(loop, Vector<double, 4>::Zero(), limits);
}

TEST(OrbitSearch, AWideGapIsNeverLeft) {
  for (const double width : {0.0028, 0.004, 0.1}) {
    const OrbitResult found = search_from_rest(test::kollar_loop(0.001, width));
    ASSERT_EQ(found.outcome, OrbitOutcome::certified) << width;
    EXPECT_EQ(found.orbit->period_samples(), 100);
    EXPECT_EQ(found.orbit->engaged_fraction(), 0.0);
    IdealLoop<double> uncontrolled = test::kollar_loop(0.001, 0.0);
    uncontrolled.gains = {0.0, 0.0};
    const OrbitResult free = search_from_rest(uncontrolled);
    EXPECT_NEAR(found.orbit->amplitude(), free.orbit.value().amplitude(), 1e-12);
  }
}

TEST(OrbitSearch, ANearReturnFarFromAnOrbitIsNoCertificate) {
  // A free mode almost commensurate with the common period returns within 10⁻³ while the deviation
  // is large; much later the motion leaves the gap and diverges.
  IdealLoop<double> loop = test::kollar_loop(0.001, 0.01078);
  loop.plant.conductor_stiffness = 50.3638;
  loop.plant.conductor_damping = 1e-4;
  loop.plant.absorber_damping = 1e-4;
  loop.gains = {0.0, 40.0};
  const Vector<double, 4> start(-0.002417, -0.001491, 0.001238, 0.007386);
  EXPECT_EQ(find_periodic_orbit(loop, start, {100000, 0}).outcome, OrbitOutcome::diverges);
}

TEST(OrbitSearch, AMultiplierOfModulusOneNeitherAttractsNorRepels) {
  IdealLoop<double> loop = test::kollar_loop(0.001, 0.0);
  loop.plant.conductor_stiffness = 50.3638;
  loop.plant.conductor_damping = 0.0;
  loop.plant.absorber_damping = 0.0;
  loop.gains = {0.0, 0.0};
  EXPECT_EQ(search_from_rest(loop, {10000, 100000}).outcome, OrbitOutcome::none_found);
}

TEST(OrbitSearch, ALimitBelowThePeriodFindsNone) {
  // 2100 samples are needed.
  const IdealLoop<double> loop = test::kollar_loop(0.011, 0.002);
  const OrbitResult found = search_from_rest(loop, {2000, 0});
  EXPECT_NE(found.outcome, OrbitOutcome::certified);
  EXPECT_LE(found.samples, 16000);
  EXPECT_EQ(search_from_rest(loop, {2100, 60000}).orbit.value().period_samples(), 2100);
}

TEST(OrbitSearch, ACertifiedOrbitHasItsShortestPeriod) {
  for (const auto& loop : {test::kollar_loop(0.001, 0.002), test::kollar_loop(0.01, 0.001)}) {
    const PeriodicOrbit orbit = search_from_rest(loop).orbit.value();
    const auto samples = orbit.states.size();
    const auto step = static_cast<std::size_t>(orbit.ratio.denominator);
    const double size = orbit.amplitude();
    for (std::size_t lag = step; lag < samples; lag += step) {
      if (samples % lag != 0) continue;
      EXPECT_GT((orbit.states[lag] - orbit.states[0]).head<4>().norm(), 1e-4 * size) << lag;
    }
  }
}

TEST(OrbitSearch, EveryStateOfACertifiedOrbitLeadsToIt) {
  const IdealLoop<double> loop = test::kollar_loop(0.01, 0.002);
  test::Random random(841);
  for (int trial = 0; trial < 40; ++trial) {
    const Vector<double, 4> start = 0.05 * random.matrix<Vector<double, 4>>();
    const OrbitResult found = find_periodic_orbit(loop, start, {3000, 0});
    ASSERT_EQ(found.outcome, OrbitOutcome::certified) << trial;
    const auto& orbit = *found.orbit;
    auto motion = periodically_forced_motion(loop, orbit.ratio, start);
    // At least as far as the search went, and a whole number of periods beyond a transient.
    run_trajectory(motion, 100 * (1 + found.samples / 100) * orbit.period_samples(), std::nullopt);
    double nearest = 1.0;
    for (std::size_t j = 0; j < orbit.states.size(); j += 10)
      nearest = std::min(nearest, (orbit.states[j].head<4>() - motion.state()).norm());
    EXPECT_LT(nearest, 1e-10) << trial;
  }
}

}  // namespace
}  // namespace holdfast
