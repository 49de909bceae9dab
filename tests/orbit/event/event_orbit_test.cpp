#include "holdfast/orbit/event/event_orbit.hpp"

#include "holdfast/orbit/event/event_orbit_search.hpp"
#include "holdfast/orbit/orbit_search.hpp"
#include "orbit/event/return_differences.hpp"
#include "support/contacts.hpp"
#include "support/kollar_case.hpp"
#include "support/random.hpp"

namespace holdfast {
namespace {

IdealLoop<double> event_orbit_loop(double period, double width, ForceHold hold,
                                   double delay_fraction = 0.0) {
  IdealLoop<double> loop = test::kollar_loop(period, width, delay_fraction);
  loop.hold = hold;
  return loop;
}

/// Every law in one type of contact, whose orbits the library has compiled.
DriveContact<> backlash_of(const TwoMass<double>& plant, double width) {
  return test::exact_backlash(plant, width);
}

EventMotion<> exactly_switching(
    const IdealLoop<double>& loop,
    const Vector<double, 4>& initial_state = Vector<double, 4>::Zero()) {
  return {implemented_loop(loop).digital, backlash_of(loop.plant, loop.backlash_width),
          initial_state};
}

EventOrbitResult<DriveContact<>> certified_event_orbit(
    const IdealLoop<double>& loop,
    const Vector<double, 4>& initial_state = Vector<double, 4>::Zero()) {
  auto found = find_event_orbit(exactly_switching(loop, initial_state), OrbitLimits{20000});
  EXPECT_EQ(found.outcome, OrbitOutcome::certified);
  return found;
}

/// A motion on its orbit, before the orbit's first sample.
RepeatingMotion<DriveContact<>> motion_on(const EventMotion<>& any,
                                          const EventOrbitResult<DriveContact<>>& found) {
  EventMotion<> motion = any;
  motion.restore(0, found.point->state, found.point->previous_command, found.point->contact);
  RepeatingMotion<DriveContact<>> repeating(motion, found.orbit->ratio.denominator);
  repeating.go_to(*found.point);
  return repeating;
}

struct EventOrbitCase {
  double period, width, displacement;
};

/// MODEL.md, section 6.
std::vector<EventOrbitCase> known_motions() {
  return {{0.001, 0.0005, 0.0}, {0.001, 0.002, 0.0}, {0.01, 0.002, 0.0},  {0.011, 0.002, 0.0},
          {0.011, 0.001, 0.0},  {0.003, 0.002, 0.0}, {0.003, 0.002, 1e-5}};
}

TEST(EventOrbit, WithoutBacklashIsThatOfTheSampledLoop) {
  for (const double period : {0.001, 0.01, 0.011}) {
    for (const double delay_fraction : {0.0, 0.3}) {
      if (delay_fraction > 0.0 && period > 0.01) continue;  // unstable
      const auto loop = event_orbit_loop(period, 0.0, ForceHold::exact, delay_fraction);
      const EventOrbit orbit = certified_event_orbit(loop).orbit.value();
      const PeriodicOrbit sampled =
          find_periodic_orbit(loop, Vector<double, 4>::Zero()).orbit.value();
      ASSERT_EQ(orbit.period_samples(), sampled.period_samples());
      EXPECT_EQ(orbit.forcing_periods(), sampled.forcing_periods());
      EXPECT_EQ(orbit.time_share[0], 1.0);
      EXPECT_TRUE(orbit.switches.empty());
      for (std::size_t j = 0; j < orbit.states.size(); ++j)
        EXPECT_LT((orbit.states[j] - sampled.states[j].head<4>()).norm(), 1e-13);
      // μ^N of the eigenvalues μ of S, Eq. (14); the command of the last sample counts with δ > 0.
      const Eigen::VectorXd expected =
          static_cast<double>(orbit.states.size()) *
          test::log_moduli_of(sampled_loop(loop.plant, loop.sampling).engaged_map(loop.gains));
      ASSERT_EQ(orbit.multipliers.size(), 5U);
      for (int i = 0; i < (delay_fraction > 0.0 ? 5 : 4); ++i)
        EXPECT_NEAR(orbit.multipliers[static_cast<std::size_t>(i)].log_modulus, expected[i],
                    1e-9 * (1.0 - expected[i]));
      if (delay_fraction == 0.0) {
        EXPECT_EQ(orbit.multipliers[4].log_modulus, -std::numeric_limits<double>::infinity());
      }
    }
  }
}

// With switching at samples and the force held, the motions of 1 ms, 2 mm and 11 ms, 2 mm have
// periods of 0.5 s and 23.1 s (tests/validation/motion_figures_test.cpp).
TEST(EventOrbit, ExactSwitchingLeavesOfEveryKnownMotionTheCommonPeriod) {
  for (const auto& which : known_motions()) {
    for (const ForceHold hold : {ForceHold::exact, ForceHold::sampled}) {
      const auto loop = event_orbit_loop(which.period, which.width, hold);
      const EventOrbit orbit =
          certified_event_orbit(loop, {which.displacement, 0.0, 0.0, 0.0}).orbit.value();
      const std::int64_t common_period = forcing_ratio(loop).value().denominator;
      EXPECT_EQ(orbit.period_samples(), common_period) << which.period << ' ' << which.width;
      // Far from losing its stability, from grazing and from another order of its switches.
      EXPECT_LT(orbit.largest_multiplier(), 0.98);
      EXPECT_GT(orbit.margins.exit_velocity, 0.01);
      EXPECT_EQ(orbit.margins.border_distance, SwitchingMargins::none);
      EXPECT_EQ(orbit.margins.reversal_velocity, SwitchingMargins::none);
      // One gap, one engaged phase, and at most one stick, per half cycle of the force.
      EXPECT_EQ(orbit.entries(ContactMode::gap), 2 * orbit.forcing_periods());
      EXPECT_EQ(orbit.entries(ContactMode::engaged), 2 * orbit.forcing_periods());
      EXPECT_LE(orbit.entries(ContactMode::stick), 2 * orbit.forcing_periods());
      EXPECT_GT(orbit.entries(ContactMode::stick), 0);
    }
  }
}

TEST(EventOrbit, AllStartsComeToTheSameOneWhereSwitchingAtSamplesHasSeveral) {
  const auto loop = event_orbit_loop(0.003, 0.002, ForceHold::sampled);
  const EventOrbit orbit = certified_event_orbit(loop).orbit.value();
  test::Random random(5011);
  for (int trial = 0; trial < 20; ++trial) {
    Vector<double, 4> start = random.matrix<Vector<double, 4>>();
    start = start.cwiseProduct(Vector<double, 4>(5e-3, 0.2, 5e-3, 0.2));
    const EventOrbit other = certified_event_orbit(loop, start).orbit.value();
    ASSERT_EQ(other.period_samples(), orbit.period_samples());
    for (std::size_t j = 0; j < orbit.states.size(); ++j)
      EXPECT_LT((other.states[j] - orbit.states[j]).norm(), 1e-13);
  }
}

TEST(EventOrbit, ClosesUponItselfAndIsWhereALongMotionEnds) {
  for (const auto& which : known_motions()) {
    const auto loop = event_orbit_loop(which.period, which.width, ForceHold::exact);
    const auto found = certified_event_orbit(loop);
    const EventOrbit& orbit = found.orbit.value();
    EXPECT_LT(orbit.closure_error, 1e-14);
    EXPECT_EQ(orbit.states.front(), found.point->state);
    EventMotion<> motion = exactly_switching(loop);
    const std::int64_t periods = 60000 / orbit.period_samples();
    test::move_samples(motion, periods * orbit.period_samples());
    // The phase of the force is exact on the orbit, rounded at the late instants of the motion.
    EXPECT_LT((motion.state() - orbit.states.front()).norm(), 1e-10);
  }
}

TEST(EventOrbit, OfAnEvenCommonPeriodIsItsOwnOppositeHalfAPeriodLater) {
  for (const double width : {0.0005, 0.002}) {
    const auto loop = event_orbit_loop(0.001, width, ForceHold::exact);
    const EventOrbit orbit = certified_event_orbit(loop).orbit.value();
    const std::size_t half = orbit.states.size() / 2, halves = orbit.switches.size() / 2;
    for (std::size_t j = 0; j < half; ++j) {
      EXPECT_LT((orbit.states[j] + orbit.states[j + half]).norm(), 1e-12);
      EXPECT_EQ(orbit.modes[j], orbit.modes[j + half]);
      EXPECT_NEAR(orbit.forces[j], -orbit.forces[j + half], 1e-10);
    }
    for (std::size_t k = 0; k < halves; ++k) {
      EXPECT_EQ(orbit.switches[k].mode, orbit.switches[k + halves].mode);
      EXPECT_NEAR(orbit.switches[k].time + 0.05, orbit.switches[k + halves].time, 1e-12);
    }
  }
}

void expect_multipliers_of_differences(const EventMotion<>& motion) {
  const auto found = find_event_orbit(motion, OrbitLimits{20000});
  ASSERT_EQ(found.outcome, OrbitOutcome::certified);
  Vector<double, 7> steps;
  steps << 1e-8, 1e-6, 1e-8, 1e-6, 1e-5, 1e-8, 1e-8;
  const Eigen::VectorXd moduli = test::moduli_by_differences(motion_on(motion, found), *found.point,
                                                             found.orbit->period_samples(), steps);
  const auto& multipliers = found.orbit->multipliers;
  // As often as the differences are above their own rounding.
  for (std::size_t i = 0; i < multipliers.size(); ++i) {
    const double modulus = std::exp(multipliers[i].log_modulus);
    EXPECT_NEAR(modulus, moduli[static_cast<Eigen::Index>(i)], 2e-6 + 1e-5 * modulus) << i;
  }
}

TEST(EventOrbit, MultipliersAreThoseOfTheReturnMapByDifferences) {
  for (const double delay_fraction : {0.0, 0.4, 1.0}) {
    for (const ForceHold hold : {ForceHold::exact, ForceHold::sampled}) {
      for (const double width : {0.0005, 0.002}) {
        expect_multipliers_of_differences(
            exactly_switching(event_orbit_loop(0.001, width, hold, delay_fraction)));
        if (delay_fraction < 0.5)
          expect_multipliers_of_differences(
              exactly_switching(event_orbit_loop(0.005, width, hold, delay_fraction)));
      }
    }
  }
}

TEST(EventOrbit, MultipliersCountWhatTheControllerRemembers) {
  for (const double delay_fraction : {0.0, 0.4}) {
    ImplementedLoop loop =
        implemented_loop(event_orbit_loop(0.001, 0.0005, ForceHold::exact, delay_fraction));
    loop.digital.limits.velocity = VelocitySensing::difference;
    for (const double largest : {0.35, std::numeric_limits<double>::infinity()}) {
      loop.digital.limits.largest_force = largest;
      expect_multipliers_of_differences(
          EventMotion<>(loop.digital, backlash_of(loop.plant, 0.0005), Vector<double, 4>::Zero()));
    }
  }
}

/// The map of [z; u_{j−1}; z₁ as read] over a sample whose drive is engaged, the velocity being
/// taken as the difference of two readings.
Matrix<double, 6> map_by_differences(const IdealLoop<double>& loop) {
  const auto sampled = sampled_loop(loop.plant, loop.sampling);
  const double rate = loop.gains.differential / loop.sampling.period;
  RowVector<double, 6> command = RowVector<double, 6>::Zero();
  command[0] = loop.gains.proportional + rate;
  command[5] = -rate;
  Matrix<double, 6> map = Matrix<double, 6>::Zero();
  map.topLeftCorner<4, 4>() = sampled.transition;
  map.block<4, 1>(0, 4) = sampled.previous_force;
  map.topRows<4>() += sampled.present_force * command;
  map.row(4) = command;
  map(5, 0) = 1.0;
  return map;
}

// Products of the maps of a period span 130 decades here: formed as one matrix, all but the largest
// multipliers would be its rounding.
TEST(EventOrbit, SmallMultipliersOfManyAreNoRounding) {
  for (const double period : {0.003, 0.005}) {
    const auto ideal = event_orbit_loop(period, 0.0, ForceHold::exact, 0.3);
    ImplementedLoop loop = implemented_loop(ideal);
    loop.digital.limits.velocity = VelocitySensing::difference;
    const auto found = find_event_orbit(
        EventMotion<>(loop.digital, backlash_of(loop.plant, 0.0), Vector<double, 4>::Zero()),
        OrbitLimits{20000});
    ASSERT_EQ(found.outcome, OrbitOutcome::certified);
    const EventOrbit& orbit = *found.orbit;
    EXPECT_LT(orbit.closure_error, 1e-14);
    std::vector<double> expected;
    for (const double modulus : test::log_moduli_of(map_by_differences(ideal)))
      expected.push_back(modulus * static_cast<double>(orbit.states.size()));
    ASSERT_EQ(orbit.multipliers.size(), 6U);
    for (std::size_t i = 0; i < 6; ++i)
      EXPECT_NEAR(orbit.multipliers[i].log_modulus, expected[i], 1e-9 * (1.0 - expected[i]));
  }
}

TEST(EventOrbit, OfADeadZoneHasTheMultipliersOfDifferences) {
  const Vector<double, 4> rest = Vector<double, 4>::Zero();
  for (const double stiffness : {0.0, 200.0, 2000.0}) {
    ImplementedLoop loop = implemented_loop(event_orbit_loop(0.001, 0.0, ForceHold::exact));
    const double width = stiffness < 1000.0 ? 0.0005 : 0.002;
    loop.digital.gains.differential = -5.0;
    const DriveContact<> contact = test::exact_dead_zone(loop.plant, width, stiffness, 0.5, rest);
    expect_multipliers_of_differences(EventMotion<>(loop.digital, contact, rest));
  }
}

// x_{k+3} = e₁ x_{k+2} − e₂ x_{k+1} + e₃ x_k of any deviation x, once what is annihilated is gone,
// e_i being the elementary symmetric functions of the three multipliers that are not zero.
TEST(EventOrbit, APushedMotionComesBackAsTheMultipliersSay) {
  for (const double width : {0.0005, 0.002}) {
    const auto loop = event_orbit_loop(0.001, width, ForceHold::exact);
    const auto found = certified_event_orbit(loop);
    const EventOrbit& orbit = found.orbit.value();
    std::vector<std::complex<double>> z;
    for (const Multiplier& multiplier : orbit.multipliers) z.push_back(multiplier.value());
    ASSERT_EQ(z[3], 0.0);
    auto motion = motion_on(exactly_switching(loop), found);
    StroboscopicState<DriveContact<>> pushed = *found.point;
    pushed.state[0] += 1e-8;
    motion.go_to(pushed);
    test::move_samples(motion, orbit.period_samples());
    constexpr int count = 8;
    std::vector<Vector<double, 4>> deviation;
    for (int k = 0; k < count; ++k) {
      deviation.push_back(motion.motion().state() - orbit.states.front());
      test::move_samples(motion, orbit.period_samples());
    }
    Eigen::Matrix<double, 4 * (count - 3), 3> past;
    Eigen::Matrix<double, 4 * (count - 3), 1> next;
    for (std::size_t k = 0; k + 3 < deviation.size(); ++k) {
      const auto row = 4 * static_cast<Eigen::Index>(k);
      past.block<4, 3>(row, 0) << deviation[k + 2], -deviation[k + 1], deviation[k];
      next.segment<4>(row) = deviation[k + 3];
    }
    // Least squares, the columns taken to like size.
    const Eigen::Vector3d sizes = past.colwise().norm();
    past = past * sizes.cwiseInverse().asDiagonal();
    const Eigen::Vector3d symmetric =
        ((past.transpose() * past).inverse() * (past.transpose() * next)).cwiseQuotient(sizes);
    EXPECT_NEAR(symmetric[0], (z[0] + z[1] + z[2]).real(), 1e-4);
    EXPECT_NEAR(symmetric[1], (z[0] * z[1] + z[1] * z[2] + z[2] * z[0]).real(), 1e-4);
    EXPECT_NEAR(symmetric[2], (z[0] * z[1] * z[2]).real(), 1e-4);
  }
}

TEST(EventOrbit, InAGapThatIsNeverLeftIsThatOfThePlant) {
  for (const double width : {0.0028, 0.01}) {
    const auto loop = event_orbit_loop(0.001, width, ForceHold::exact);
    const EventOrbit orbit = certified_event_orbit(loop).orbit.value();
    EXPECT_EQ(orbit.period_samples(), 100);
    EXPECT_EQ(orbit.engaged_fraction(), 0.0);
    EXPECT_EQ(orbit.time_share[1], 1.0);
    EXPECT_EQ(orbit.margins.exit_velocity, SwitchingMargins::none);
    std::vector<double> rates;
    for (const auto& pole : test::eigenvalues_of(loop.plant.state_matrix()))
      rates.push_back(pole.real());
    std::sort(rates.rbegin(), rates.rend());
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_NEAR(orbit.multipliers[i].log_modulus, rates[i] * orbit.period(), 1e-10);
    // z₁ is a harmonic: its amplitude by two samples a quarter of a period apart.
    const double amplitude = std::hypot(orbit.states[0][0], orbit.states[25][0]);
    EXPECT_NEAR(orbit.largest_displacement, amplitude, 1e-13);
    // Δz as well, about the middle that the gap has kept from the transient.
    const auto relative = [&](std::size_t j) { return relative_displacement(orbit.states[j]); };
    EXPECT_LE(2.0 * std::hypot(relative(0), relative(25)) + 2.0 * orbit.margins.border_distance,
              width + 1e-12);
  }
}

/// Δz, Δż and the mode of an orbit, asked at many instants between its samples.
struct DenseOrbit {
  double largest_displacement = 0.0;
  double least_reversal_velocity = SwitchingMargins::none;
  std::array<double, 3> share{};
};

DenseOrbit sampled_densely(const IdealLoop<double>& loop,
                           const EventOrbitResult<DriveContact<>>& found) {
  EventMotion<> motion = exactly_switching(loop);
  motion.restore(0, found.point->state, found.point->previous_command, found.point->contact);
  DenseOutput<DriveContact<>> trace(motion);
  DenseOrbit dense;
  constexpr int instants = 400;
  double before = 0.0, last = 0.0;
  for (std::int64_t j = 0; j < found.orbit->period_samples(); ++j) {
    motion.sense();
    trace.begin();
    motion.advance(trace);
    for (int k = 0; k < instants; ++k) {
      const double after = loop.sampling.period * (k + 0.5) / instants;
      const Vector<double, 4> state = trace.state(after);
      dense.largest_displacement = std::max(dense.largest_displacement, std::abs(state[0]));
      dense.share[static_cast<std::size_t>(trace.mode(after))] +=
          1.0 / instants / static_cast<double>(found.orbit->period_samples());
      const bool engaged = trace.mode(after) == ContactMode::engaged;
      const double now = engaged ? std::abs(relative_velocity(state)) : 0.0;
      if (engaged && last > 0.0 && last < before && last <= now && before > 0.0)
        dense.least_reversal_velocity = std::min(dense.least_reversal_velocity, last);
      before = last;
      last = now;
    }
  }
  return dense;
}

TEST(EventOrbit, IsMeasuredAsItsFlowShows) {
  auto slow = event_orbit_loop(0.003, 3.039e-4, ForceHold::exact);
  slow.excitation = {0.465, 2.0};
  slow.gains = {-379.5, -5.93};
  std::vector<IdealLoop<double>> loops{slow};
  for (const auto& which : known_motions())
    loops.push_back(event_orbit_loop(which.period, which.width, ForceHold::sampled));
  bool nearly_reverses = false;
  for (const auto& loop : loops) {
    const auto found = certified_event_orbit(loop);
    const EventOrbit& orbit = found.orbit.value();
    const DenseOrbit dense = sampled_densely(loop, found);
    EXPECT_NEAR(orbit.largest_displacement, dense.largest_displacement, 1e-9);
    EXPECT_GE(orbit.largest_displacement, orbit.amplitude());
    const double resolution = 1.0 / 400.0 * static_cast<double>(orbit.switches.size() + 1);
    for (std::size_t mode = 0; mode < 3; ++mode)
      EXPECT_NEAR(orbit.time_share[mode], dense.share[mode],
                  resolution / static_cast<double>(orbit.period_samples()));
    EXPECT_NEAR(orbit.time_share[0] + orbit.time_share[1] + orbit.time_share[2], 1.0, 1e-12);
    if (std::isinf(orbit.margins.reversal_velocity)) {
      EXPECT_EQ(dense.least_reversal_velocity, SwitchingMargins::none);
    } else {
      nearly_reverses = true;
      EXPECT_NEAR(orbit.margins.reversal_velocity, dense.least_reversal_velocity, 1e-5);
    }
  }
  EXPECT_TRUE(nearly_reverses);
}

TEST(EventOrbit, MarginsAreMetAtTheSwitchesThemselves) {
  const auto loop = event_orbit_loop(0.001, 0.002, ForceHold::exact);
  const auto found = certified_event_orbit(loop);
  EventMotion<> motion = exactly_switching(loop);
  motion.restore(0, found.point->state, found.point->previous_command, found.point->contact);
  DenseOutput<DriveContact<>> trace(motion);
  std::size_t next = 0;
  double slowest = SwitchingMargins::none, shortest = SwitchingMargins::none, left = 0.0;
  const auto& switches = found.orbit->switches;
  for (std::int64_t j = 0; j < found.orbit->period_samples(); ++j) {
    motion.sense();
    trace.begin();
    motion.advance(trace);
    const double time = static_cast<double>(j) * loop.sampling.period;
    for (; next < switches.size() && switches[next].time < time + loop.sampling.period; ++next) {
      const Vector<double, 4> state = trace.state(switches[next].time - time);
      const ContactMode before = switches[(next + switches.size() - 1) % switches.size()].mode;
      if (before == ContactMode::gap) {
        slowest = std::min(slowest, std::abs(relative_velocity(state)));
        left = relative_displacement(state);
      } else {
        EXPECT_NEAR(relative_velocity(state), 0.0, 1e-12);
        if (before == ContactMode::engaged && left != 0.0)
          shortest = std::min(shortest, std::abs(relative_displacement(state) - left));
      }
    }
  }
  EXPECT_EQ(next, switches.size());
  EXPECT_NEAR(found.orbit->margins.exit_velocity, slowest, 1e-12);
  EXPECT_NEAR(found.orbit->margins.shortest_travel, shortest, 1e-13);
}

TEST(EventOrbit, OfSwitchingAtSamplesIsTheOneOfItsContacts) {
  for (const double width : {0.001, 0.002}) {
    const auto loop = event_orbit_loop(0.011, width, ForceHold::sampled);
    const ImplementedLoop real = implemented_loop(loop);
    const EventMotion<> motion(
        real.digital,
        DriveContact<>(loop.plant, real.backlash, Switching::sampled, Vector<double, 4>::Zero()),
        Vector<double, 4>::Zero());
    const auto found = find_event_orbit(motion, OrbitLimits{5000});
    ASSERT_EQ(found.outcome, OrbitOutcome::certified);
    const EventOrbit& orbit = found.orbit.value();
    const PeriodicOrbit sampled =
        find_periodic_orbit(loop, Vector<double, 4>::Zero(), {5000, 0}).orbit.value();
    ASSERT_EQ(orbit.period_samples(), sampled.period_samples());
    EXPECT_GT(orbit.period_samples(), 1000);
    // Which stroboscopic instant of the orbit comes first is left open.
    const auto first = std::min_element(
        sampled.states.begin(), sampled.states.end(), [&](const auto& a, const auto& b) {
          return (a.template head<4>() - orbit.states.front()).norm() <
                 (b.template head<4>() - orbit.states.front()).norm();
        });
    EXPECT_LT((first->head<4>() - orbit.states.front()).norm(), 1e-12);
    const double expected = sampled.multipliers.front().log_modulus;
    EXPECT_NEAR(orbit.multipliers.front().log_modulus, expected, -1e-6 * expected);
    EXPECT_NEAR(orbit.amplitude(), sampled.amplitude(), 1e-12);
  }
}

/// A loop whose motion, switching exactly, repeats after more than one common period.
IdealLoop<double> subharmonic_loop() {
  auto loop = event_orbit_loop(0.008, 1.424e-4, ForceHold::exact);
  loop.excitation = {0.405, 4.0};
  loop.gains = {-439.3, -12.79};
  return loop;
}

TEST(EventOrbit, HasItsShortestPeriod) {
  const auto loop = subharmonic_loop();
  const auto found = certified_event_orbit(loop);
  const EventOrbit& orbit = found.orbit.value();
  const auto common_period = static_cast<std::size_t>(orbit.ratio.denominator);
  const std::size_t samples = orbit.states.size();
  EXPECT_EQ(samples % common_period, 0U);
  EXPECT_GT(samples, common_period);
  for (std::size_t lag = common_period; lag < samples; lag += common_period) {
    EXPECT_GT((orbit.states[lag] - orbit.states[0]).norm(), 1e-4 * orbit.states[0].norm());
  }
  EXPECT_LT(orbit.closure_error, 1e-14);
}

TEST(EventOrbit, AMotionSeenTooShortlyIsSaidToApproach) {
  const auto loop = event_orbit_loop(0.001, 0.002, ForceHold::exact);
  const auto whole = certified_event_orbit(loop);
  const auto found =
      find_event_orbit(exactly_switching(loop), OrbitLimits{1000, whole.samples / 2});
  ASSERT_EQ(found.outcome, OrbitOutcome::approaching);
  EXPECT_LT((found.orbit->states.front() - whole.orbit->states.front()).norm(), 1e-12);
}

TEST(EventOrbit, StartsAtAnySample) {
  const auto loop = event_orbit_loop(0.011, 0.001, ForceHold::exact);
  EventMotion<> motion = exactly_switching(loop);
  test::move_samples(motion, 137);
  const auto late = find_event_orbit(motion, OrbitLimits{1000});
  ASSERT_EQ(late.outcome, OrbitOutcome::certified);
  const auto early = certified_event_orbit(loop);
  EXPECT_LT((late.orbit->states.front() - early.orbit->states.front()).norm(), 1e-12);
}

TEST(EventOrbit, OfSeveralHarmonicsHasThePeriodOfAll) {
  ImplementedLoop loop = implemented_loop(event_orbit_loop(0.001, 0.0005, ForceHold::exact));
  loop.digital.force.harmonics.push_back({0.1, 12.5, 0.3});
  const EventMotion<> motion(loop.digital, backlash_of(loop.plant, 0.0005),
                             Vector<double, 4>::Zero());
  const auto found = find_event_orbit(motion, OrbitLimits{4000});
  ASSERT_EQ(found.outcome, OrbitOutcome::certified);
  EXPECT_EQ(found.orbit->period_samples(), 400);
  EXPECT_EQ(found.orbit->forcing_periods(), 4);
}

TEST(EventOrbit, IsNotLookedForWhereNothingRepeats) {
  ImplementedLoop loop = implemented_loop(event_orbit_loop(0.001, 0.0005, ForceHold::exact));
  std::vector<DigitalLoop> restless(3, loop.digital);
  restless[0].force.harmonics[0].frequency = 10.0 * std::sqrt(0.5);
  restless[1].jitter.half_width = 1e-5;
  restless[2].force.record = std::make_shared<const RecordedForce>(
      std::vector<double>{0.0, 1.0}, std::vector<double>{0.0, 0.1}, RecordInterpolation::linear);
  for (const DigitalLoop& digital : restless) {
    const EventMotion<> motion(digital, backlash_of(loop.plant, 0.0005), Vector<double, 4>::Zero());
    const auto found = find_event_orbit(motion);
    EXPECT_EQ(found.outcome, OrbitOutcome::incommensurate);
    EXPECT_EQ(found.samples, 0);
  }
}

TEST(EventOrbitMeasuresDetail, FindsEverySignChangeOfASeries) {
  test::Random random(77);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<double> roots(1 + random.index(5));
    for (double& root : roots) root = random.uniform(-0.5, 1.5);
    Series p = Series::Zero(static_cast<Eigen::Index>(roots.size()) + 1);
    p[0] = random.sign();
    const double sign = p[0];
    for (std::size_t k = 0; k < roots.size(); ++k) {
      for (auto i = static_cast<Eigen::Index>(k) + 1; i > 0; --i) p[i] = p[i - 1] - roots[k] * p[i];
      p[0] *= -roots[k];
    }
    std::sort(roots.begin(), roots.end());
    double closest = 1.0;
    for (std::size_t k = 0; k + 1 < roots.size(); ++k)
      closest = std::min(closest, roots[k + 1] - roots[k]);
    if (closest < 0.02) continue;
    std::vector<double> seen;
    detail::for_each_sign_change(p, [&](double x, bool rises) {
      seen.push_back(x);
      const auto above =
          std::count_if(roots.begin(), roots.end(), [x](double root) { return root > x + 1e-3; });
      EXPECT_EQ(rises, (above % 2 == 0 ? sign : -sign) > 0.0);
    });
    std::vector<double> inside;
    std::copy_if(roots.begin(), roots.end(), std::back_inserter(inside),
                 [](double root) { return root > 0.0 && root <= 1.0; });
    ASSERT_EQ(seen.size(), inside.size());
    for (std::size_t k = 0; k < seen.size(); ++k) EXPECT_NEAR(seen[k], inside[k], 1e-9);
  }
}

}  // namespace
}  // namespace holdfast
