#include "holdfast/phase_space/section.hpp"

#include "holdfast/motion/implemented_loop.hpp"
#include "support/kollar_case.hpp"
#include "support/lagging_plant.hpp"
#include "support/random_loop.hpp"
#include "support/reference/state_between_samples.hpp"

namespace holdfast {
namespace {

ImplementedLoop section_loop(double period, double width, Switching switching,
                             ForceHold hold = ForceHold::exact) {
  test::KollarCase which;
  which.sampling_period = period;
  which.width = width;
  ImplementedLoop loop = implemented_loop(which.ideal_loop());
  loop.digital.hold = hold;
  loop.switching = switching;
  return loop;
}

template <class Plant>
auto motion_from_rest(const ImplementedLoopOf<Plant>& loop) {
  const Eigen::Index order = loop.plant.state_matrix().rows();
  return event_motion(loop, StateOf<Plant>(StateOf<Plant>::Zero(order)));
}

template <class Plant>
auto section_of(const ImplementedLoopOf<Plant>& loop, std::int64_t samples) {
  using Point = SectionPointOf<states_of<Plant>>;
  std::vector<Point> points;
  auto motion = motion_from_rest(loop);
  run_section(motion, samples, [&](const Point& at) { points.push_back(at); });
  return points;
}

/// A change of the sign of Δż, or the beginning of a stick, between two instants.
struct ScannedTurn {
  double begin, end;  // s
};

/// The turns of a motion by looking at `looks` instants of every sampling period.
template <class Contact>
std::vector<ScannedTurn> scanned_turns(EventMotion<Contact> motion, std::int64_t samples,
                                       int looks) {
  std::vector<ScannedTurn> turns;
  DenseOutput<Contact> trace(motion);
  double sign = 0.0, last = 0.0;
  for (std::int64_t j = 0; j < samples; ++j) {
    const double time = motion.time(), period = motion.period();
    motion.sense();
    trace.begin();
    motion.advance(trace);
    for (int look = 1; look <= looks; ++look) {
      const double after = period * look / looks;
      const auto state = trace.state(after);
      const bool sticks = trace.mode(after) == ContactMode::stick;
      const double velocity = sticks ? 0.0 : motion.readings().relative_velocity(state);
      if (!sticks && std::abs(velocity) < 1e-13 * state.cwiseAbs().maxCoeff()) continue;
      if (sign * velocity < 0.0 || (sticks && sign != 0.0)) turns.push_back({last, time + after});
      sign = velocity > 0.0 ? 1.0 : velocity < 0.0 ? -1.0 : 0.0;
      last = time + after;
    }
  }
  return turns;
}

/// Every scanned turn is a point, and every other point belongs to a pair within one look, which
/// the scan cannot see. @return how many such points there are
template <class Plant>
std::size_t expect_scanned(const ImplementedLoopOf<Plant>& loop, std::int64_t samples, int looks) {
  const auto points = section_of(loop, samples);
  const std::vector<ScannedTurn> turns = scanned_turns(motion_from_rest(loop), samples, looks);
  const double slack = 1e-9 * loop.digital.sampling.period;
  std::size_t next = 0, unseen = 0;
  for (const ScannedTurn& turn : turns) {
    while (next < points.size() && points[next].time < turn.begin - slack) ++next, ++unseen;
    EXPECT_TRUE(next < points.size() && points[next].time <= turn.end + slack)
        << "no point from " << turn.begin << " to " << turn.end;
    if (next < points.size()) ++next;
  }
  return unseen + (points.size() - std::min(next, points.size()));
}

TEST(Section, OfTheLoopOfThePaperIsThatOfItsMatrixExponentials) {
  for (const ForceHold hold : {ForceHold::sampled, ForceHold::exact}) {
    for (const double delay : {0.0, 0.004, 0.011}) {
      const IdealLoop<double> loop{kollar2022_plant(), {0.011, delay}, {-100.0, -2.0},
                                   {0.5, 10.0},        0.002,          hold};
      const auto points = section_of(implemented_loop(loop), 3000);
      auto motion = harmonically_forced_motion(loop, Vector<double, 4>::Zero().eval());
      std::size_t seen = 0, changes = 0;
      for (int j = 0; j < 3000; ++j) {
        const double before = motion.memory().previous_force;
        const auto sample = motion.sense();
        motion.advance();
        if (relative_velocity(sample.state) * relative_velocity(motion.state()) < 0.0) ++changes;
        for (; seen < points.size() && points[seen].time < motion.time(); ++seen) {
          const double after = points[seen].time - sample.time;
          const auto expected = test::state_between_samples(loop, sample, before, after);
          EXPECT_LE((points[seen].state - expected).cwiseAbs().maxCoeff(), 1e-9);
          EXPECT_EQ(points[seen].engaged, sample.engaged) << points[seen].time;
        }
      }
      EXPECT_EQ(seen, points.size());
      EXPECT_GE(points.size(), changes);
      EXPECT_GT(changes, 300U);
    }
  }
}

TEST(Section, PointsLieOnItToRounding) {
  for (const Switching switching : {Switching::sampled, Switching::exact}) {
    for (const double period : {0.001, 0.011}) {
      const auto points = section_of(section_loop(period, 0.002, switching), 4000);
      ASSERT_GT(points.size(), 70U);
      double largest = 0.0;
      for (const SectionPoint& point : points)
        largest = std::max(largest, point.state.cwiseAbs().maxCoeff());
      for (std::size_t k = 0; k < points.size(); ++k) {
        EXPECT_NEAR(points[k].state[3], points[k].state[1], 1e-14 * largest) << points[k].time;
        if (k == 0) continue;
        EXPECT_GT(points[k].time, points[k - 1].time);
        if (switching == Switching::exact) continue;  // a stick need not turn Δz
        EXPECT_NE(points[k].rising, points[k - 1].rising);
      }
    }
  }
}

TEST(Section, NoTurnIsMissedOnAnyLoop) {
  test::Random random(4711);
  for (int k = 0; k < 60; ++k) {
    ImplementedLoop loop;
    loop.plant = test::random_plant(random);
    loop.digital.sampling = test::random_sampling(loop.plant, random);
    loop.digital.gains = test::random_gains(loop.plant, loop.digital.sampling.period, random);
    loop.digital.gains.proportional *= 0.05;
    loop.digital.gains.differential *= 0.05;
    for (int line = 0; line < 2; ++line)
      loop.digital.force.harmonics.push_back(
          {random.log_uniform(0.1, 1.0), random.log_uniform(0.5, 50.0), random.uniform(0.0, 6.0)});
    loop.digital.hold = random.unit() < 0.5 ? ForceHold::sampled : ForceHold::exact;
    const double size = 1.0 / loop.plant.conductor_stiffness;
    const ContactLaw laws[] = {ContactLaw::kollar, ContactLaw::play, ContactLaw::dead_zone};
    loop.backlash = {laws[random.index(3)], size * random.log_uniform(1e-3, 3.0),
                     loop.plant.absorber_stiffness, loop.plant.absorber_damping};
    loop.switching = random.unit() < 0.3 ? Switching::sampled : Switching::exact;
    EXPECT_EQ(expect_scanned(loop, 300, 400), 0U) << k;
  }
}

TEST(Section, OfALinearPlantGoesOnWhereItEndedInAStick) {
  const ImplementedLoop loop = section_loop(0.001, 0.0005, Switching::exact);
  const ImplementedLoopOf<LinearPlant<double>> same{test::through_ports(loop.plant), loop.digital,
                                                    loop.backlash, loop.switching};
  const auto whole = section_of(same, 2000);
  auto motion = motion_from_rest(same);
  auto pieces = whole;
  pieces.clear();
  for (int piece = 0; piece < 2000; ++piece)
    run_section(motion, 1, [&](const auto& at) { pieces.push_back(at); });
  ASSERT_EQ(pieces.size(), whole.size());
  for (std::size_t k = 0; k < whole.size(); ++k) EXPECT_EQ(pieces[k].time, whole[k].time);
}

TEST(Section, NoTurnIsMissedOfADriveWithStatesOfItsOwn) {
  for (const Switching switching : {Switching::sampled, Switching::exact}) {
    const ImplementedLoop loop = section_loop(0.005, 0.0005, switching);
    const auto plant = test::of_dynamic_order(with_drive_lag(linear_plant(loop.plant), 20.0));
    const ImplementedLoopOf<LinearPlant<double>> lagging{plant, loop.digital, loop.backlash,
                                                         loop.switching};
    EXPECT_EQ(expect_scanned(lagging, 2000, 50), 0U);
  }
}

TEST(Section, FindsAllTurnsOfALongSamplingPeriod) {
  // Without control the motion is the plant's response to 10 Hz once the transient is over; three
  // or four of its turns, 50 ms apart, fall into a sampling period of 170 ms.
  for (const Switching switching : {Switching::sampled, Switching::exact}) {
    ImplementedLoop loop = section_loop(0.17, 0.0, switching);
    loop.digital.gains = {0.0, 0.0};
    const auto points = section_of(loop, 300);
    const double steady = 40.0, end = 51.0;
    std::size_t seen = 0;
    for (std::size_t k = 1; k < points.size(); ++k) {
      if (points[k - 1].time < steady) continue;
      ++seen;
      EXPECT_NEAR(points[k].time - points[k - 1].time, 0.05, 1e-9);
      EXPECT_NE(points[k].rising, points[k - 1].rising);
    }
    EXPECT_NEAR(static_cast<double>(seen), (end - steady) / 0.05, 1.0);
  }
}

/// Without damping, force and control, from rest in the shape of one of the plant's modes.
/// @return the points of `half_periods` half periods of it, `parts` samples each, from between two
///         samples on
std::vector<SectionPoint> modal_section(std::size_t mode, int parts, int half_periods) {
  TwoMass<double> plant = kollar2022_plant();
  plant.conductor_damping = plant.absorber_damping = 0.0;
  Eigen::Matrix2d stiffness;
  stiffness << plant.conductor_stiffness + plant.absorber_stiffness, -plant.absorber_stiffness,
      -plant.absorber_stiffness, plant.absorber_stiffness;
  const Eigen::Vector2d masses(plant.conductor_mass, plant.absorber_mass);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix2d> modes(
      stiffness, Eigen::Matrix2d(masses.asDiagonal()));
  const auto column = static_cast<Eigen::Index>(mode);
  const Eigen::Vector2d shape = modes.eigenvectors().col(column);
  ImplementedLoop loop{plant, {}, {}, Switching::sampled};
  loop.digital.gains = {0.0, 0.0};
  loop.digital.sampling = {pi<double> / std::sqrt(modes.eigenvalues()[column]) / parts, 0.0};
  // Of one part the last sample ends at a turn, of which rounding decides whether it is seen.
  const double end = (half_periods + 0.5) * parts * loop.digital.sampling.period;
  std::vector<SectionPoint> points;
  auto motion = event_motion(loop, Vector<double, 4>(shape[0], 0.0, shape[1], 0.0));
  run_section(motion, std::int64_t{parts} * half_periods + 1, [&](const SectionPoint& at) {
    if (at.time < end) points.push_back(at);
  });
  return points;
}

TEST(Section, ATurnAtASampleIsOnePoint) {
  // Δz turns every half period, where rounding decides whether that is before or after the sample.
  for (const std::size_t mode : {std::size_t{0}, std::size_t{1}}) {
    for (const int parts : {1, 2, 3, 7, 20}) {
      constexpr int half_periods = 300;
      const auto points = modal_section(mode, parts, half_periods);
      ASSERT_EQ(points.size(), static_cast<std::size_t>(half_periods)) << mode << " " << parts;
      const double half_period = points.back().time / half_periods;
      for (std::size_t k = 0; k < points.size(); ++k) {
        EXPECT_NEAR(points[k].time, half_period * static_cast<double>(k + 1), 1e-10);
        if (k == 0) continue;
        EXPECT_NE(points[k].rising, points[k - 1].rising);
      }
    }
  }
}

TEST(Section, AStickIsOnePointAtItsBeginning) {
  // Every reversal sticks in this motion; its sticks last longer than a sampling period.
  const ImplementedLoop loop = section_loop(0.001, 0.0005, Switching::exact);
  constexpr std::int64_t samples = 3000;
  std::vector<SectionPoint> points;
  std::int64_t sticks = 0, sticking_samples = 0;
  auto motion = event_motion(loop, Vector<double, 4>::Zero());
  for (std::int64_t j = 0; j < samples; ++j) {
    const auto before = motion.counts().entered;
    const double begin = motion.time();
    const std::size_t known = points.size();
    auto looked_at = motion;
    sticking_samples += looked_at.sense().mode == ContactMode::stick ? 1 : 0;
    run_section(motion, 1, [&](const SectionPoint& at) { points.push_back(at); });
    const auto stick = static_cast<std::size_t>(ContactMode::stick);
    const std::int64_t begun = motion.counts().entered[stick] - before[stick];
    sticks += begun;
    EXPECT_EQ(static_cast<std::int64_t>(points.size() - known), begun) << begin;
    if (points.size() > known) {
      EXPECT_GE(points.back().time, begin);
    }
  }
  EXPECT_GE(sticks, 50);
  EXPECT_GT(sticking_samples, 2 * sticks);
  for (const SectionPoint& point : points) EXPECT_FALSE(point.engaged);
}

TEST(Section, HasTwoPointsInEachForcingPeriodWhereTheMotionHasItsPeriod) {
  const ImplementedLoop loop = section_loop(0.001, 0.0005, Switching::exact);
  const auto points = section_of(loop, 30000);
  ASSERT_GT(points.size(), 500U);
  for (std::size_t k = points.size() - 200; k < points.size(); ++k) {
    EXPECT_NEAR(points[k].time - points[k - 2].time, 0.1, 1e-9);
    EXPECT_NE(points[k].rising, points[k - 1].rising);
    EXPECT_LE((points[k].state - points[k - 2].state).cwiseAbs().maxCoeff(), 1e-9);
  }
}

TEST(Section, AMotionAtRestHasNoPoint) {
  for (const Switching switching : {Switching::sampled, Switching::exact}) {
    ImplementedLoop loop = section_loop(0.001, 0.0005, switching);
    loop.digital.force.harmonics.clear();
    EXPECT_TRUE(section_of(loop, 1000).empty());
  }
}

TEST(Section, ADivergingMotionEnds) {
  for (const Switching switching : {Switching::sampled, Switching::exact}) {
    ImplementedLoop loop = section_loop(0.011, 0.0, switching);
    loop.digital.sampling.processing_delay = 0.011;
    auto motion = event_motion(loop, Vector<double, 4>::Zero());
    const auto outcome = run_section(motion, 100000, [](const SectionPoint&) {});
    EXPECT_EQ(outcome, TrajectoryOutcome::diverged);
    EXPECT_EQ(expect_scanned(loop, 3000, 20), 0U) << "also where squares leave the range";
  }
}

TEST(Section, TheRestOfAPolynomialIsItself) {
  test::Random random(99);
  for (int trial = 0; trial < 200; ++trial) {
    Series p(1 + static_cast<Eigen::Index>(random.index(most_terms)));
    double factorial = 1.0;
    for (Eigen::Index k = 0; k < p.size(); ++k) {
      p[k] = random.uniform(-1.0, 1.0) / factorial;
      factorial *= static_cast<double>(k + 1);
    }
    const double from = random.unit(), y = random.unit();
    const double direct = value_and_slope(p, from + y * (1.0 - from)).value;
    EXPECT_NEAR(value_and_slope(rest_of(p, from), y).value, direct, 1e-14);
  }
}

}  // namespace
}  // namespace holdfast
