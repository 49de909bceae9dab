#include "holdfast/orbit/orbit_verification.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "holdfast/orbit/orbit_search.hpp"
#include "support/kollar_case.hpp"

namespace holdfast {
namespace {

IdealLoop<double> verified_loop(double period, double width) {
  test::KollarCase which;
  which.sampling_period = period;
  which.width = width;
  which.processing_delay = 0.2 * period;
  return which.ideal_loop();
}

TEST(OrbitVerification, ACertificateStandsInLongDouble) {
  for (const double width : {0.0, 0.001, 0.002, 0.003}) {
    const IdealLoop<double> loop = verified_loop(0.01, width);
    const OrbitResult found = find_periodic_orbit(loop, Vector<double, 4>::Zero(), {20000, 0});
    ASSERT_EQ(found.outcome, OrbitOutcome::certified) << width;
    const OrbitVerification verification = verify_orbit<long double>(loop, *found.orbit);
    EXPECT_TRUE(verification.same_itinerary);
    EXPECT_LE(verification.displacement_difference, 1e-14);
    EXPECT_LE(verification.velocity_difference, 1e-12);
    EXPECT_GT(verification.displacement_difference, 0.0) << "another number type";
    EXPECT_LE(verification.closure_error, 1e-17);
    const OrbitVerification same = verify_orbit<double>(loop, *found.orbit);
    EXPECT_TRUE(same.same_itinerary);
    EXPECT_EQ(same.displacement_difference, 0.0);
    EXPECT_EQ(same.closure_error, found.orbit->closure_error);
  }
}

TEST(OrbitVerification, SeesThatAnOrbitIsAnotherLoops) {
  const IdealLoop<double> loop = verified_loop(0.01, 0.002);
  PeriodicOrbit orbit =
      find_periodic_orbit(loop, Vector<double, 4>::Zero(), {20000, 0}).orbit.value();
  IdealLoop<double> other = loop;
  other.excitation.amplitude *= 1.01;
  EXPECT_GT(verify_orbit<long double>(other, orbit).displacement_difference, 1e-6);
  other.backlash_width *= 0.5;
  EXPECT_FALSE(verify_orbit<long double>(other, orbit).same_itinerary);
  orbit.itinerary.front() ^= 1U;
  EXPECT_FALSE(verify_orbit<long double>(loop, orbit).same_itinerary);
}

}  // namespace
}  // namespace holdfast
