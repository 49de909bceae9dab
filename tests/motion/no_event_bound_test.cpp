#include "holdfast/motion/no_event_bound.hpp"
#include "holdfast/motion/event_motion.hpp"
#include "holdfast/motion/next_event.hpp"

#include "support/contacts.hpp"
#include "support/random_loop.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

/// A motion in one mode for which a guard is watched.
struct WatchedFlow {
  TwoMass<double> plant;
  AffineDynamics dynamics;
  Guard guard;
  Harmonic harmonic;
  Vector<double, 4> begin;
  double command, length;
};

WatchedFlow random_flow(test::Random& random) {
  WatchedFlow flow{test::random_plant(random), {}, {}, {}, {}, 0.0, 0.0};
  const double stiffness = random.log_uniform(0.1, 10.0) * flow.plant.absorber_stiffness;
  const double damping = random.uniform(0.0, 2.0) * flow.plant.absorber_damping;
  switch (random.index(3)) {
    case 0:
      flow.dynamics = test::exact_backlash(flow.plant, 1.0).dynamics(0);
      break;
    case 1:
      flow.dynamics = test::exact_backlash(flow.plant, 1.0).dynamics(1);
      break;
    default:
      flow.dynamics = dynamics_on_stop(flow.plant, stiffness, damping, 0.1);
      flow.plant = plant_on_stop(flow.plant, stiffness, damping);
  }
  flow.guard = {random.unit() < 0.5 ? displacement_row() : velocity_row()};
  if (random.unit() < 0.5) flow.guard.state = -flow.guard.state;
  if (random.unit() < 0.2) flow.guard.force = random.uniform(-1.0, 1.0);
  const double size = random.log_uniform(1e-3, 1.0), spring = flow.plant.absorber_stiffness;
  const double omega = std::sqrt(spring / flow.plant.absorber_mass);
  flow.begin = size * random.matrix<Vector<double, 4>>();
  flow.begin[1] *= omega;
  flow.begin[3] *= omega;
  flow.command = spring * random.uniform(-1.0, 1.0);
  flow.harmonic = {spring * random.uniform(0.0, 1.0), omega / 6.0 * random.log_uniform(0.1, 10.0),
                   random.uniform(-3.0, 3.0)};
  flow.length = random.log_uniform(1e-3, 3.0) / balanced_norm(flow.dynamics.state);
  return flow;
}

/// ℓᵀz + m F at equal distances of the length, its ends among them.
std::vector<double> finely_scanned(const WatchedFlow& flow) {
  constexpr int parts = 256;
  const double part = flow.length / parts;
  const SubintervalStep step(flow.dynamics, {flow.harmonic}, 0.0, part);
  std::vector<double> values;
  Vector<double, 4> z = flow.begin;
  for (int k = 0; k <= parts; ++k) {
    const double angle = flow.harmonic.angular_frequency() * part * k;
    const Harmonic& line = flow.harmonic;
    values.push_back(flow.guard.state.dot(z) +
                     flow.guard.force * line.amplitude * std::cos(angle + line.phase));
    z = step.state(z, flow.command, 0.0,
                   {{line.amplitude * std::cos(angle), line.amplitude * std::sin(angle)}});
  }
  return values;
}

using NoEventBound = NoEventBoundOf<EnergyNorm, 4>;

NoEventBound bound_of(const WatchedFlow& flow) {
  const double omega = flow.harmonic.angular_frequency(), force = flow.harmonic.amplitude;
  return {flow.dynamics, flow.plant, flow.guard, {force, omega * force, omega * omega * force}};
}

// The constant of the guard is chosen so that the least value of the scan lies a little above or
// below zero: where the claim is hardest to make.
TEST(NoEventBound, NeverClaimsQuietWhereAFineScanFindsAZero) {
  test::Random random(1351);
  int claims = 0, zeros = 0;
  double tightest = 1e300;
  for (int draw = 0; draw < 10000; ++draw) {
    WatchedFlow flow = random_flow(random);
    const std::vector<double> values = finely_scanned(flow);
    const double least = *std::min_element(values.begin(), values.end());
    const double lower = std::min(values.front(), values.back());
    const double drop_below_chord =
        bound_of(flow).drop_below_chord(flow.begin, flow.command, flow.length);
    const double range = *std::max_element(values.begin(), values.end()) - least;
    ASSERT_GE(least, lower - drop_below_chord - 1e-12 * range)
        << "below the chord by more than was claimed";
    if (lower > least) tightest = std::min(tightest, drop_below_chord / (lower - least));
    flow.guard.constant =
        -least + random.sign() * random.log_uniform(1e-4, 100.0) * drop_below_chord;
    const bool quiet = lower + flow.guard.constant > drop_below_chord;
    const bool zero = least + flow.guard.constant <= 0.0;
    ASSERT_FALSE(quiet && zero) << draw;
    claims += quiet ? 1 : 0;
    zeros += zero ? 1 : 0;
  }
  std::cout << claims << " claims, " << zeros << " zeros; the bound exceeds the sag at least "
            << tightest << " times\n";
  EXPECT_GT(claims, 1000);
  EXPECT_GT(zeros, 4000);
  EXPECT_LT(tightest, 3.0) << "no bound much smaller would do";
}

