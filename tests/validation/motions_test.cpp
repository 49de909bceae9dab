// What the motions of Kollár 2022, §4.4, really are: periodic ones, each with its certificate.

#include "holdfast/orbit/orbit_search.hpp"
#include "holdfast/orbit/periodic_orbit.hpp"
#include "support/kollar_case.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

using test::KollarCase;

PeriodicOrbit certified_motion(double period, double width, double displacement = 0.0) {
  KollarCase which;
  which.sampling_period = period;
  which.width = width;
  const IdealLoop<double> loop = which.ideal_loop();
  const OrbitResult found = find_periodic_orbit(loop, {displacement, 0.0, 0.0, 0.0});
  EXPECT_EQ(found.outcome, OrbitOutcome::certified);
  PeriodicOrbit orbit = found.orbit.value();
  EXPECT_TRUE(orbit.is_attracting());
  EXPECT_LE(orbit.closure_error, 1e-12);
  const OrbitVerification verification = verify_orbit<long double>(loop, orbit);
  EXPECT_TRUE(verification.same_itinerary);
  EXPECT_LE(verification.displacement_difference, 1e-12);
  return orbit;
}

TEST(Motions, HalfAMillimetreAtOneMillisecondRepeatsWithTheForcing) {
  const PeriodicOrbit orbit = certified_motion(0.001, 0.0005);
  EXPECT_EQ(orbit.period_samples(), 100);
  EXPECT_NEAR(orbit.period(), 0.1, 1e-12);
  EXPECT_EQ(orbit.forcing_periods(), 1);
}

TEST(Motions, TwoMillimetresAtOneMillisecondRepeatEveryFiveForcingPeriods) {
  const PeriodicOrbit orbit = certified_motion(0.001, 0.002);
  EXPECT_NEAR(orbit.period(), 0.5, 1e-12);
  EXPECT_EQ(orbit.forcing_periods(), 5);
}

TEST(Motions, TwoMillimetresAtTenMillisecondsRepeatEveryThree) {
  EXPECT_NEAR(certified_motion(0.01, 0.002).period(), 0.3, 1e-12);
}

TEST(Motions, TheIrregularMotionIsPeriodicAfterTwentyThreeSeconds) {
  const PeriodicOrbit orbit = certified_motion(0.011, 0.002);
  EXPECT_EQ(orbit.period_samples(), 2100);
  EXPECT_EQ(orbit.forcing_periods(), 231);
  EXPECT_NEAR(orbit.period(), 23.1, 1e-12);
  EXPECT_NEAR(orbit.largest_multiplier(), 1.8e-11, 0.1e-11);
}

TEST(Motions, OneMillimetreAtElevenMillisecondsTakesNearlyNineteenSeconds) {
  EXPECT_NEAR(certified_motion(0.011, 0.001).period(), 18.7, 1e-12);
}

TEST(Motions, AtThreeMillisecondsTwoMotionsCoexist) {
  const PeriodicOrbit from_rest = certified_motion(0.003, 0.002);
  const PeriodicOrbit from_beside = certified_motion(0.003, 0.002, 1e-5);
  EXPECT_NEAR(from_rest.period(), 5.7, 1e-12);
  EXPECT_NEAR(from_beside.period(), 0.3, 1e-12);
}

}  // namespace
}  // namespace holdfast
