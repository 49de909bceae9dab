#include "holdfast/contact/mode_dynamics.hpp"
#include "holdfast/excitation/force_over_samples.hpp"
#include "holdfast/motion/batch/lane_excitation.hpp"
#include "holdfast/motion/batch/lane_modes.hpp"
#include "holdfast/motion/batch/lane_numbers.hpp"
#include "holdfast/motion/batch/two_mass_series.hpp"
#include "holdfast/motion/taylor_step.hpp"
#include "holdfast/plant/energy.hpp"

#include "motion/batch/event_pack_setting.hpp"
#include "support/random_loop.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

TEST(LaneNumbers, AreReadAndWrittenBothWays) {
  LaneNumbers<double> numbers;
  EXPECT_EQ(numbers.all(), 0.0);
  numbers[0] = 2.0;
  EXPECT_EQ(numbers.all(), 2.0);
  numbers.set(3.0);
  EXPECT_EQ(numbers[0], 3.0);
}

class LaneModesOfOne : public testing::Test {
 protected:
  static LaneExcitation<double> excitation_of(const DigitalLoop& loop) {
    return LaneExcitation<double>([&](std::size_t) -> const DigitalLoop& { return loop; });
  }

  test::ExactMotion motion_ = test::kollar_exact(0.005, 0.001, 0.002);
  EventTable table_{motion_.loop};
  LaneExcitation<double> excitation_ = excitation_of(motion_.loop.digital);
  LaneModes<double> modes_{{EventStart{&motion_.loop, &table_, motion_.state}}, excitation_};
  const std::array<double, 4> z_{0.001, -0.02, 0.0015, 0.03};
};

TEST_F(LaneModesOfOne, BeginsWithoutASign) {
  EXPECT_TRUE(modes_.engaged());
  EXPECT_FALSE(modes_.sticks());
  EXPECT_TRUE(modes_.fresh());
  EXPECT_TRUE(modes_.without_sign()[0]);
  EXPECT_FALSE(modes_.with_two_guards()[0]);
  EXPECT_EQ(modes_.guard(0).at(z_, 0.0), z_[3] - z_[1]);
}

TEST_F(LaneModesOfOne, TheStepIsThatOfItsMode) {
  excitation_.begin_sample(0);
  for (const std::size_t part : {0U, 1U}) {
    const auto after = modes_.step(part).state(z_, 0.3, excitation_);
    const auto& step = table_.motion(0).step(part);
    const Vector<double, 4> expected =
        step.state({z_[0], z_[1], z_[2], z_[3]}, 0.3, 0.0, {{0.5, 0.0}});
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_NEAR(after[i], expected[static_cast<Eigen::Index>(i)], 1e-15);
  }
  EXPECT_NEAR(modes_.norm(z_), EnergyNorm(motion_.loop.plant)({z_[0], z_[1], z_[2], z_[3]}), 1e-15);
}

TEST_F(LaneModesOfOne, FollowsItsContactIntoTheGap) {
  DriveContact<>& contact = modes_.contact(0);
  contact.learn_sign(0, 1.0);
  ContactInstant now{{0.0, 0.0, 0.0, 0.0}, 0.0, 0.0};
  contact.reached(0, now);
  modes_.enter(0);
  EXPECT_EQ(contact.word(), ContactMode::gap);
  EXPECT_FALSE(modes_.engaged());
  EXPECT_TRUE(modes_.with_two_guards()[0]);
  EXPECT_TRUE(modes_.freshly_changed()[0]);
  // No force of the drive in the gap.
  EXPECT_EQ(modes_.accelerations(5.0)[0].constant, 0.0);
  modes_.flowed(0);
  EXPECT_FALSE(modes_.fresh());
  modes_.ignore_guards(0);
  EXPECT_FALSE(modes_.guarded());
  modes_.restart(0, motion_.state);
  EXPECT_TRUE(modes_.guarded());
  EXPECT_TRUE(modes_.engaged());
}

DigitalLoop forced_loop(ForceHold hold) {
  DigitalLoop loop;
  loop.sampling = {0.003, 0.001};
  loop.hold = hold;
  loop.force.harmonics = {{0.5, 10.0, 0.3}, {0.2, 31.0, -2.0}};
  return loop;
}

/// F (N) of harmonics.
double force_of(const std::vector<LanePhasor<double>>& phasors) {
  double sum = 0.0;
  for (const LanePhasor<double>& phasor : phasors) sum += phasor.phase.cosine;
  return sum;
}