// A force that is constant: the sag of the parabola of a mass that falls, g̈ h² / 8.
TEST(NoEventBound, OfAFallingMassIsItsParabola) {
  const TwoMass<double> loose{1.0, 1e-12, 0.0, 1.0, 1e-12, 0.0};
  const AffineDynamics dynamics{loose.state_matrix(), loose.control_input(),
                                loose.excitation_input()};
  const Guard guard{displacement_row()};
  const NoEventBound bound(dynamics, loose, guard, {3.0, 0.0, 0.0});
  const double length = 0.01, relative_acceleration = 3.0 + 2.0 * 5.0;
  EXPECT_NEAR(bound.drop_below_chord(Vector<double, 4>::Zero(), -5.0, length),
              relative_acceleration * length * length / 8.0, 1e-6);
}

/// How often the bound says at once, for a period without a change of contact, that there is none.
struct ShareWithoutEvent {
  int said = 0, unchanged = 0;
};

ShareWithoutEvent share_without_event(double period, double width) {
  const auto plant = kollar2022_plant();
  const DigitalLoop loop{
      {period, 0.0}, {-557.0, -13.0}, multi_harmonic_force({0.5, 10.0}), ForceHold::exact};
  EventMotion<> motion(loop, test::exact_backlash(plant, width), Vector<double, 4>::Zero());
  const double omega = 20.0 * pi<double>;
  ShareWithoutEvent share;
  while (motion.time() < 3.0) {
    motion.sense();
    const int mode = motion.contact().mode();
    const Guards guards = motion.contact().guards();
    const Vector<double, 4> begin = motion.state();
    const SwitchCounts before = motion.counts();
    motion.advance();
    const bool sticks = mode == static_cast<int>(ContactMode::stick);
    if (sticks || motion.counts().entered != before.entered) continue;
    ++share.unchanged;
    const NoEventBound bound(motion.dynamics(mode), plant, guards.guard[0],
                             {0.5, 0.5 * omega, 0.5 * omega * omega});
    const double drop_below_chord =
        bound.drop_below_chord(begin, motion.previous_command(), period);
    bool quiet = true;
    for (int g = 0; g < guards.count; ++g) {
      const Guard& guard = guards.guard[static_cast<std::size_t>(g)];
      const double lower = std::min(guard.state.dot(begin), guard.state.dot(motion.state()));
      quiet = quiet && guard.zeros == 0 && lower + guard.constant > drop_below_chord;
    }
    share.said += quiet ? 1 : 0;
  }
  return share;
}

TEST(NoEventBound, ClaimsQuietInMostPeriodsOfAMillisecond) {
  for (const double width : {0.0005, 0.002}) {
    const ShareWithoutEvent share = share_without_event(0.001, width);
    std::cout << share.said << " of " << share.unchanged << " periods\n";
    EXPECT_GT(share.unchanged, 2000);
    EXPECT_GT(share.said, 8 * share.unchanged / 10);
  }
}

/// z₁ grows at 1 m/s from 0, z₂ falls from 0 at 1 m/s, both for one second.
const AffineDynamics drifting{Matrix<double, 4>::Zero(), Vector<double, 4>::Zero(),
                              Vector<double, 4>::Zero(), Vector<double, 4>(1.0, 0.0, -1.0, 0.0)};
const ModeStretch<4> one_second{Vector<double, 4>::Zero(), 0.0, Series::Zero(3), 1.0};

Guard coordinate(int index, bool unsigned_yet) {
  return {Vector<double, 4>::Unit(index), 0.0, 0.0, 0.0, 0, unsigned_yet};
}

TEST(NextEvent, EachGuardLearnsItsOwnSign) {
  const NextEvent<4> event =
      next_event(drifting, {{coordinate(0, true), coordinate(2, true)}, 2}, one_second);
  EXPECT_EQ(event.guard, -1);
  EXPECT_EQ(event.signs[0], 1.0);
  EXPECT_EQ(event.signs[1], -1.0);
}

TEST(NextEvent, AGuardOfKnownSignLearnsNone) {
  const NextEvent<4> event =
      next_event(drifting, {{coordinate(2, true), coordinate(0, false)}, 2}, one_second);
  EXPECT_EQ(event.signs[0], -1.0);
  EXPECT_EQ(event.signs[1], 0.0);
}

}  // namespace
}  // namespace holdfast
