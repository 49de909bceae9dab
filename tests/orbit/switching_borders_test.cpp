#include "holdfast/orbit/switching_borders.hpp"

#include "support/random.hpp"

namespace holdfast {
namespace {

using CourseStates = std::vector<Vector<double, 5>>;

/// States with the given Δz and Δż.
CourseStates course(const std::vector<std::pair<double, double>>& relative) {
  CourseStates states;
  for (const auto& [displacement, velocity] : relative) {
    Vector<double, 5> state = Vector<double, 5>::Zero();
    state[2] = displacement;
    state[3] = velocity;
    states.push_back(state);
  }
  return states;
}

Itinerary itinerary_of(const SwitchingPattern& pattern) {
  Itinerary itinerary;
  for (const ContactDecision& decision : pattern.decisions)
    itinerary.push_back(decision.engaged ? 1 : 0);
  return itinerary;
}

TEST(SwitchingPattern, NotesReversalsGapsAndExits) {
  // Up to Δz = 3, back down to −3; gap 2. It enters after each reversal and leaves 2 behind it.
  const CourseStates states = course(
      {{0, 1}, {2, 1}, {3, -0.5}, {2.5, -1}, {0, -1}, {-2, -1}, {-3, 0.25}, {-2.5, 1}, {-0.5, 1}});
  const SwitchingPattern pattern = switching_pattern(states, Backlash<double>(2.0));
  EXPECT_EQ(itinerary_of(pattern), (Itinerary{1, 1, 0, 0, 1, 1, 0, 0, 1}));
  EXPECT_TRUE(has_itinerary(pattern, itinerary_of(pattern)));
  EXPECT_FALSE(has_itinerary(pattern, {1, 1, 0, 0, 1, 1, 0, 0, 0}));
  EXPECT_FALSE(has_itinerary(pattern, {1, 1, 0, 0, 1, 1, 0, 0}));
  EXPECT_EQ(pattern.decisions[4].exit_side, -1);
  EXPECT_EQ(pattern.decisions[8].exit_side, 1);
  EXPECT_EQ(pattern.decisions[2].velocity_sign, -1);
  EXPECT_EQ(pattern.decisions[3].velocity_sign, 0) << "in the gap Δż decides nothing";

  const Borders borders = borders_of(pattern, states, 2.0);
  EXPECT_EQ(borders.velocity.distance, 0.25);
  EXPECT_EQ(borders.velocity.sample, 6);
  EXPECT_EQ(borders.velocity.surface, SwitchingSurface::reversal);
  EXPECT_EQ(borders.displacement.distance, 0.5) << "2.5 in the gap [1, 3]";
  EXPECT_EQ(borders.displacement.sample, 3);
  EXPECT_EQ(borders.displacement.surface, SwitchingSurface::gap_upper);
}

TEST(SwitchingPattern, WithoutBacklashNothingIsDecided) {
  const CourseStates states = course({{1, 1}, {1, -1}});
  const SwitchingPattern pattern = switching_pattern(states, Backlash<double>(0.0));
  EXPECT_EQ(itinerary_of(pattern), (Itinerary{1, 1}));
  const Borders borders = borders_of(pattern, states, 0.0);
  EXPECT_EQ(borders.velocity.distance, HUGE_VAL);
  EXPECT_EQ(borders.velocity.sample, -1);
  EXPECT_EQ(borders.displacement.sample, -1);
}

TEST(SwitchingPattern, AMotionThatStaysInsideKeepsTheGapItCameWith) {
  const CourseStates states = course({{0.1, 1}, {-0.2, -1}});
  const Backlash<double> law(1.0, {true, -0.7, 0.3, 1.0});
  const SwitchingPattern pattern = switching_pattern(states, law);
  EXPECT_EQ(itinerary_of(pattern), (Itinerary{0, 0}));
  const Borders borders = borders_of(pattern, states, 1.0);
  EXPECT_NEAR(borders.displacement.distance, 0.2, 1e-15);
  EXPECT_EQ(borders.displacement.surface, SwitchingSurface::gap_upper);
  EXPECT_EQ(borders.velocity.sample, -1);
}

TEST(SwitchingPattern, AReversalAtTheLastSampleIsSeenAtTheFirst) {
  // The gap is entered at the first sample, because of the last sample's Δż.
  const CourseStates states = course({{2, -1}, {1.5, -1}, {0, -1}, {-1, -1}, {0, 1}, {0.5, 1}});
  const SwitchingPattern pattern = switching_pattern(states, Backlash<double>(0.3));
  EXPECT_EQ(itinerary_of(pattern), (Itinerary{0, 1, 1, 1, 0, 1}));
}

// ---- borders of random courses -----------------------------------------------------------------

CourseStates random_course(test::Random& random, std::size_t samples) {
  CourseStates states;
  for (std::size_t j = 0; j < samples; ++j) states.push_back(random.matrix<Vector<double, 5>>());
  return states;
}

/// Whether the drive is in the same gap after one turn and after two.
bool repeats_after_one_turn(const CourseStates& states, Backlash<double> law) {
  const auto turn = [&] {
    for (const auto& state : states) law.step(state[2] - state[0], state[3] - state[1]);
    return law.memory();
  };
  const auto once = turn(), twice = turn();
  return once.inside == twice.inside && (!once.inside || once.lower == twice.lower);
}

TEST(Borders, NoSmallerChangeOfAStateChangesADecisionAndALargerOneDoes) {
  test::Random random(831);
  int changed_by_displacement = 0, changed_by_velocity = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const double width = random.uniform(0.2, 2.0);
    const CourseStates states = random_course(random, 2 + random.index(12));
    Backlash<double> law(width);
    if (!repeats_after_one_turn(states, law)) continue;
    for (const auto& state : states) law.step(state[2] - state[0], state[3] - state[1]);
    const SwitchingPattern pattern = switching_pattern(states, law);
    const Borders borders = borders_of(pattern, states, width);
    ASSERT_GE(borders.displacement.distance, 0.0);
    ASSERT_GE(borders.velocity.distance, 0.0);
    const auto changes = [&](const Border& border, Eigen::Index entry, double share) {
      bool changed = false;
      for (const double sign : {-1.0, 1.0}) {
        CourseStates moved = states;
        moved[static_cast<std::size_t>(border.sample)][entry] += sign * share * border.distance;
        changed = changed || !has_itinerary(switching_pattern(moved, law), itinerary_of(pattern));
      }
      return changed;
    };
    if (borders.velocity.sample >= 0) {
      EXPECT_FALSE(changes(borders.velocity, 3, 0.999)) << trial;
      changed_by_velocity += changes(borders.velocity, 3, 1.001) ? 1 : 0;
    }
    if (borders.displacement.sample < 0) continue;
    EXPECT_FALSE(changes(borders.displacement, 2, 0.999)) << trial;
    changed_by_displacement += changes(borders.displacement, 2, 1.001) ? 1 : 0;
  }
  EXPECT_GT(changed_by_displacement, 500);
  EXPECT_GT(changed_by_velocity, 500);
}

TEST(Borders, AreNegativeWhereAnotherCourseWouldDecideOtherwise) {
  const CourseStates states = course(
      {{0, 1}, {2, 1}, {3, -0.5}, {2.5, -1}, {0, -1}, {-2, -1}, {-3, 0.25}, {-2.5, 1}, {-0.5, 1}});
  const SwitchingPattern pattern = switching_pattern(states, Backlash<double>(2.0));
  CourseStates other = states;
  other[2][3] = 0.1;  // no reversal
  EXPECT_NEAR(borders_of(pattern, other, 2.0).velocity.distance, -0.1, 1e-15);
  other = states;
  other[3][2] = 3.25;  // out of the gap
  EXPECT_NEAR(borders_of(pattern, other, 2.0).displacement.distance, -0.25, 1e-15);
}

}  // namespace
}  // namespace holdfast
