#include "holdfast/orbit/orbit_verification.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "holdfast/orbit/orbit_search.hpp"
#include "support/kollar_case.hpp"

namespace holdfast {
namespace {

ForcedLoop<double> rechecked_loop(double period, double width) {
  test::KollarCase which;
  which.sampling_period = period;
  which.width = width;
  which.processing_delay = 0.2 * period;
  return which.forced_loop();
}

TEST(OrbitRecheck, ACertificateStandsInLongDouble) {
  for (const double width : {0.0, 0.001, 0.002, 0.003}) {
    const ForcedLoop<double> loop = rechecked_loop(0.01, width);
    const OrbitResult found = find_periodic_orbit(loop, Vector<double, 4>::Zero(), {20000, 0});
    ASSERT_EQ(found.outcome, OrbitOutcome::certified) << width;
    const OrbitRecheck recheck = recheck_orbit<long double>(loop, *found.orbit);
    EXPECT_TRUE(recheck.same_contacts);
    EXPECT_LE(recheck.displacement_difference, 1e-14);
    EXPECT_LE(recheck.velocity_difference, 1e-12);
    EXPECT_GT(recheck.displacement_difference, 0.0) << "another number type";
    EXPECT_LE(recheck.closure_error, 1e-17);
    const OrbitRecheck same = recheck_orbit<double>(loop, *found.orbit);
    EXPECT_TRUE(same.same_contacts);
    EXPECT_EQ(same.displacement_difference, 0.0);
    EXPECT_EQ(same.closure_error, found.orbit->closure_error);
  }
}

TEST(OrbitRecheck, SeesThatAnOrbitIsAnotherLoops) {
  const ForcedLoop<double> loop = rechecked_loop(0.01, 0.002);
  PeriodicOrbit orbit =
      find_periodic_orbit(loop, Vector<double, 4>::Zero(), {20000, 0}).orbit.value();
  ForcedLoop<double> other = loop;
  other.excitation.amplitude *= 1.01;
  EXPECT_GT(recheck_orbit<long double>(other, orbit).displacement_difference, 1e-6);
  other.backlash_width *= 0.5;
  EXPECT_FALSE(recheck_orbit<long double>(other, orbit).same_contacts);
  orbit.contacts.front() ^= 1U;
  EXPECT_FALSE(recheck_orbit<long double>(loop, orbit).same_contacts);
}

}  // namespace
}  // namespace holdfast