TEST(LaneExcitation, IsTheForceOverSamples) {
  for (const ForceHold hold : {ForceHold::sampled, ForceHold::exact}) {
    const DigitalLoop loop = forced_loop(hold);
    LaneExcitation<double> lanes([&](std::size_t) -> const DigitalLoop& { return loop; });
    ForceOverSamples alone(loop.force, hold, loop.sampling.period);
    EXPECT_EQ(lanes.lines(), 2U);
    EXPECT_EQ(lanes.is_held(0), hold == ForceHold::sampled);
    std::vector<LanePhasor<double>> phasors(lanes.lines());
    const std::vector<double> instants{0.0, 0.0007, 0.003};
    lanes.fix_instants(instants);
    std::vector<LanePhasor<double>> fixed(lanes.lines());
    for (std::int64_t j = 0; j < 40; ++j) {
      lanes.begin_sample(j);
      alone.begin_sample(j, static_cast<double>(j) * loop.sampling.period);
      for (std::size_t k = 0; k < instants.size(); ++k) {
        lanes.turned(instants[k], phasors);
        EXPECT_NEAR(force_of(phasors), alone.at(instants[k]), 1e-14);
        EXPECT_EQ(lanes.force_at(k), force_of(phasors));
        lanes.turned_to(k, fixed);
        for (std::size_t l = 0; l < fixed.size(); ++l) {
          EXPECT_EQ(fixed[l].angular_frequency, phasors[l].angular_frequency);
          EXPECT_EQ(fixed[l].phase.cosine, phasors[l].phase.cosine);
          EXPECT_EQ(fixed[l].phase.sine, phasors[l].phase.sine);
        }
      }
    }
  }
}

TEST(LaneExcitation, WithoutHarmonicsThereIsNone) {
  DigitalLoop loop = forced_loop(ForceHold::exact);
  loop.force.harmonics.clear();
  LaneExcitation<double> lanes([&](std::size_t) -> const DigitalLoop& { return loop; });
  std::vector<LanePhasor<double>> phasors(lanes.lines());
  lanes.begin_sample(0);
  lanes.turned(0.001, phasors);
  EXPECT_EQ(force_of(phasors), 0.0);
}

TEST(TwoMassSeries, IsThatOfTaylorStep) {
  test::Random random(31);
  for (int trial = 0; trial < 500; ++trial) {
    const TwoMass<double> plant = test::random_plant(random);
    const AffineDynamics dynamics = engaged_dynamics(plant);
    const double rate = balanced_norm(dynamics.state), length = random.unit() / rate;
    const Vector<double, 4> z = random.matrix<Vector<double, 4>>();
    const double command = random.uniform(-1.0, 1.0), omega = rate * random.unit();
    const double cosine = random.uniform(-1.0, 1.0), sine = random.uniform(-1.0, 1.0);

    const auto terms = LaneTerms<double>()(rate * length);
    EXPECT_LE(std::abs(terms.most - terms_for(rate * length)), 1);
    const auto row = [&](Eigen::Index i) {
      return LaneAcceleration<double>{
          {dynamics.state(i, 0), dynamics.state(i, 1), dynamics.state(i, 2), dynamics.state(i, 3)},
          dynamics.command[i] * command,
          dynamics.force[i]};
    };
    const TwoMassSeries<double> series({row(1), row(3)}, {z[0], z[1], z[2], z[3]},
                                       {{omega, {cosine, sine}}}, length, terms);
    Series force(terms.most);
    std::complex<double> turning(cosine, sine);
    double factorial = 1.0;
    for (Eigen::Index k = 0; k < force.size(); ++k) {
      force[k] = turning.real() / factorial;
      turning *= std::complex<double>(0.0, omega * length);
      factorial *= static_cast<double>(k + 1);
      EXPECT_NEAR(series.force[static_cast<std::size_t>(k)], force[k], 1e-15);
    }
    const TaylorStep<4> step(dynamics, z, command, force, length);
    for (const double x : {0.0, 0.3, 1.0}) {
      const std::array<double, 4> there = series.state_at(x);
      for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(there[i], series.value(series.state[i], x));
        const double size = step.coefficients().row(static_cast<Eigen::Index>(i)).cwiseAbs().sum();
        EXPECT_NEAR(series.value(series.state[i], x), step.state(x)[static_cast<Eigen::Index>(i)],
                    1e-14 * size);
      }
    }
  }
}

TEST(TwoMassSeries, HasAsManyTermsAsItsLengthAsksFor) {
  const LaneTerms<double> terms;
  EXPECT_EQ(terms(0.0).most, 1);
  EXPECT_EQ(terms(1.0).most, most_terms);
  EXPECT_EQ(terms(std::numeric_limits<double>::quiet_NaN()).most, 1);
  for (double turns = 1e-6; turns < 1.0; turns *= 1.003)
    EXPECT_EQ(terms(turns).most, terms_for(turns)) << turns;
}

}  // namespace
}  // namespace holdfast
