#include "holdfast/orbit/periodic_orbit.hpp"

#include "holdfast/chaos/lyapunov_run.hpp"
#include "holdfast/orbit/orbit_search.hpp"
#include "holdfast/stability/response/response.hpp"
#include "support/dense_routes.hpp"
#include "support/kollar_case.hpp"

namespace holdfast {
namespace {

std::vector<IdealLoop<double>> orbit_loops() {
  return {test::kollar_loop(0.001, 0.0005), test::kollar_loop(0.001, 0.002),
          test::kollar_loop(0.01, 0.002),   test::kollar_loop(0.011, 0.002),
          test::kollar_loop(0.01, 0.001),   test::kollar_loop(0.01, 0.002, 0.5),
          test::kollar_loop(0.001, 0.003),  test::kollar_loop(0.005, 0.001, 0.3)};
}

PeriodicOrbit orbit_from_rest(const IdealLoop<double>& loop) {
  const OrbitResult found = find_periodic_orbit(loop, Vector<double, 4>::Zero(), {5000, 0});
  EXPECT_EQ(found.outcome, OrbitOutcome::certified);
  return found.orbit.value();
}

/// The motion on an orbit, begun at its first sample.
PeriodicallyForcedMotion<double> motion_on(const IdealLoop<double>& loop,
                                           const PeriodicOrbit& orbit) {
  auto motion = periodically_forced_motion(loop, orbit.ratio, Vector<double, 4>::Zero().eval());
  const Vector<double, 5>& first = orbit.states.front();
  motion.restore(
      MotionMemory<double, BacklashMemory<double>>{first.head<4>(), first[4], orbit.memory});
  return motion;
}

TEST(PeriodicOrbit, IsWhereALongPlainSimulationEnds) {
  for (const auto& loop : orbit_loops()) {
    const PeriodicOrbit orbit = orbit_from_rest(loop);
    EXPECT_TRUE(orbit.is_attracting());
    auto motion = harmonically_forced_motion(loop, Vector<double, 4>::Zero().eval());
    const auto turns = static_cast<std::int64_t>(5.0 - 30.0 / orbit.multipliers[0].log_modulus);
    // Enough for any transient here, a whole number of periods.
    const std::int64_t periods = turns + 60000 / orbit.period_samples();
    run_trajectory(motion, periods * orbit.period_samples(), std::nullopt);
    // Which stroboscopic instant of the orbit the motion has come to is left open.
    const auto step = static_cast<std::size_t>(orbit.ratio.denominator);
    double nearest = 1.0;
    std::size_t start = 0;
    for (std::size_t j = 0; j < orbit.states.size(); j += step) {
      const double apart = (orbit.states[j].head<4>() - motion.state()).norm();
      if (apart < nearest) nearest = apart, start = j;
    }
    EXPECT_LT(nearest, 1e-10) << loop.sampling.period;
    for (std::size_t j = 0; j < orbit.states.size(); ++j) {
      const std::size_t here = (start + j) % orbit.states.size();
      ASSERT_LT((orbit.states[here].head<4>() - motion.state()).norm(), 1e-10);
      ASSERT_EQ(motion.sense().engaged, orbit.itinerary[here] != 0);
      motion.advance();
    }
  }
}

TEST(PeriodicOrbit, ClosesUponItself) {
  for (const auto& loop : orbit_loops()) {
    const PeriodicOrbit orbit = orbit_from_rest(loop);
    EXPECT_LE(orbit.closure_error, 1e-12);
    auto motion = motion_on(loop, orbit);
    for (const std::uint8_t contact : orbit.itinerary) {
      ASSERT_EQ(motion.sense().engaged, contact != 0);
      motion.advance();
    }
    EXPECT_LT((motion.state() - orbit.states.front().head<4>()).norm(), 1e-12);
    EXPECT_NEAR(motion.memory().previous_force, orbit.states.front()[4], 1e-10);
    EXPECT_EQ(motion.law().inside(), orbit.memory.inside);
  }
}

TEST(PeriodicOrbit, MultipliersAreThoseOfTheReturnMapByFiniteDifferences) {
  for (const auto& loop : {test::kollar_loop(0.001, 0.0005), test::kollar_loop(0.01, 0.002),
                           test::kollar_loop(0.01, 0.002, 0.5), test::kollar_loop(0.001, 0.002)}) {
    const PeriodicOrbit orbit = orbit_from_rest(loop);
    const auto after_period = [&](const Vector<double, 5>& deviation) {
      auto motion = motion_on(loop, orbit);
      auto memory = motion.memory();
      memory.state += deviation.head<4>();
      memory.previous_force += deviation[4];
      motion.restore(memory);
      run_trajectory(motion, orbit.period_samples(), std::nullopt);
      Vector<double, 5> state;
      state << motion.state(), motion.memory().previous_force;
      return state;
    };
    const Vector<double, 5> steps(1e-7, 1e-6, 1e-7, 1e-6, 1e-6);
    Matrix<double, 5> tangent;
    for (int k = 0; k < 5; ++k) {
      const Vector<double, 5> step = steps[k] * Vector<double, 5>::Unit(k);
      tangent.col(k) = (after_period(step) - after_period(-step)) / (2.0 * steps[k]);
    }
    const Eigen::VectorXd expected = test::moduli_of(tangent);
    for (std::size_t i = 0; i < 5; ++i) {
      const double found = std::abs(orbit.multipliers[i].value());
      EXPECT_NEAR(found, expected[static_cast<Eigen::Index>(i)], 1e-6) << i;
    }
    EXPECT_EQ(orbit.largest_multiplier(), std::exp(orbit.multipliers[0].log_modulus));
  }
}

TEST(PeriodicOrbit, TheLogarithmsOfMultipliersPerSampleAreTheLyapunovExponents) {
  for (const auto& loop : orbit_loops()) {
    const PeriodicOrbit orbit = orbit_from_rest(loop);
    LyapunovObserver observer(sampled_loop(loop.plant, loop.sampling), loop.gains);
    auto motion = motion_on(loop, orbit);
    const std::int64_t periods = 1 + 40000 / orbit.period_samples();
    const std::int64_t samples = periods * orbit.period_samples();
    run_trajectory(motion, samples, std::nullopt, observer);
    const Vector<double, 5> exponents = observer.spectrum().exponents();
    for (std::size_t i = 0; i < 5; ++i) {
      const double expected =
          orbit.multipliers[i].log_modulus / static_cast<double>(orbit.period_samples());
      const double found = exponents[static_cast<Eigen::Index>(i)];
      if (std::isinf(expected)) {
        EXPECT_EQ(found, expected);
      } else {
        // The turning of the basis adds a bounded sum, of order ln ‖S‖.
        EXPECT_NEAR(found, expected, 20.0 / static_cast<double>(samples)) << i;
      }
    }
  }
}

TEST(PeriodicOrbit, OfSlowSamplingHasAllItsMultipliers) {
  // Without backlash they are the powers of the loop's eigenvalues, however small.
  for (const double period : {0.01, 0.05, 0.1, 0.2, 0.3}) {
    IdealLoop<double> loop = test::kollar_loop(period, 0.0);
    loop.gains = {-20.0, -0.5};
    loop.excitation.frequency = 7.0;
    const PeriodicOrbit orbit = orbit_from_rest(loop);
    const IdealLoop<long double> precise = converted<long double>(loop);
    const Eigen::VectorXd expected = test::log_moduli_of(
        sampled_loop(precise.plant, precise.sampling).engaged_map(precise.gains));
    for (int i = 0; i < 4; ++i) {
      const double samples = static_cast<double>(orbit.period_samples());
      const double found = orbit.multipliers[static_cast<std::size_t>(i)].log_modulus / samples;
      EXPECT_NEAR(found, expected[i], 1e-9) << period << ' ' << i;
    }
  }
}

TEST(PeriodicOrbit, OfTheLinearLoopIsItsSteadyResponse) {
  for (const double period : {0.001, 0.004, 0.01}) {
    for (const ForceHold hold : {ForceHold::sampled, ForceHold::exact}) {
      IdealLoop<double> loop = test::kollar_loop(period, 0.0, 0.3);
      loop.hold = hold;
      const PeriodicOrbit orbit = orbit_from_rest(loop);
      EXPECT_EQ(orbit.period_samples(), orbit.ratio.denominator);
      const auto sampled = sampled_loop(loop.plant, loop.sampling);
      const double omega = loop.excitation.angular_frequency();
      const auto input = harmonic_input(loop.plant, sampled, hold, omega);
      const SteadyResponse<double> response(sampled, input, omega);
      // z₁ = Re(Z e^{iωt_j}): the sum over a period with e^{−iωt_j} is N Z/2.
      std::complex<double> sum = 0.0;
      for (std::size_t j = 0; j < orbit.states.size(); ++j)
        sum += orbit.states[j][0] * std::polar(1.0, -omega * period * static_cast<double>(j));
      const double amplitude = 2.0 * std::abs(sum) / static_cast<double>(orbit.states.size());
      const double expected = 0.5 * response.amplitude_per_force(loop.gains);
      EXPECT_NEAR(amplitude, expected, 1e-11 * expected) << period;
      EXPECT_EQ(orbit.engaged_fraction(), 1.0);
      EXPECT_EQ(orbit.borders.velocity.sample, -1);
    }
  }
}

TEST(PeriodicOrbit, ItsBordersAreWhereItsOwnDecisionsLie) {
  for (const auto& loop : orbit_loops()) {
    const PeriodicOrbit orbit = orbit_from_rest(loop);
    auto motion = motion_on(loop, orbit);
    double displacement = HUGE_VAL, velocity = HUGE_VAL;
    for (std::size_t j = 0; j < orbit.itinerary.size(); ++j) {
      const auto state = motion.state();
      const Backlash<double> before = motion.law();
      const bool engaged = motion.sense().engaged;
      motion.advance();
      const double height = state[2] - state[0] - before.lower();
      if (before.inside())
        displacement =
            std::min({displacement, std::abs(height), std::abs(loop.backlash_width - height)});
      if (engaged || !before.inside()) velocity = std::min(velocity, std::abs(state[3] - state[1]));
    }
    EXPECT_NEAR(orbit.borders.displacement.distance, displacement, 1e-12);
    if (std::isfinite(velocity)) {
      EXPECT_NEAR(orbit.borders.velocity.distance, velocity, 1e-10);
    }
  }
}

TEST(OrbitOfItinerary, AForeignSequenceIsNotVerified) {
  const IdealLoop<double> loop = test::kollar_loop(0.01, 0.002);
  const PeriodicOrbit orbit = orbit_from_rest(loop);
  const ItineraryMaps<double> maps(loop, orbit.ratio);
  const Backlash<double> law(loop.backlash_width, orbit.memory);
  const auto outcome = [&](const Itinerary& itinerary) {
    return orbit_of_itinerary(loop, orbit.ratio, maps, itinerary, law).outcome;
  };
  EXPECT_EQ(outcome(orbit.itinerary), OrbitOutcome::certified);
  Itinerary twice = orbit.itinerary;
  twice.insert(twice.end(), orbit.itinerary.begin(), orbit.itinerary.end());
  EXPECT_EQ(outcome(twice), OrbitOutcome::certified);
  for (std::size_t j = 0; j < orbit.itinerary.size(); ++j) {
    Itinerary other = orbit.itinerary;
    other[j] ^= 1U;
    EXPECT_EQ(outcome(other), OrbitOutcome::not_reproduced) << j;
  }
}

TEST(OrbitOfItinerary, AnUndampedConductorAtResonanceHasNone) {
  // Uncontrolled and undamped, with a natural period of exactly ten samples: e^{iωτN} = 1.
  IdealLoop<double> loop = test::kollar_loop(0.01, 0.0);
  loop.gains = {0.0, 0.0};
  const double omega = 2.0 * pi<double> * 10.0;
  // A pair of masses of which one mode is at ω.
  loop.plant = {0.1, 0.0, 0.0, 0.1, 0.05 * omega * omega, 0.0};
  loop.plant.conductor_stiffness = 0.05 * omega * omega;
  const double stiffness = loop.plant.conductor_stiffness;
  // k₁ = k₂ = k, m₁ = m₂ = m: ω² = (k/m)(3 − √5)/2; scale k to put it at 10 Hz.
  const double scale = omega * omega / (stiffness / 0.1 * (3.0 - std::sqrt(5.0)) / 2.0);
  loop.plant.conductor_stiffness *= scale;
  loop.plant.absorber_stiffness *= scale;
  const Rational ratio = forcing_ratio(loop).value();
  const ItineraryMaps<double> maps(loop, ratio);
  EXPECT_EQ(orbit_of_itinerary(loop, ratio, maps, Itinerary(10, 1), Backlash<double>(0.0)).outcome,
            OrbitOutcome::none_found);
}

TEST(OrbitVerification, ACertificateStandsInLongDouble) {
  for (const double width : {0.0, 0.001, 0.002, 0.003}) {
    const IdealLoop<double> loop = test::kollar_loop(0.01, width, 0.2);
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
  const IdealLoop<double> loop = test::kollar_loop(0.01, 0.002, 0.2);
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
