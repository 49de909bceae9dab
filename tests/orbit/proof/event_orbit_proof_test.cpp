#include "holdfast/orbit/proof/event_orbit_proof.hpp"

#include "orbit/proof/proved_event_orbits.hpp"
#include "support/plain_exact_motion.hpp"
#include "support/property.hpp"

namespace holdfast {
namespace {

using test::event_orbit_to_prove;
using test::event_orbits_to_prove;
using test::PlainExactMotion;
using test::proved_loop;
using ProposedEvents = test::ProposedEventOrbit;

/// A motion in extended precision from the given first state.
PlainExactMotion plain_motion_of(const ProposedEvents& proposed) {
  const auto& [phase, state, command, reading, contact] = proposed.first;
  test::PlainExactLoop loop = test::plain_exact_loop(proposed.loop);
  loop.p = proposed.orbit.ratio.numerator;
  loop.q = proposed.orbit.ratio.denominator;
  return {loop,
          {state[0], state[1], state[2], state[3], command},
          static_cast<int>(contact.mode()),
          contact.sign(),
          contact.sign() > 0.0 ? contact.upper() : contact.lower()};
}

/// What an orbit's states are away from the motion in extended precision that its first state comes
/// to: displacements and velocities.
Vector<double, 2> distance_in_extended_precision(const ProposedEvents& proposed) {
  PlainExactMotion motion = plain_motion_of(proposed);
  const double decay = -proposed.orbit.multipliers.front().log_modulus;
  for (double rest = 42.0; rest > 0.0; rest -= decay)
    for (std::size_t j = 0; j < proposed.orbit.states.size(); ++j) motion.step();
  Vector<double, 2> distance = Vector<double, 2>::Zero();
  for (const Vector<double, 4>& state : proposed.orbit.states) {
    for (Eigen::Index i = 0; i < 4; ++i) {
      const auto here = motion.state()[static_cast<std::size_t>(i)];
      distance[i % 2] =
          std::max(distance[i % 2],
                   static_cast<double>(std::abs(here - static_cast<long double>(state[i]))));
    }
    motion.step();
  }
  return distance;
}

/// The same motion in extended precision, by another program, lies as near as is proved.
TEST(EventOrbitProof, OfThePapersMotions) {
  for (const ProposedEvents& proposed : event_orbits_to_prove()) {
    const EventOrbitProof proof = proposed.proof();
    const double period = proposed.loop.sampling.period;
    ASSERT_EQ(proof.outcome, OrbitProofOutcome::proved) << period;
    EXPECT_GE(proof.multiplier_bound, proposed.orbit.largest_multiplier()) << period;
    EXPECT_LT(proof.multiplier_bound, 1.0);
    const Vector<double, 2> distance = distance_in_extended_precision(proposed);
    EXPECT_LE(distance[0], proof.displacement_error) << period;
    EXPECT_LE(distance[1], proof.velocity_error) << period;
    EXPECT_LT(proof.displacement_error, 1e-11);
    EXPECT_LT(proof.instant_error, 1e-9);
    EXPECT_GT(proof.nearest.decided_by(), 1.0);
    EXPECT_GT(proof.radius, 1e-10) << period;
  }
}

/// A start of the ball: a random one of the directions that its contact has, of a length (m).
StroboscopicState<DriveContact<>> start_in_ball(const ProposedEvents& proposed,
                                                test::Random& random, double length) {
  Vector<double, 6> direction;
  for (double& entry : direction) entry = random.normal();
  const Vector<double, 6> weights = deviation_weights(proposed.loop);
  const ContactMode mode = proposed.first.contact.word();
  if (!(proposed.loop.sampling.processing_delay > 0.0)) direction[4] = 0.0;
  if (mode == ContactMode::engaged) direction[5] = 0.0;
  if (mode == ContactMode::stick) {
    direction[3] = direction[1];
    direction[2] = direction[0] + direction[5];
  }
  direction *= length / direction.norm();
  const Vector<double, 6> by = direction.cwiseQuotient(weights);
  StroboscopicState<DriveContact<>> start = proposed.first;
  start.state += by.head<4>();
  start.previous_command += by[4];
  start.contact.shift_gap(by[5]);
  return start;
}

/// Whether two periods have the same changes of contact, in the same samples.
bool alike(const detail::RecordedContacts& one, const detail::RecordedContacts& other) {
  for (std::size_t j = 0; j < one.samples.size(); ++j) {
    const auto &a = one.samples[j], &b = other.samples[j];
    if (!(a.before == b.before && a.from == b.from) || a.switches.size() != b.switches.size())
      return false;
    for (std::size_t k = 0; k < a.switches.size(); ++k)
      if (!(a.switches[k].begun == b.switches[k].begun)) return false;
  }
  return true;
}

TEST(EventOrbitProof, AllStartsInTheBallKeepTheContacts) {
  test::Random random(61);
  for (const ProposedEvents& proposed : event_orbits_to_prove()) {
    const double radius = proposed.proof().radius;
    const auto path = proposed.recorded(proposed.first);
    const auto periods = 3 + static_cast<int>(-7.0 / proposed.orbit.multipliers[0].log_modulus);
    for (int trial = 0; trial < 4; ++trial) {
      auto motion = proposed.motion();
      motion.go_to(start_in_ball(proposed, random, 0.999 * radius));
      for (int k = 0; k < periods; ++k) {
        EXPECT_TRUE(alike(path, proposed.recorded(motion.point())));
        for (std::size_t j = 0; j < path.samples.size(); ++j) motion.sense(), motion.advance();
      }
      const Vector<double, 4> apart = motion.motion().state() - proposed.first.state;
      EXPECT_LT(std::max(std::abs(apart[0]), std::abs(apart[2])), 0.1 * radius + 1e-13);
    }
  }
}

TEST(EventOrbitProof, IsNotOfStatesThatWereMoved) {
  const ProposedEvents proposed = event_orbit_to_prove(proved_loop(0.001, 0.0005));
  for (const std::size_t sample : {std::size_t{0}, std::size_t{37}, std::size_t{99}}) {
    ProposedEvents moved = proposed;
    moved.orbit.states[sample][0] += 1e-9;
    EXPECT_EQ(moved.proof().outcome, OrbitProofOutcome::not_closed);
    EXPECT_GT(moved.proof().miss, 1e-7);
    // Taken all the same, what is said of the states holds.
    const EventOrbitProof proof = moved.proof(1.0);
    EXPECT_TRUE(proof.outcome != OrbitProofOutcome::proved || proof.displacement_error > 0.9e-9);
  }
  ProposedEvents elsewhere = proposed;
  elsewhere.first.state[0] += 1e-9;
  EXPECT_NE(elsewhere.proof().outcome, OrbitProofOutcome::proved);
}

/// With P from −557 N/m upward a pair of multipliers leaves the circle, all contacts being kept.
ProposedEvents with_pair_at(double modulus) {
  ProposedEvents stable = event_orbit_to_prove(proved_loop(0.01, 0.001));
  const double differential = stable.loop.gains.differential;
  double unstable = 510.0;
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = 0.5 * (stable.loop.gains.proportional + unstable);
    const auto between = test::continued(stable, {middle, differential});
    if (between && between->orbit.largest_multiplier() < modulus)
      stable = *between;
    else
      unstable = middle;
  }
  return stable;
}

TEST(EventOrbitProof, IsNotOfAMultiplierOutsideTheCircle) {
  const ProposedEvents inside = with_pair_at(0.99), outside = with_pair_at(1.000001);
  EXPECT_NEAR(inside.orbit.largest_multiplier(), 0.99, 1e-9);
  EXPECT_NEAR(outside.orbit.largest_multiplier(), 1.000001, 1e-9);
  EXPECT_EQ(inside.proof().outcome, OrbitProofOutcome::proved);
  for (const double claim : {std::log(1.000001), std::log(0.999), -1.0}) {
    ProposedEvents claimed = outside;
    claimed.orbit.multipliers.front().log_modulus = claim;
    EXPECT_EQ(claimed.proof(1e9).outcome, OrbitProofOutcome::not_contracting);
  }
}

/// Between −5.05 and −2.4 N s/m the relative acceleration without a force changes its sign at a
/// reversal, so that stick is not begun any more.
TEST(EventOrbitProof, IsNotWhereStickBarelyBegins) {
  ProposedEvents sticking = event_orbit_to_prove(proved_loop(0.01, 0.001));
  const auto sticks = [](const ProposedEvents& proposed) {
    int count = 0;
    for (const auto& sample : proposed.recorded(proposed.first).samples)
      for (const auto& change : sample.switches)
        count += change.begun.mode == ContactMode::stick ? 1 : 0;
    return count == 2;
  };
  double without = -2.4;
  double largest_proved = sticking.loop.gains.differential, smallest_refused = 0.0;
  for (int halving = 0; halving < 70; ++halving) {
    const double middle = 0.5 * (sticking.loop.gains.differential + without);
    const auto between = test::continued(sticking, {-557.0, middle});
    if (between && sticks(*between)) {
      sticking = *between;
      if (halving % 4 != 0) continue;
      const EventOrbitProof proof = sticking.proof();
      if (proof.outcome == OrbitProofOutcome::proved) largest_proved = middle;
      if (proof.outcome == OrbitProofOutcome::near_surface && smallest_refused == 0.0)
        smallest_refused = middle;
    } else {
      without = middle;
    }
  }
  EXPECT_LT(without - largest_proved, 1e-5);
  EXPECT_LT(largest_proved, smallest_refused);
  const EventOrbitProof touching = sticking.proof();
  ASSERT_EQ(touching.outcome, OrbitProofOutcome::near_surface);
  EXPECT_EQ(touching.nearest.surface, ContactSurface::free_acceleration);
  EXPECT_EQ(touching.nearest.order, 0);
  EXPECT_LT(std::abs(touching.nearest.distance), 1e-9) << "of some 20 m/s2";
  EXPECT_LT(std::abs(touching.nearest.decided_by()), 1.0);
  EXPECT_GE(touching.nearest.sample, 0);
}

TEST(EventOrbitProof, OfAnOrbitThatStaysInsideItsGap) {
  const ProposedEvents inside = event_orbit_to_prove(proved_loop(0.001, 0.05));
  ASSERT_EQ(inside.orbit.engaged_fraction(), 0.0);
  const EventOrbitProof proof = inside.proof();
  EXPECT_EQ(proof.outcome, OrbitProofOutcome::proved);
  EXPECT_TRUE(proof.nearest.surface == ContactSurface::gap_lower ||
              proof.nearest.surface == ContactSurface::gap_upper);
  EXPECT_NEAR(proof.nearest.distance, inside.orbit.margins.border_distance,
              1e-6 * inside.orbit.margins.border_distance);
  EXPECT_GT(proof.radius, 0.01 * inside.orbit.margins.border_distance);
  EXPECT_LT(proof.radius, inside.orbit.margins.border_distance);
}

/// The gap of an orbit that stays inside, moved until it is barely as wide as the motion.
TEST(EventOrbitProof, IsNotWhereAnEndOfTheGapIsTouched) {
  const ProposedEvents inside = event_orbit_to_prove(proved_loop(0.001, 0.05));
  const EventOrbitProof proof = inside.proof();
  const double inward = proof.nearest.surface == ContactSurface::gap_upper ? -1.0 : 1.0;
  const auto shifted = [&](double distance) {
    ProposedEvents other = inside;
    other.first.contact.shift_gap(inward * (proof.nearest.distance - distance));
    return other.proof();
  };
  EXPECT_EQ(shifted(1e-9).outcome, OrbitProofOutcome::proved);
  const EventOrbitProof touching = shifted(1e-15);
  EXPECT_EQ(touching.outcome, OrbitProofOutcome::near_surface);
  EXPECT_EQ(touching.nearest.surface, proof.nearest.surface);
  EXPECT_NE(shifted(-1e-9).outcome, OrbitProofOutcome::proved);
}

// ---- both kinds of switching -------------------------------------------------------------------

struct SampledProof {
  static constexpr std::uint64_t seed = 52;
  static constexpr std::int64_t draws = 150;
  static constexpr double least_width = 1e-5;
  static constexpr double least_proved(double certified) { return 0.99 * certified - 1.0; }
  static std::optional<test::ProposedOrbit> found(const IdealLoop<double>& loop) {
    const OrbitResult result =
        find_periodic_orbit(loop, Vector<double, 4>::Zero(), {4000, 400'000});
    if (result.outcome != OrbitOutcome::certified) return std::nullopt;
    return test::ProposedOrbit{loop, *result.orbit};
  }
  static Vector<double, 2> distance(const test::ProposedOrbit& proposed) {
    const OrbitVerification wide = verify_orbit<long double>(proposed.loop, proposed.orbit);
    EXPECT_TRUE(wide.same_itinerary);
    return {wide.displacement_difference, wide.velocity_difference};
  }
};

struct EventProof {
  static constexpr std::uint64_t seed = 62;
  static constexpr std::int64_t draws = 6;
  static constexpr double least_width = 1e-4;
  static constexpr double least_proved(double certified) { return 0.8 * certified; }
  static std::optional<ProposedEvents> found(const IdealLoop<double>& loop) {
    const auto result = find_event_orbit(
        event_motion(ProposedEvents::switching_exactly(loop), Vector<double, 4>::Zero().eval()),
        {200, 100'000});
    if (result.outcome != OrbitOutcome::certified) return std::nullopt;
    return ProposedEvents{loop, *result.orbit, *result.point};
  }
  static Vector<double, 2> distance(const ProposedEvents& proposed) {
    return distance_in_extended_precision(proposed);
  }
};

template <class Model>
class ProofOf : public testing::Test {
 protected:
  static auto proposed(double period, double width) {
    return Model::found(proved_loop(period, width)).value();
  }
};

using ProofModels = testing::Types<SampledProof, EventProof>;
TYPED_TEST_SUITE(ProofOf, ProofModels, );

TYPED_TEST(ProofOf, WithoutBacklashAllIsAttracted) {
  const auto smooth = this->proposed(0.001, 0.0);
  EXPECT_EQ(smooth.proof().outcome, OrbitProofOutcome::proved);
  EXPECT_EQ(smooth.proof().radius, HUGE_VAL);
  const OrbitProof sampled = prove_orbit(smooth.loop, test::orbit_to_prove(smooth.loop));
  EXPECT_NEAR(smooth.proof().multiplier_bound, sampled.multiplier_bound, 0.01);
}

/// Without backlash a drive never is in a gap, whatever it is said to remember.
TYPED_TEST(ProofOf, AGapThatIsNotThereIsRefused) {
  auto inside = this->proposed(0.001, 0.05);
  ASSERT_EQ(inside.orbit.engaged_fraction(), 0.0);
  inside.loop.backlash_width = 0.0;
  EXPECT_NE(inside.proof().outcome, OrbitProofOutcome::proved);
}

TYPED_TEST(ProofOf, WhatIsNoOrbitOfTheLoopIsRefused) {
  const auto sound = this->proposed(0.01, 0.002);
  const auto refuses = [&](auto&& spoil) {
    auto other = sound;
    spoil(other);
    EXPECT_THROW(other.proof(), InvalidParameter);
  };
  refuses([](auto& bad) { bad.orbit.states.pop_back(); });
  refuses([](auto& bad) { bad.orbit.multipliers.clear(); });
  refuses([](auto& bad) { bad.orbit.ratio.numerator += 1; });
  refuses([](auto& bad) { bad.loop.excitation.frequency = 10.0000000000005; });
  refuses([](auto& bad) { bad.loop.plant.conductor_mass = 0.0; });
  if constexpr (std::is_same_v<TypeParam, SampledProof>)
    refuses([](auto& bad) { bad.orbit.itinerary.pop_back(); });
  else
    refuses([](auto& bad) { bad.first.phase = 1; });
}

/// Orbits of random loops: most are proved, and none that extended precision refutes.
TYPED_TEST(ProofOf, MostRandomOrbitsAreProved) {
  const std::int64_t draws = test::property_draws(TypeParam::draws);
  int certified = 0, proved = 0;
  for (std::int64_t draw = 0; certified < draws && draw < 40 * draws; ++draw) {
    test::Random random = test::detail::random_of_draw(TypeParam::seed, draw);
    IdealLoop<double> loop =
        proved_loop(0.001 * (1.0 + static_cast<double>(random.index(20))), 0.0);
    loop.gains = {random.uniform(-900.0, 100.0), random.uniform(-25.0, 2.0)};
    loop.excitation = {0.5, 2.0 + 0.5 * static_cast<double>(random.index(30))};
    loop.backlash_width = random.log_uniform(TypeParam::least_width, 1e-2);
    if (random.index(3) == 0) loop.sampling.processing_delay = random.unit() * loop.sampling.period;
    if (random.index(3) == 0) loop.hold = ForceHold::exact;
    const auto proposed = TypeParam::found(loop);
    if (!proposed) continue;
    ++certified;
    const auto proof = proposed->proof();
    if (proof.outcome != OrbitProofOutcome::proved) {
      std::printf("draw %lld: %d, multiplier %g, error %g, %lld samples\n",
                  static_cast<long long>(draw), static_cast<int>(proof.outcome),
                  proposed->orbit.largest_multiplier(), proof.displacement_error,
                  static_cast<long long>(proposed->orbit.period_samples()));
      continue;
    }
    ++proved;
    EXPECT_GE(proof.multiplier_bound, proposed->orbit.largest_multiplier()) << draw;
    EXPECT_GE(proof.radius, 0.0) << draw;
    const Vector<double, 2> distance = TypeParam::distance(*proposed);
    EXPECT_LE(distance[0], proof.displacement_error) << draw;
    EXPECT_LE(distance[1], proof.velocity_error) << draw;
  }
  EXPECT_EQ(certified, draws);
  EXPECT_GE(proved, static_cast<int>(TypeParam::least_proved(static_cast<double>(draws))));
}

}  // namespace
}  // namespace holdfast
