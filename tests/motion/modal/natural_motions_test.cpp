#include "holdfast/motion/modal/natural_motions.hpp"

#include "holdfast/cable/taut_string.hpp"
#include "holdfast/motion/modal/modal_motion.hpp"
#include "support/random.hpp"
#include "support/string_case.hpp"
#include "support/testing.hpp"

namespace holdfast::test {
namespace {

ModalLoop loop_of(const std::vector<PlaceMode<double>>& modes) {
  return {modes,  papers_absorber(0.01), {0.003, 0.001}, {-557.0, -4.0}, {0.5, 10.0},
          0.0005, ForceHold::exact};
}

ModalMotion::Full random_state(Random& random, const ModalLoop& loop) {
  ModalMotion::Full state(2 * static_cast<Eigen::Index>(loop.modes.size()) + 2);
  for (double& part : state) part = random.uniform(-1.0, 1.0);
  return state;
}

/// A string, one with a mode that the place hardly sees and one with a node there, and one with a
/// mode damped more than critically.
std::vector<ModalLoop> loops() {
  const auto string = taut_string(kollar2022_conductor());
  std::vector<ModalLoop> all(4, loop_of(string_modes(string, 0.64, 8)));
  all[1].modes[4].shape = 1e-7;
  all[2].modes[4].shape = 0.0;
  all[3].modes[5].damping_ratio = 4.0;
  return all;
}

TEST(NaturalMotions, EveryStateIsMadeOfThem) {
  Random random(4231);
  for (const ModalLoop& loop : loops()) {
    const NaturalMotions motions(loop, plant_poles(loop.modes, loop.absorber));
    EXPECT_EQ(2 * motions.pairs() + (motions.size() - motions.pairs()), 2 * loop.modes.size() + 2);
    const ModalMotion::Full state = random_state(random, loop);
    Eigen::VectorXcd amplitudes(static_cast<Eigen::Index>(motions.size()));
    for (std::size_t k = 0; k < motions.size(); ++k)
      amplitudes[static_cast<Eigen::Index>(k)] = motions.amplitude(k, state);
    EXPECT_LE((motions.state_of(amplitudes) - state).cwiseAbs().maxCoeff(), 1e-8);
    const auto motion = modal_motion(loop, state);
    ASSERT_TRUE(motion.has_value());
    EXPECT_LE((motion->amplitudes() - amplitudes).cwiseAbs().maxCoeff(), 1e-14);
    EXPECT_LE((motions.seen(amplitudes) - motion->state()).cwiseAbs().maxCoeff(), 1e-12);
  }
}

/// Two parts of a sampling period are the whole one.
TEST(NaturalMotions, APartOfASamplingPeriodIsThatOfAShorterOne) {
  const ModalLoop loop = loops().front();
  const NaturalMotions motions(loop, plant_poles(loop.modes, loop.absorber));
  for (const double length : {0.0005, 0.001, 0.002, 0.003}) {
    ModalLoop shorter = loop;
    shorter.sampling = {length, std::min(length, loop.sampling.processing_delay)};
    const NaturalMotions whole(shorter, plant_poles(loop.modes, loop.absorber));
    for (std::size_t k = 0; k < motions.size(); ++k) {
      const NaturalMotion part = motions.over(k, length);
      for (const auto number : {&NaturalMotion::decay, &NaturalMotion::present,
                                &NaturalMotion::past, &NaturalMotion::cosine, &NaturalMotion::sine})
        EXPECT_EQ(part.*number, whole[k].*number) << length;
    }
  }
}

}  // namespace
}  // namespace holdfast::test
