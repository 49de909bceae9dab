// The motion of a conductor by its modes in O(N), against the dense stepper of the same plant.

#include "holdfast/motion/modal/modal_motion.hpp"
#include "holdfast/cable/taut_string.hpp"
#include "holdfast/motion/ideal_loop.hpp"
#include "holdfast/motion/modal/natural_motions.hpp"
#include "holdfast/motion/trajectory.hpp"

#include "support/random.hpp"
#include "support/string_case.hpp"

namespace holdfast::test {
namespace {

ModalLoop papers_loop(int modes, double place = 0.64) {
  const TwoMass<double> masses = kollar2022_plant();
  return {string_modes(taut_string(kollar2022_conductor()), place, modes),
          {masses.absorber_mass, masses.absorber_stiffness, masses.absorber_damping, 0.01},
          {0.003, 0.0},
          {-557.0, -4.0},
          {0.5, 10.0},
          0.0005,
          ForceHold::sampled};
}

auto dense_motion(const ModalLoop& loop, const ModalMotion::Full& state) {
  return harmonically_forced_motion(
      IdealLoop<double, LinearPlant<double>>{modal_plant(loop.modes, loop.absorber), loop.sampling,
                                             loop.gains, loop.excitation, loop.backlash_width,
                                             loop.hold},
      state);
}

ModalMotion::Full random_state(int modes, std::uint64_t seed) {
  Random random(seed);
  ModalMotion::Full state(2 * modes + 2);
  for (double& part : state) part = random.uniform(-1e-3, 1e-3);
  return state;
}

void expect_same_motion(const ModalLoop& loop, const ModalMotion::Full& state, int samples) {
  auto motion = modal_motion(loop, state);
  ASSERT_TRUE(motion.has_value());
  auto dense = dense_motion(loop, state);
  Vector<double, 4> largest = Vector<double, 4>::Constant(1e-12),
                    misfit = Vector<double, 4>::Zero();
  int gaps = 0;
  for (int j = 0; j < samples; ++j) {
    const auto found = motion->sense();
    const auto expected = dense.sense();
    const Vector<double, 4> state4 = dense.readings().both_sides(expected.state);
    largest = largest.cwiseMax(state4.cwiseAbs());
    misfit = misfit.cwiseMax((found.state - state4).cwiseAbs());
    ASSERT_EQ(found.engaged, expected.engaged) << j;
    EXPECT_EQ(found.index, expected.index);
    EXPECT_EQ(found.time, expected.time);
    gaps += found.engaged ? 0 : 1;
    motion->advance();
    dense.advance();
  }
  EXPECT_TRUE((misfit.array() <= 1e-11 * largest.array()).all())
      << misfit.transpose() << " of " << largest.transpose();
  EXPECT_GT(gaps, 0);
}

TEST(ModalMotion, IsThatOfTheDenseStepper) {
  for (const int modes : {1, 7, 40}) {
    for (const double delay : {0.0, 0.001, 0.003}) {
      for (const ForceHold hold : {ForceHold::sampled, ForceHold::exact}) {
        ModalLoop loop = papers_loop(modes);
        loop.sampling.processing_delay = delay;
        loop.hold = hold;
        expect_same_motion(loop, random_state(modes, 7), 1500);
      }
    }
  }
}

/// Modes with a node at the absorber, exactly or nearly, move nothing there or hardly.
TEST(ModalMotion, BearsModesThatThePlaceHardlySees) {
  for (const double place : {3.2, 3.2 + 1e-13, 3.2 + 1e-9, 3.2 + 1e-6, 3.2 + 1e-4})
    expect_same_motion(papers_loop(12, place), random_state(12, 3), 800);
}

/// An absorber that overdamps its own motion: two real poles.
TEST(ModalMotion, BearsRealPoles) {
  ModalLoop loop = papers_loop(9);
  loop.absorber.damping = 30.0;
  expect_same_motion(loop, random_state(9, 5), 800);
}

/// Of an overdamped mode, and of one besides that the place hardly sees, both motions are real.
TEST(ModalMotion, BearsOverdampedModes) {
  ModalLoop loop = papers_loop(7);
  loop.modes[3].damping_ratio = 1.7;
  loop.modes[5].damping_ratio = 4.0;
  for (const double shape : {0.8, 1e-5, 1e-9, 0.0}) {
    loop.modes[5].shape = shape;
    expect_same_motion(loop, random_state(7, 11), 1500);
  }
}

/// The shape of a kick: what a force at the place would bend. Without play, which the round-off of
/// Δż = 0 would decide.
TEST(ModalMotion, AKickBendsTheConductorAsAForceAtThePlace) {
  ModalLoop loop = papers_loop(20);
  loop.backlash_width = 0.0;
  ModalMotion::Full bent = ModalMotion::Full::Zero(42);
  double there = 0.0;
  for (int n = 0; n < 20; ++n) {
    const PlaceMode<double>& mode = loop.modes[static_cast<std::size_t>(n)];
    bent[2 * n] = mode.shape / (mode.mass * mode.angular_frequency * mode.angular_frequency);
    there += mode.shape * bent[2 * n];
  }
  auto kicked = *modal_motion(loop, ModalMotion::Full::Zero(42));
  auto begun = *modal_motion(loop, 0.001 / there * bent);
  kicked.displace_conductor(0.001);
  EXPECT_NEAR(kicked.state()[0], 0.001, 1e-15);
  EXPECT_LT((kicked.state() - begun.state()).cwiseAbs().maxCoeff(), 1e-15)
      << kicked.state().transpose() << " | " << begun.state().transpose();
  for (int j = 0; j < 500; ++j) {
    EXPECT_NEAR(kicked.sense().state[2], begun.sense().state[2], 1e-14);
    kicked.advance();
    begun.advance();
  }
}

TEST(ModalMotion, RefusesWhatIsNotAdmissible) {
  ModalLoop loop = papers_loop(3);
  EXPECT_THROW(modal_motion(loop, ModalMotion::Full::Zero(7)), InvalidParameter);
  EXPECT_THROW(modal_motion(loop, ModalMotion::Full::Constant(8, NAN)), InvalidParameter);
  loop.backlash_width = -1.0;
  EXPECT_THROW(modal_motion(loop, ModalMotion::Full::Zero(8)), InvalidParameter);
  loop = papers_loop(3);
  loop.modes.push_back(loop.modes.back());  // two that coincide are not told apart
  EXPECT_FALSE(modal_motion(loop, ModalMotion::Full::Zero(10)).has_value());
}

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
