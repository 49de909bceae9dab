// What the motions of Kollár 2022, §4.4, really are: periodic ones, each with its certificate.

#include "holdfast/orbit/orbit_search.hpp"
#include "holdfast/orbit/periodic_orbit.hpp"
#include "support/kollar_case.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

PeriodicOrbit certified_motion(double period, double width, double displacement = 0.0) {
  const IdealLoop<double> loop = test::kollar_loop(period, width);
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

struct KnownMotion {
  double sampling_period, width;  // s, m
  std::int64_t samples, forcing_periods;
};

TEST(Motions, RepeatAfterTheirForcingPeriods) {
  for (const KnownMotion& known : {KnownMotion{0.001, 0.0005, 100, 1},
                                   {0.001, 0.002, 500, 5},
                                   {0.01, 0.002, 30, 3},
                                   {0.011, 0.002, 2100, 231},
                                   {0.011, 0.001, 1700, 187}}) {
    const PeriodicOrbit orbit = certified_motion(known.sampling_period, known.width);
    EXPECT_EQ(orbit.period_samples(), known.samples);
    EXPECT_EQ(orbit.forcing_periods(), known.forcing_periods);
    EXPECT_NEAR(orbit.period(), 0.1 * static_cast<double>(known.forcing_periods), 1e-12);
  }
}

TEST(Motions, TheIrregularOneForgetsWhereItBegan) {
  EXPECT_NEAR(certified_motion(0.011, 0.002).largest_multiplier(), 1.8e-11, 0.1e-11);
}

TEST(Motions, AtThreeMillisecondsTwoMotionsCoexist) {
  const PeriodicOrbit from_rest = certified_motion(0.003, 0.002);
  const PeriodicOrbit from_beside = certified_motion(0.003, 0.002, 1e-5);
  EXPECT_NEAR(from_rest.period(), 5.7, 1e-12);
  EXPECT_NEAR(from_beside.period(), 0.3, 1e-12);
}

}  // namespace
}  // namespace holdfast
