#include "holdfast/orbit/proof/orbit_proof.hpp"

#include "orbit/proof/proved_orbits.hpp"
#include "support/property.hpp"

namespace holdfast {
namespace {

using test::orbit_to_prove;
using test::proved_loop;

using Proposed = test::ProposedOrbit;

std::vector<Proposed> proposals() {
  std::vector<Proposed> all;
  for (const auto& [period, width] :
       {std::pair{0.001, 0.0005}, std::pair{0.001, 0.002}, std::pair{0.01, 0.002},
        std::pair{0.011, 0.002}, std::pair{0.011, 0.001}, std::pair{0.003, 0.002},
        std::pair{0.001, 0.05}, std::pair{0.01, 0.001}}) {
    const IdealLoop<double> loop = proved_loop(period, width);
    all.push_back({loop, orbit_to_prove(loop)});
  }
  const IdealLoop<double> coexisting = proved_loop(0.003, 0.002);
  all.push_back({coexisting, orbit_to_prove(coexisting, 1e-5)});
  const IdealLoop<double> late = proved_loop(0.01, 0.002, 0.005);
  all.push_back({late, orbit_to_prove(late)});
  IdealLoop<double> smooth = proved_loop(0.001, 0.0005);
  smooth.hold = ForceHold::exact;
  all.push_back({smooth, orbit_to_prove(smooth)});
  return all;
}

/// The same motion in extended precision lies as near to the given states as is proved.
TEST(OrbitProof, OfThePapersMotions) {
  for (const auto& [loop, orbit] : proposals()) {
    const OrbitProof proof = prove_orbit(loop, orbit);
    EXPECT_EQ(proof.outcome, OrbitProofOutcome::proved) << loop.sampling.period;
    EXPECT_GE(proof.multiplier_bound, orbit.largest_multiplier());
    EXPECT_LT(proof.multiplier_bound, 1.0);
    const OrbitVerification wide = verify_orbit<long double>(loop, orbit);
    EXPECT_LE(wide.displacement_difference, proof.displacement_error);
    EXPECT_LE(wide.velocity_difference, proof.velocity_error);
    EXPECT_LT(proof.displacement_error, 1e-11);
    EXPECT_LT(proof.widths.from, loop.backlash_width);
    EXPECT_GT(proof.widths.to, loop.backlash_width);
  }
}

/// The ball is that of the floating-point certificate, where the segments of both are one period.
TEST(OrbitProof, TheBallIsThatOfTheCertificate) {
  int alike = 0;
  for (const auto& [loop, orbit] : proposals()) {
    const OrbitProof proof = prove_orbit(loop, orbit);
    const auto balls = attraction_balls(loop, orbit);
    ASSERT_FALSE(balls.empty());
    const double radius = attraction_radius(balls.front(), balls.front().memory);
    EXPECT_GE(proof.radius, radius * (1.0 - 1e-3)) << loop.sampling.period;
    alike += std::abs(proof.radius / radius - 1.0) < 1e-3 ? 1 : 0;
  }
  EXPECT_GE(alike, 6);
}

MotionMemory<double, BacklashMemory<double>> start_at(const IdealLoop<double>& loop,
                                                      const PeriodicOrbit& orbit,
                                                      const Vector<double, 6>& deviation) {
  const Vector<double, 6> moved = deviation.cwiseQuotient(deviation_weights(loop));
  const Vector<double, 5> first = orbit.states.front() + moved.head<5>();
  BacklashMemory<double> memory = orbit.memory;
  if (orbit.engaged_fraction() > 0.0) {
    memory.lower += moved[5];
    memory.upper += moved[5];
  }
  return {first.head<4>(), first[4], memory};
}

/// Whether a motion keeps the contacts of the orbit until it is within rounding of it.
bool keeps_contacts(const IdealLoop<double>& loop, const PeriodicOrbit& orbit,
                    const Vector<double, 6>& deviation) {
  auto motion = periodically_forced_motion(loop, orbit.ratio, Vector<double, 4>::Zero().eval());
  motion.restore(start_at(loop, orbit, deviation));
  const auto periods = static_cast<std::size_t>(3.0 - 14.0 / orbit.multipliers[0].log_modulus);
  const std::size_t samples = orbit.itinerary.size();
  for (std::size_t j = 0; j < periods * samples; ++j) {
    if (motion.sense().engaged != (orbit.itinerary[j % samples] != 0)) return false;
    motion.advance();
  }
  return (motion.state() - orbit.states.front().head<4>()).norm() <
         1e-3 * orbit.states.front().head<4>().norm();
}

/// The drive may leave its gap at the very first sample: its ball is no smaller for that.
TEST(OrbitProof, TheBallOfAnOrbitThatLeavesItsGapFirst) {
  IdealLoop<double> loop = proved_loop(0.01, 0.0074603);
  int found = 0;
  test::Random random(53);
  for (int trial = 0; trial < 400 && found < 5; ++trial) {
    loop.gains = {random.uniform(-900.0, 0.0), random.uniform(-15.0, 0.0)};
    loop.backlash_width = random.log_uniform(1e-4, 3e-3);
    const OrbitResult result =
        find_periodic_orbit(loop, Vector<double, 4>::Zero(), {1000, 100'000});
    if (result.outcome != OrbitOutcome::certified) continue;
    const PeriodicOrbit& orbit = *result.orbit;
    if (!orbit.memory.inside || orbit.itinerary.front() == 0) continue;
    ++found;
    const auto balls = attraction_balls(loop, orbit);
    ASSERT_FALSE(balls.empty());
    const OrbitProof proof = prove_orbit(loop, orbit);
    EXPECT_EQ(proof.outcome, OrbitProofOutcome::proved);
    EXPECT_GE(proof.radius, balls.front().radius * (1.0 - 1e-3));
  }
  EXPECT_EQ(found, 5);
}

/// Every start in the ball keeps the contacts; of those on a sphere three times as large some do
/// not: the proved radius is within that of the true one.
TEST(OrbitProof, TheBallIsNearlyTheLargest) {
  test::Random random(51);
  for (const auto& [loop, orbit] : proposals()) {
    const double radius = prove_orbit(loop, orbit).radius;
    int left = 0;
    const int trials = orbit.period_samples() > 1000 ? 150 : 400;
    for (int trial = 0; trial < trials; ++trial) {
      Vector<double, 6> direction;
      for (double& entry : direction) entry = random.normal();
      direction.normalize();
      EXPECT_TRUE(keeps_contacts(loop, orbit, 0.999999 * radius * direction));
      left += keeps_contacts(loop, orbit, 3.0 * radius * direction) ? 0 : 1;
    }
    EXPECT_GT(left, 0) << loop.sampling.period << ' ' << loop.backlash_width;
  }
}

TEST(OrbitProof, IsNotOfStatesThatWereMoved) {
  const IdealLoop<double> loop = proved_loop(0.001, 0.0005);
  const PeriodicOrbit orbit = orbit_to_prove(loop);
  for (const std::size_t sample : {std::size_t{0}, std::size_t{37}, orbit.states.size() - 1}) {
    PeriodicOrbit moved = orbit;
    moved.states[sample][0] += 1e-9;
    const OrbitProof proof = prove_orbit(loop, moved);
    EXPECT_EQ(proof.outcome, OrbitProofOutcome::not_closed);
    EXPECT_GE(proof.displacement_error, 1e-9) << "the motion is that far away";
    PeriodicOrbit slightly = orbit;
    slightly.states[sample][1] += 1e-9 * StateScale(orbit.states).velocity;
    EXPECT_EQ(prove_orbit(loop, slightly).outcome, OrbitProofOutcome::not_closed);
  }
}

/// States that follow one another without a miss but do not close by a little: all of them are that
/// far away, though each but the last is the image of the one before.
TEST(OrbitProof, BoundsWhatAWholePeriodMisses) {
  const IdealLoop<double> loop = proved_loop(0.001, 0.0005);
  const PeriodicOrbit orbit = orbit_to_prove(loop);
  const ItineraryMaps<double> maps(loop, orbit.ratio);
  PeriodicOrbit moved = orbit;
  Vector<double, 5> deviation = Vector<double, 5>::Unit(0) * 1e-9;
  double most = 0.0;
  for (std::size_t j = 0; j < orbit.states.size(); ++j) {
    moved.states[j] += deviation;
    most = std::max({most, std::abs(deviation[0]), std::abs(deviation[2])});
    deviation = maps.map(orbit.itinerary[j] != 0) * deviation;
  }
  EXPECT_GE(prove_orbit(loop, moved, 1.0).displacement_error, most);
}

/// Between which widths the contacts of an orbit stay as they are, in floating point.
OpenRange widths_in_doubles(const IdealLoop<double>& loop, const PeriodicOrbit& orbit) {
  OpenRange widths;
  const auto pattern =
      switching_pattern(orbit.states, Backlash<double>(loop.backlash_width, orbit.memory));
  const auto count = orbit.period_samples();
  const auto at = [&](std::int64_t j) {
    return relative_displacement(
        orbit.states[static_cast<std::size_t>((j % count + count) % count)]);
  };
  for (const SwitchingTest& test : switching_tests(pattern)) {
    const double value = test.sign * (at(test.sample) - at(test.entry));
    if (test.widths > 0) widths.from = std::max(widths.from, -value);
    if (test.widths < 0) widths.to = std::min(widths.to, value);
  }
  return widths;
}

TEST(OrbitProof, IsNotWhereASurfaceIsTouched) {
  const IdealLoop<double> loop = proved_loop(0.001, 0.0005);
  const PeriodicOrbit orbit = orbit_to_prove(loop);
  const OpenRange widths = widths_in_doubles(loop, orbit);
  for (const double outward : {1.0, -1.0}) {
    IdealLoop<double> near = loop;
    const auto beyond = [&](double by) {
      near.backlash_width = (outward > 0.0 ? widths.to : widths.from) + outward * by;
      PeriodicOrbit same = orbit;
      same.memory.upper = same.memory.lower + near.backlash_width;
      return prove_orbit(near, same);
    };
    EXPECT_EQ(beyond(-1e-10).outcome, OrbitProofOutcome::proved);
    EXPECT_NE(beyond(1e-10).outcome, OrbitProofOutcome::proved);
    const OrbitProof touching = beyond(-1e-15);
    EXPECT_EQ(touching.outcome, OrbitProofOutcome::near_surface);
    EXPECT_NEAR(touching.nearest.distance, 1e-15, 2e-16);
    EXPECT_GT(touching.decided_by, 0.0);
    EXPECT_LT(touching.decided_by, 1.0);
    EXPECT_NE(touching.nearest.surface, SwitchingSurface::reversal);
    EXPECT_GE(touching.nearest.sample, 0);
  }
}

/// Beyond the widths the motion with these contacts is not the loop's any more.
TEST(OrbitProof, WidthsEndWhereTheContactsDo) {
  const IdealLoop<double> loop = proved_loop(0.01, 0.002);
  const PeriodicOrbit orbit = orbit_to_prove(loop);
  const OpenRange widths = prove_orbit(loop, orbit).widths;
  const auto reproduced = [&](double width) {
    IdealLoop<double> other = loop;
    other.backlash_width = width;
    return orbit_of_itinerary(other, orbit.ratio, ItineraryMaps<double>(other, orbit.ratio),
                              orbit.itinerary, Backlash<double>(width, orbit.memory))
               .outcome == OrbitOutcome::certified;
  };
  for (const double share : {1e-6, 0.3, 0.7, 1.0 - 1e-6})
    EXPECT_TRUE(reproduced(widths.from + share * (widths.to - widths.from))) << share;
  EXPECT_FALSE(reproduced(widths.from * (1.0 - 1e-6)));
  EXPECT_FALSE(reproduced(widths.to * (1.0 + 1e-6)));
}

/// Of the loop without backlash whose largest multiplier over one period is given, by its D.
Proposed with_multiplier(double modulus) {
  IdealLoop<double> loop = proved_loop(0.01, 0.0);
  const auto solved = [&](double gain) {
    loop.gains.differential = gain;
    const Itinerary engaged(10, std::uint8_t{1});
    return orbit_of_itinerary(loop, Rational{1, 10}, ItineraryMaps<double>(loop, Rational{1, 10}),
                              engaged, Backlash<double>(0.0));
  };
  double stable = -13.0, unstable = -60.0;
  for (int k = 0; k < 100; ++k) {
    const double middle = 0.5 * (stable + unstable);
    (solved(middle).orbit->largest_multiplier() < modulus ? stable : unstable) = middle;
  }
  const OrbitResult found = solved(stable);
  return {loop, *found.orbit};
}

TEST(OrbitProof, IsNotOfAMultiplierOutsideTheCircle) {
  const Proposed inside = with_multiplier(0.999), outside = with_multiplier(1.000001);
  EXPECT_NEAR(inside.orbit.largest_multiplier(), 0.999, 1e-9);
  EXPECT_NEAR(outside.orbit.largest_multiplier(), 1.000001, 1e-9);
  EXPECT_EQ(prove_orbit(inside.loop, inside.orbit).outcome, OrbitProofOutcome::proved);
  PeriodicOrbit claimed = outside.orbit;
  for (const double claim : {std::log(1.000001), std::log(0.999), -1.0}) {
    claimed.multipliers.front().log_modulus = claim;
    EXPECT_EQ(prove_orbit(outside.loop, claimed, 1e9).outcome, OrbitProofOutcome::not_contracting);
  }
}

TEST(OrbitProof, RefusesContactsThatAreNotThoseOfTheStates) {
  const IdealLoop<double> loop = proved_loop(0.01, 0.002);
  PeriodicOrbit orbit = orbit_to_prove(loop);
  orbit.itinerary[3] ^= 1;
  EXPECT_NE(prove_orbit(loop, orbit).outcome, OrbitProofOutcome::proved);
}

}  // namespace
}  // namespace holdfast
