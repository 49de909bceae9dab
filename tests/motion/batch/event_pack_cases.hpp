#pragma once

#include "motion/batch/event_pack_setting.hpp"

/// The tests of EventPack for one type of lanes, to be read by a test of its own namespace.
namespace holdfast::test {

template <class Scalar>
void expect_regular_motions_are_those_alone() {
  constexpr std::int64_t samples = 1500;
  const auto motions = regular_motions();
  const auto seen = seen_in_packs<Scalar>(motions, samples);
  std::size_t switches = 0, regular = 0;
  for (std::size_t k = 0; k < motions.size(); ++k) {
    const SeenMotion alone = seen_alone(motions[k], samples);
    // Not where the loop grows, as it does with the longest delays: rounding grows with it.
    if (!(alone.states.back().cwiseAbs().maxCoeff() < 1.0)) continue;
    SCOPED_TRACE(k);
    const MotionGap gap = gap_between(alone, seen[k]);
    EXPECT_TRUE(gap.same_contacts);
    EXPECT_LE(gap.instants, 1e-12);
    EXPECT_LE(gap.states, 1e-11);
    switches += alone.switches.size();
    ++regular;
  }
  EXPECT_GT(regular, motions.size() / 2);
  EXPECT_GT(switches, 5000U);
}

/// Of random loops many are chaotic or graze; all of them begin alike.
template <class Scalar>
void expect_random_motions_are_those_alone() {
  constexpr std::int64_t samples = 40;
  Random random(5521);
  std::vector<ExactMotion> motions;
  for (int k = 0; k < 1003; ++k) motions.push_back(random_exact(random));
  const auto seen = seen_in_packs<Scalar>(motions, samples);
  std::size_t same = 0, switches = 0, accumulating = 0;
  for (std::size_t k = 0; k < motions.size(); ++k) {
    SCOPED_TRACE(k);
    const SeenMotion alone = seen_alone(motions[k], samples);
    EXPECT_EQ(alone.accumulates, seen[k].accumulates);
    for (std::size_t j = 0; j < alone.states.size(); ++j)
      EXPECT_EQ(alone.states[j].allFinite(), seen[k].states[j].allFinite());
    accumulating += alone.accumulates ? 1 : 0;
    if (alone.accumulates) continue;
    const MotionGap gap = gap_between(alone, seen[k]);
    same += gap.same_contacts && gap.states < 1e-9 ? 1 : 0;
    switches += alone.switches.size();
  }
  EXPECT_GE(same + accumulating, motions.size() - 5);
  EXPECT_GT(switches, 10'000U);
}

/// A lane's numbers do not depend on its neighbours, to the last bit.
template <class Scalar>
void expect_lanes_do_not_see_each_other() {
  constexpr std::int64_t samples = 100;
  Random random(88);
  std::vector<ExactMotion> motions;
  for (std::size_t k = 0; k < EventPack<Scalar>::lanes; ++k)
    motions.push_back(random_exact(random));
  motions.front() = kollar_exact(0.005, 0.001);
  const auto together = seen_in_pack<Scalar>(motions, samples);
  for (std::size_t k = 0; k < motions.size(); ++k) {
    const auto alone = seen_in_pack<Scalar>({motions[k]}, samples);
    ASSERT_EQ(alone[0].switches.size(), together[k].switches.size());
    for (std::size_t j = 0; j < alone[0].switches.size(); ++j)
      EXPECT_EQ(alone[0].switches[j].after, together[k].switches[j].after);
    for (std::size_t j = 0; j < alone[0].states.size(); ++j)
      for (Eigen::Index i = 0; i < 4; ++i)
        EXPECT_TRUE(std::isnan(alone[0].states[j][i]) ||
                    alone[0].states[j][i] == together[k].states[j][i]);
  }
}

/// One lane grows beyond all numbers, the others go on as if it were not there.
template <class Scalar>
void expect_a_diverging_lane_disturbs_no_other() {
  std::vector<ExactMotion> motions(EventPack<Scalar>::lanes, kollar_exact(0.005, 0.001));
  motions.back().loop.digital.gains = {3e5, 3e5};
  constexpr std::int64_t samples = 3000;
  const auto seen = seen_in_pack<Scalar>(motions, samples);
  EXPECT_FALSE(seen.back().states.back().allFinite());
  if (motions.size() < 2) return;
  const MotionGap gap = gap_between(seen_alone(motions[0], samples), seen[0]);
  EXPECT_TRUE(gap.same_contacts);
  EXPECT_LE(gap.states, 1e-11);
}

/// The unforced absorber is set so that Δz touches the end of its gap and turns: rounding decides,
/// and either way the motion goes on within it.
template <class Scalar>
void expect_grazing_is_survived() {
  std::vector<ExactMotion> motions;
  for (const double nearness : {-1e-6, -1e-12, 0.0, 1e-12, 1e-6}) {
    ExactMotion motion = kollar_exact(0.005, 0.001);
    motion.loop.digital.force.harmonics.clear();
    motion.loop.plant.absorber_damping = motion.loop.plant.conductor_damping = 0.0;
    motion.loop.backlash = {ContactLaw::dead_zone, 0.002 * (1.0 + nearness), 50.0, 0.0};
    motion.loop.digital.gains = {0.0, 0.0};
    motion.state = {0.0, 0.0, 0.001, 0.0};
    motions.push_back(motion);
  }
  constexpr std::int64_t samples = 400;
  const auto seen = seen_in_packs<Scalar>(motions, samples);
  for (std::size_t k = 0; k < motions.size(); ++k) {
    const SeenMotion alone = seen_alone(motions[k], samples);
    for (std::size_t j = 0; j < alone.states.size(); ++j)
      EXPECT_LE((alone.states[j] - seen[k].states[j]).cwiseAbs().maxCoeff(), 1e-9) << k;
  }
}

/// A command that begins at a sample ends a stick there: the change lies on the border of a step.
template <class Scalar>
void expect_events_at_the_border_of_a_step() {
  // Of no damping and no force: Δż comes to zero after half a period, and that is a sample.
  ExactMotion motion = kollar_exact(0.01, 0.0005);
  TwoMass<double>& plant = motion.loop.plant;
  plant.conductor_damping = plant.absorber_damping = 0.0;
  plant.conductor_stiffness = 1e9;
  plant.conductor_mass = 1e9;
  const double omega = std::sqrt(plant.absorber_stiffness / plant.absorber_mass);
  const double pi_value = 3.141592653589793;
  for (const double parts : {1.0, 4.0, 4.5}) {
    ExactMotion at = motion;
    at.loop.digital.sampling = {pi_value / omega / parts, 0.0};
    at.loop.digital.force.harmonics.clear();
    at.loop.digital.gains = {0.0, 0.0};
    at.state = {0.0, 0.0, 0.0, 0.01};
    const auto seen = seen_in_pack<Scalar>({at}, 40);
    const SeenMotion alone = seen_alone(at, 40);
    ASSERT_EQ(seen[0].switches.size(), alone.switches.size());
    ASSERT_GT(alone.switches.size(), 2U);
    for (std::size_t k = 0; k < alone.switches.size(); ++k) {
      const auto time = [&](const MotionSwitch& of) {
        return static_cast<double>(of.sample) * at.loop.digital.sampling.period + of.after;
      };
      EXPECT_NEAR(time(seen[0].switches[k]), time(alone.switches[k]), 1e-9);
      EXPECT_EQ(seen[0].switches[k].to, alone.switches[k].to);
    }
  }
}

}  // namespace holdfast::test
