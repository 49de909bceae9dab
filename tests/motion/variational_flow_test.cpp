#include "holdfast/motion/variational_flow.hpp"

#include "orbit/event/event_setting.hpp"
#include "support/dense_routes.hpp"
#include "support/move_samples.hpp"

namespace holdfast {
namespace {

constexpr int tangent_engaged = static_cast<int>(ContactMode::engaged);
constexpr int tangent_gap = static_cast<int>(ContactMode::gap);
constexpr int tangent_stick = static_cast<int>(ContactMode::stick);

Matrix<double, 7> scaled_by(const Vector<double, 7>& sizes, const Matrix<double, 7>& map) {
  return sizes.cwiseInverse().asDiagonal() * map * sizes.asDiagonal();
}

/// Takes a motion through samples. @return the product of its maps
Matrix<double, 7> advance_with(VariationalFlow<DriveContact<>>& tangent, EventMotion<>& motion,
                               int samples) {
  Matrix<double, 7> product = Matrix<double, 7>::Identity();
  for (int sample = 0; sample < samples; ++sample) {
    motion.sense();
    tangent.begin_sample(motion);
    motion.advance(tangent);
    product = (tangent.map() * product).eval();
  }
  return product;
}

/// What comparisons with differences came to.
struct Comparison {
  double worst = 0.0;  ///< error against the largest entry of the map, in sizes
  int compared = 0;    ///< directions
  int other_way = 0;   ///< directions in which a neighbour switches otherwise
  int unresolved = 0;  ///< directions in which the differences are not sure themselves
  std::map<std::array<int, 3>, int> switches;  ///< seen, by from, to and guard
  int seen(int from, int to) const {
    int sum = 0;
    for (const auto& [kind, count] : switches)
      if (kind[0] == from && kind[1] == to) sum += count;
    return sum;
  }
  int by_guard(int from, int to, int guard) const {
    const auto found = switches.find({from, to, guard});
    return found == switches.end() ? 0 : found->second;
  }
};

/// Directions in which X may be moved: z, u_{j−1}, and the gap where there is one; while the drive
/// sticks, both masses have one velocity and stand at an end of the gap.
std::vector<Vector<double, 7>> admissible_directions(const EventMotion<>& motion, bool anchored) {
  const Vector<double, 7> sizes = test::sizes_of(motion);
  const bool sticks = motion.contact().word() == ContactMode::stick;
  std::vector<Vector<double, 7>> directions;
  for (int column = 0; column < (anchored ? 6 : 5); ++column) {
    if (sticks && (column == 3 || column == 5)) continue;
    Vector<double, 7> direction = Vector<double, 7>::Unit(column) * sizes[column];
    if (sticks) {
      direction[3] = direction[1];
      direction[5] = direction[2] - direction[0];
    }
    directions.push_back(direction);
  }
  return directions;
}

/// Compares the product of the maps over `samples` with differences of the motion.
void compare_with_differences(const EventMotion<>& motion, int samples, double step,
                              Comparison& comparison) {
  EventMotion<> followed = motion, recorded = motion;
  VariationalFlow<DriveContact<>> tangent(motion);
  const Matrix<double, 7> product = advance_with(tangent, followed, samples);
  test::SwitchNotes notes(recorded);
  notes.move(samples);
  for (const auto& seen : notes.switches) ++comparison.switches[{seen.from, seen.to, seen.guard}];

  const Vector<double, 7> sizes = test::sizes_of(motion);
  const double scale = scaled_by(sizes, product).cwiseAbs().maxCoeff();
  const bool anchored = motion.contact().is_anchored(motion.contact().mode());
  for (const auto& direction : admissible_directions(motion, anchored)) {
    const auto difference =
        test::derivative_along(motion, direction, step, samples, notes.switches);
    if (!difference) {
      ++comparison.other_way;
    } else if (difference->error > 1e-5 * scale) {
      ++comparison.unresolved;
    } else {
      const Vector<double, 7> error = product * direction - difference->value;
      comparison.worst =
          std::max(comparison.worst, error.cwiseQuotient(sizes).cwiseAbs().maxCoeff() / scale);
      ++comparison.compared;
    }
  }
}

/// Whether a motion changes its contact in the coming sample.
bool is_about_to_switch(EventMotion<> motion) {
  test::SwitchNotes notes(motion);
  notes.move(1);
  return !notes.switches.empty();
}

/// Along a motion: all samples with a change of contact, and some without.
void compare_along(EventMotion<> motion, int total, int samples, double step,
                   Comparison& comparison) {
  test::move_samples(motion, 20);
  for (int sample = 0; sample < total; ++sample) {
    const bool wanted = samples == 1 ? sample % 41 == 0 || is_about_to_switch(motion)
                                     : sample % (2 * samples - 3) == 0;
    if (wanted) compare_with_differences(motion, samples, step, comparison);
    test::move_samples(motion, 1);
  }
}

int samples_in(const test::EventSetting& setting, double duration) {
  return static_cast<int>(std::min(1500.0, duration / setting.loop.sampling.period));
}

/// A recorded force with many rows is taken piece by piece, and a jittering clock has no two
/// periods alike: δX is what the exponential of the whole makes of it.
TEST(VariationalFlow, DoesNotDependOnTheStepsOfTheMotion) {
  test::Random random(902);
  for (int trial = 0; trial < 30; ++trial) {
    auto setting = test::random_event_setting(random, trial);
    setting.width = 0.0;
    setting.loop.hold = ForceHold::exact;
    const double period = setting.loop.sampling.period;
    std::vector<double> times, forces;
    for (int row = 0; row < 200; ++row) {
      times.push_back(0.13 * period * row);
      forces.push_back(random.uniform(-1.0, 1.0));
    }
    setting.loop.force.record =
        std::make_shared<const RecordedForce>(times, forces, RecordInterpolation::held);
    const bool jitters = trial % 3 == 0;
    if (jitters) setting.loop.jitter = {0.1 * period, 5};
    auto motion = setting.motion();
    VariationalFlow<DriveContact<>> tangent(motion);
    const Vector<double, 7> sizes = test::sizes_of(motion);
    for (int sample = 0; sample < 10; ++sample) {
      const Sampling<double> sampling{motion.period(), setting.loop.sampling.processing_delay};
      const Matrix<double, 5> expected =
          sampled_loop(setting.plant, sampling).engaged_map(setting.loop.gains);
      const Matrix<double, 7> map = advance_with(tangent, motion, 1);
      const Matrix<double, 7> error = scaled_by(sizes, map);
      Matrix<double, 7> whole = Matrix<double, 7>::Zero();
      whole.topLeftCorner<5, 5>() = expected;
      EXPECT_LT((error - scaled_by(sizes, whole)).norm(), 1e-11 * error.norm());
    }
  }
}

TEST(VariationalFlow, ALawThatIsAskedAtSamplesGivesTheMapsOfTheSampledLoop) {
  test::Random random(903);
  int engaged = 0, inside = 0;
  for (int trial = 0; trial < 12; ++trial) {
    const auto setting = test::random_event_setting(random, trial);
    const DriveContact<> contact(setting.plant, {ContactLaw::kollar, setting.width},
                                 Switching::sampled, Vector<double, 4>::Zero());
    EventMotion<> motion(setting.loop, contact, Vector<double, 4>::Zero());
    VariationalFlow<DriveContact<>> tangent(motion);
    const auto sampled = sampled_loop(setting.plant, setting.loop.sampling);
    const Vector<double, 7> sizes = test::sizes_of(motion);
    for (int sample = 0; sample < 300; ++sample) {
      const bool transmits = motion.sense().engaged;
      tangent.begin_sample(motion);
      motion.advance(tangent);
      Matrix<double, 7> expected = Matrix<double, 7>::Zero();
      expected.topLeftCorner<5, 5>() =
          transmits ? sampled.engaged_map(setting.loop.gains) : sampled.backlash_map();
      const Matrix<double, 7> scaled = scaled_by(sizes, expected);
      ASSERT_LT((scaled_by(sizes, tangent.map()) - scaled).norm(), 1e-13 * scaled.norm());
      ++(transmits ? engaged : inside);
    }
  }
  EXPECT_GT(engaged, 300);
  EXPECT_GT(inside, 300);
}

TEST(VariationalFlow, IsTheDerivativeOfTheFlowOverASample) {
  test::Random random(904);
  Comparison all;
  for (int trial = 0; trial < 50; ++trial) {
    const auto setting = test::bounded_event_setting(random, trial);
    compare_along(setting.motion(), samples_in(setting, 2.0), 1, 1e-5, all);
  }
  EXPECT_LT(all.worst, 1e-7);
  EXPECT_GT(all.compared, 10000);
  EXPECT_LT(all.other_way, all.compared / 50);
  EXPECT_LT(all.unresolved, all.compared / 500);
  // Every change of contact that there is, at surfaces (guard 0, 1) and by jumps at a sample (−2)
  // or at t_j + δ (−1). F does not jump at t_j + δ, so that stick does not end in a gap there.
  EXPECT_GT(all.seen(tangent_engaged, tangent_gap), 100);
  EXPECT_GT(all.seen(tangent_engaged, tangent_stick), 100);
  for (const int end : {0, 1}) EXPECT_GT(all.by_guard(tangent_gap, tangent_engaged, end), 100);
  EXPECT_GT(all.by_guard(tangent_stick, tangent_gap, 0), 100);
  EXPECT_GT(all.by_guard(tangent_stick, tangent_gap, -2), 100);
  for (const int guard : {1, -1, -2})
    EXPECT_GT(all.by_guard(tangent_stick, tangent_engaged, guard), 0) << guard;
}

/// With differences of displacements as velocity, a force that saturates and a clock that jitters;
/// over three samples, so that what was read at one is used at the next.
TEST(VariationalFlow, KnowsWhatTheControllerReads) {
  test::Random random(906);
  Comparison all;
  for (int trial = 0; trial < 24; ++trial) {
    auto setting = test::bounded_event_setting(random, trial);
    setting.loop.limits.velocity = VelocitySensing::difference;
    if (trial % 4 == 1) setting.loop.limits.largest_force = 0.2;
    if (trial % 4 == 2) setting.loop.limits.displacement_quantum = 2e-5;
    if (trial % 4 == 3 &&
        setting.loop.sampling.processing_delay < 0.5 * setting.loop.sampling.period)
      setting.loop.jitter = {0.2 * setting.loop.sampling.period, 7};
    if (!test::stays_small(setting.motion(), 2.0)) continue;
    compare_along(setting.motion(), samples_in(setting, 1.0), 3, 1e-5, all);
  }
  EXPECT_LT(all.worst, 1e-6);
  EXPECT_GT(all.compared, 3000);
  EXPECT_LT(all.other_way, all.compared / 20);
}

TEST(VariationalFlow, ADeadZoneWithStops) {
  test::Random random(907);
  Comparison all;
  for (int trial = 0; trial < 24; ++trial) {
    const auto setting = test::random_event_setting(random, trial);
    const double stiffness = trial % 2 == 0 ? 0.0 : random.uniform(50.0, 1000.0);
    const double damping = trial % 4 < 2 ? 0.0 : random.uniform(0.5, 10.0);
    const Vector<double, 4> rest = Vector<double, 4>::Zero();
    const DriveContact<> contact =
        test::exact_dead_zone(setting.plant, setting.width, stiffness, damping, rest);
    const EventMotion<> motion(setting.loop, contact, rest);
    if (!test::stays_small(motion, 2.0)) continue;
    compare_along(motion, samples_in(setting, 1.0), 1, 1e-5, all);
  }
  EXPECT_LT(all.worst, 1e-7);
  EXPECT_GT(all.compared, 1000);
  EXPECT_LT(all.other_way, all.compared / 20);
  for (const int stop : {0, 2}) {
    EXPECT_GT(all.seen(1, stop), 50);
    EXPECT_GT(all.seen(stop, 1), 50);
  }
}

TEST(VariationalFlow, WhileTheDriveSticksTheMassesHaveOneVelocityExactly) {
  test::Random random(908);
  int stuck = 0;
  for (int trial = 0; trial < 20; ++trial) {
    const auto setting = test::bounded_event_setting(random, trial);
    auto motion = setting.motion();
    VariationalFlow<DriveContact<>> tangent(motion);
    for (int sample = samples_in(setting, 2.0); sample > 0; --sample) {
      const bool was_stuck = motion.contact().mode() == tangent_stick;
      const Matrix<double, 7> map = advance_with(tangent, motion, 1);
      if (motion.contact().mode() != tangent_stick) continue;
      EXPECT_EQ(map.row(1), map.row(3));
      ++stuck;
      if (was_stuck) continue;
      // The gap lies where the drive has stuck since.
      const double size = map.row(5).cwiseAbs().maxCoeff();
      EXPECT_LT((map.row(2) - map.row(0) - map.row(5)).cwiseAbs().maxCoeff(), 1e-12 * size);
    }
  }
  EXPECT_GT(stuck, 200);
}

TEST(VariationalFlow, WhileTheDriveIsEngagedTheGapIsForgotten) {
  test::Random random(909);
  int engaged = 0, inside = 0;
  for (int trial = 0; trial < 20; ++trial) {
    const auto setting = test::bounded_event_setting(random, trial);
    auto motion = setting.motion();
    VariationalFlow<DriveContact<>> tangent(motion);
    for (int sample = samples_in(setting, 2.0); sample > 0; --sample) {
      const bool switches = is_about_to_switch(motion);
      const int before = motion.contact().mode();
      const Matrix<double, 7> map = advance_with(tangent, motion, 1);
      if (motion.contact().mode() == tangent_engaged) {
        EXPECT_EQ(map.row(5).cwiseAbs().maxCoeff(), 0.0);
        ++engaged;
      } else if (before == tangent_gap && !switches) {
        EXPECT_EQ(map.row(5), (RowVector<double, 7>::Unit(5)));
        EXPECT_EQ(map.col(5), (Vector<double, 7>::Unit(5)));
        ++inside;
      }
    }
  }
  EXPECT_GT(engaged, 1000);
  EXPECT_GT(inside, 1000);
}

/// No direction is left beyond the structural rank but by rounding, and none is missing: over few
/// samples the contraction of the directions that are left is far from rounding.
TEST(VariationalFlow, TheStructuralRankIsThatOfTheProduct) {
  test::Random random(910);
  std::array<int, 8> seen{};
  for (int trial = 0; trial < 60; ++trial) {
    auto setting = test::bounded_event_setting(random, trial);
    if (trial % 4 == 3) setting.loop.limits.velocity = VelocitySensing::difference;
    if (!test::stays_small(setting.motion(), 3.0)) continue;
    auto motion = setting.motion();
    const Vector<double, 7> sizes = test::sizes_of(motion);
    const int samples = 1 + trial % 3;
    for (int left = samples_in(setting, 2.0); left > samples; left -= samples) {
      VariationalFlow<DriveContact<>> tangent(motion);
      const Matrix<double, 7> product = advance_with(tangent, motion, samples);
      const Eigen::VectorXd singular = test::singular_values_of(scaled_by(sizes, product));
      const Eigen::VectorXd stretches = singular / singular[0];
      const int rank = tangent.rank_of_product();
      ASSERT_LT(rank == 7 ? 0.0 : stretches[rank], 1e-14);
      ASSERT_GT(stretches[rank - 1], 1e-13);
      ++seen[static_cast<std::size_t>(rank)];
    }
  }
  for (const std::size_t rank : {3U, 4U, 5U, 6U}) EXPECT_GT(seen[rank], 20) << rank;
}

}  // namespace
}  // namespace holdfast
