#include "support/switching_reference.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "support/sample_excitation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "holdfast/motion/trajectory.hpp"
#include "support/kollar_case.hpp"
#include "support/random.hpp"
#include "support/random_loop.hpp"

namespace holdfast::cvode {
namespace {

using SwitchedState = Vector<double, 4>;

const Tolerances reference_tolerances{1e-12, 1e-15};
const SwitchedState switched_rest = SwitchedState::Zero();

/// 0.5 N at 10 Hz, P = −557 N/m, D = −13 N s/m, the force not held.
IdealLoop<double> switched_loop(double period, double width, double delay_fraction = 0.0) {
  test::KollarCase which;
  which.sampling_period = period;
  which.width = width;
  which.processing_delay = delay_fraction * period;
  IdealLoop<double> loop = which.ideal_loop();
  loop.hold = ForceHold::exact;
  return loop;
}

SwitchingReference followed(const IdealLoop<double>& loop, double duration,
                            const SwitchedState& initial_state = switched_rest,
                            const Tolerances& tolerances = reference_tolerances) {
  const std::int64_t samples = samples_within(duration, loop.sampling.period);
  SwitchingReference result = switching_reference(loop, initial_state, samples, tolerances);
  EXPECT_EQ(result.outcome, IntegrationOutcome::completed) << result.words;
  EXPECT_EQ(result.states.size(), static_cast<std::size_t>(samples));
  return result;
}

/// How often each mode begins: engaged, gap, stick.
std::array<int, 3> phases_of(const SwitchingReference& found) {
  std::array<int, 3> count{};
  for (const ContactSwitch& each : found.switches) ++count[static_cast<std::size_t>(each.mode)];
  return count;
}

/// The mode throughout (from, to) and a little beyond both; nothing where there is a switch.
std::optional<ContactMode> mode_throughout(const SwitchingReference& found, double from,
                                           double to) {
  ContactMode mode = ContactMode::engaged;
  for (const ContactSwitch& each : found.switches) {
    if (each.time > to + 1e-9) return mode;
    if (each.time >= from - 1e-9) return std::nullopt;
    mode = each.mode;
  }
  return mode;
}

double states_apart(const std::vector<SwitchedState>& a, const std::vector<SwitchedState>& b) {
  EXPECT_EQ(a.size(), b.size());
  double apart = 0.0;
  for (std::size_t j = 0; j < std::min(a.size(), b.size()); ++j)
    apart = std::fmax(apart, (a[j] - b[j]).cwiseAbs().maxCoeff());
  return apart;
}

TEST(SwitchingReference, WithoutBacklashItIsTheSampledMotion) {
  const SwitchedState thrown(0.003, -0.05, 0.001, 0.2);
  for (const double period : {0.001, 0.01})
    for (const double delay_fraction : {0.0, 0.25, 1.0})
      for (const ForceHold hold : {ForceHold::exact, ForceHold::sampled})
        for (const SwitchedState& start : {switched_rest, thrown}) {
          IdealLoop<double> loop = switched_loop(period, 0.0, delay_fraction);
          loop.gains = {-100.0, -3.0};  // stable with every one of these delays
          loop.hold = hold;
          const SwitchingReference found = followed(loop, 2.0, start);
          EXPECT_TRUE(found.switches.empty());
          auto motion = harmonically_forced_motion(loop, start);
          for (const SwitchedState& state : found.states) {
            ASSERT_LT((state - motion.state()).cwiseAbs().maxCoeff(), 1e-9) << motion.time();
            motion.sense();
            motion.advance();
          }
        }
}

/// Largest |z₁| (mm) at the samples of the second half.
double settled_amplitude(const SwitchingReference& found) {
  double largest = 0.0;
  for (std::size_t j = found.states.size() / 2; j < found.states.size(); ++j)
    largest = std::fmax(largest, std::abs(found.states[j][0]));
  return 1e3 * largest;
}

TEST(SwitchingReference, ThePrototypesAmplitudesComeOutToTheDigitsShown) {
  const Tolerances coarser{1e-10, 1e-13};
  struct Case {
    double period, width, duration, amplitude;
  };
  for (const Case& each : {Case{0.001, 0.0005, 3.0, 0.6963},
                           {0.001, 0.002, 3.0, 1.0029},
                           {0.005, 0.001, 3.0, 0.7332},
                           {0.011, 0.002, 3.003, 1.0089}}) {
    const auto found =
        followed(switched_loop(each.period, each.width), each.duration, switched_rest, coarser);
    EXPECT_NEAR(settled_amplitude(found), each.amplitude, 0.00005) << each.period << each.width;
  }
}

TEST(SwitchingReference, EachHalfCycleHasOneStickOneGapAndOneEngagedPhase) {
  const auto phases = phases_of(followed(switched_loop(0.001, 0.0005), 3.0));
  for (const int count : phases) EXPECT_NEAR(count, 60, 2);
}

TEST(SwitchingReference, WhileItSticksTheMassesMoveAsOneAndTheForceLiesBetweenZeroAndTheCommand) {
  const auto loop = switched_loop(0.001, 0.0005);
  const auto found = followed(loop, 3.0);
  const Matrix<double, 4> a = loop.plant.state_matrix();
  const SwitchedState b = loop.plant.control_input(), c = loop.plant.excitation_input();
  int stuck = 0;
  double least = 1.0, largest = 0.0;
  for (std::size_t j = 0; j < found.states.size(); ++j) {
    const double time = static_cast<double>(j) * loop.sampling.period;
    if (mode_throughout(found, time, time + loop.sampling.period) != ContactMode::stick) continue;
    const SwitchedState& z = found.states[j];
    const SwitchedState& next = found.states[j + 1];
    ASSERT_LT(std::abs(relative_velocity(z)), 1e-10) << time;
    ASSERT_NEAR(relative_displacement(next), relative_displacement(z), 1e-15) << time;
    const double excitation =
        sample_excitation(loop.excitation, loop.sampling.period, static_cast<std::int64_t>(j))
            .cosine;
    const SwitchedState without_drive = a * z + c * excitation;
    const double transmitted = -relative_velocity(without_drive) / relative_velocity(b);
    const double command = loop.gains.feedback_row() * z;
    least = std::fmin(least, transmitted / command);
    largest = std::fmax(largest, transmitted / command);
    ++stuck;
  }
  EXPECT_GT(stuck, 300);
  EXPECT_GT(least, 0.0);
  EXPECT_LT(largest, 1.0);
  EXPECT_LT(least, 0.5) << "the bounds were never approached";
  EXPECT_GT(largest, 0.5) << "the bounds were never approached";
}

/// A loop that is stable without backlash, with a gap and a start of the size of its motion.
struct SwitchedCase {
  IdealLoop<double> loop;
  SwitchedState initial_state;
  double duration;
};

SwitchedCase random_switched_case(test::Random& random) {
  const TwoMass<double> plant = test::random_plant(random);
  Sampling<double> sampling{};
  PdGains<double> gains{};
  do {
    sampling = test::random_sampling(plant, random);
    gains = test::random_gains(plant, sampling.period, random);
  } while (test::growth(plant, sampling, gains).excess > -1e-4);
  const HarmonicExcitation<double> excitation{random.log_uniform(0.05, 5.0),
                                              random.log_uniform(0.5, 30.0)};
  const double size = excitation.amplitude / plant.conductor_stiffness;
  const double width = size * random.log_uniform(1e-2, 3.0);
  const ForceHold hold = random.unit() < 0.7 ? ForceHold::exact : ForceHold::sampled;
  const SwitchedState start =
      random.unit() < 0.5 ? switched_rest : SwitchedState(random.matrix<SwitchedState>() * size);
  return {{plant, sampling, gains, excitation, width, hold},
          start,
          std::min(1.0, 500 * sampling.period)};
}

TEST(SwitchingReference, TheModesFollowEachOtherAdmissibly) {
  test::Random random(701);
  int switches = 0, sticks = 0;
  for (int k = 0; k < 100; ++k) {
    const SwitchedCase which = random_switched_case(random);
    const auto found = followed(which.loop, which.duration, which.initial_state);
    ContactSwitch last{0.0, ContactMode::engaged};
    for (const ContactSwitch& each : found.switches) {
      ASSERT_GE(each.time, last.time) << k;
      ASSERT_NE(each.mode, last.mode) << k;
      ASSERT_FALSE(last.mode == ContactMode::gap && each.mode == ContactMode::stick) << k;
      last = each;
    }
    switches += static_cast<int>(found.switches.size());
    sticks += phases_of(found)[2];
  }
  EXPECT_GT(switches, 1000);
  EXPECT_GT(sticks, 100);
}

/// The paper's rule at n instants per sampling period, the command held as ever: its states at the
/// samples.
std::vector<SwitchedState> finely_sampled(const IdealLoop<double>& loop, double duration, int n) {
  const double step = loop.sampling.period / n;
  const SampledLoop<double> fine = sampled_loop(loop.plant, Sampling<double>{step});
  const HarmonicInput<double> input =
      harmonic_input(loop.plant, fine, ForceHold::exact, loop.excitation.angular_frequency());
  double held_excitation = 0.0;
  HarmonicForcing<double> forcing(input, loop.excitation, step);
  Backlash<double> law(loop.backlash_width);
  const auto delayed = std::lround(loop.sampling.processing_delay / step);
  SwitchedState state = switched_rest;
  double held = 0.0, next = 0.0;
  std::vector<SwitchedState> states;
  const auto instants = n * (samples_within(duration, loop.sampling.period) - 1);
  for (std::int64_t i = 0; i <= instants; ++i) {
    if (i % n == 0) {
      states.push_back(state);
      held = next;
      next = loop.gains.feedback_row() * state;
      held_excitation = sample_excitation(loop.excitation, loop.sampling.period, i / n).cosine;
    }
    const bool engaged = law.step(relative_displacement(state), relative_velocity(state));
    const double force = engaged ? (i % n >= delayed ? next : held) : 0.0;
    const SwitchedState excited = forcing.next();
    state = fine.transition * state + fine.present_force * force;
    state += loop.hold == ForceHold::exact ? excited
                                           : SwitchedState(fine.held_excitation * held_excitation);
  }
  return states;
}

TEST(SwitchingReference, ThePapersRuleSwitchedEverMoreFinelyConvergesToItAtFirstOrder) {
  struct Case {
    double period, width, delay_fraction;
    ForceHold hold;
  };
  for (const Case& each : {Case{0.001, 0.0005, 0.0, ForceHold::exact},
                           {0.005, 0.001, 0.0, ForceHold::exact},
                           {0.005, 0.001, 0.25, ForceHold::exact},
                           {0.005, 0.001, 0.0, ForceHold::sampled},
                           {0.011, 0.0005, 0.0, ForceHold::sampled}}) {
    auto loop = switched_loop(each.period, each.width, each.delay_fraction);
    loop.hold = each.hold;
    const auto exact = followed(loop, 0.5);
    EXPECT_GT(phases_of(exact)[2], 5);
    const int coarse = static_cast<int>(std::lround(each.period / 1e-5));
    const double apart = states_apart(finely_sampled(loop, 0.5, coarse), exact.states);
    const double finer = states_apart(finely_sampled(loop, 0.5, 16 * coarse), exact.states);
    EXPECT_LT(finer, 1e-4);
    EXPECT_NEAR(std::log(apart / finer) / std::log(16.0), 1.0, 0.25)
        << each.period << ": " << apart << ", " << finer;
  }
}

TEST(SwitchingReference, OneTolerancesMotionIsTheOthers) {
  for (const double period : {0.001, 0.011}) {
    const auto loop = switched_loop(period, 0.002);
    const auto found = followed(loop, 10.0);
    const auto finer = followed(loop, 10.0, switched_rest, {1e-13, 1e-16});
    EXPECT_LT(states_apart(found.states, finer.states), 1e-9);
    ASSERT_EQ(found.switches.size(), finer.switches.size());
    for (std::size_t i = 0; i < found.switches.size(); ++i) {
      EXPECT_EQ(found.switches[i].mode, finer.switches[i].mode);
      EXPECT_NEAR(found.switches[i].time, finer.switches[i].time, 1e-9);
    }
  }
}

TEST(SwitchingReference, TwiceTheForceAndTheGapAreTwiceTheMotionAtTheSameInstants) {
  const auto loop = switched_loop(0.005, 0.001, 0.25);
  auto twice = loop;
  twice.excitation.amplitude *= 2.0;
  twice.backlash_width *= 2.0;
  const auto one = followed(loop, 2.0);
  auto two = followed(twice, 2.0, switched_rest, {1e-12, 2e-15});
  for (SwitchedState& state : two.states) state /= 2.0;
  EXPECT_LT(states_apart(one.states, two.states), 1e-12);
  ASSERT_EQ(one.switches.size(), two.switches.size());
  for (std::size_t i = 0; i < one.switches.size(); ++i)
    EXPECT_NEAR(one.switches[i].time, two.switches[i].time, 1e-12);
}

TEST(SwitchingReference, AMirroredFreeMotionIsMirrored) {
  auto loop = switched_loop(0.005, 0.0001);
  loop.excitation.amplitude = 0.0;
  const SwitchedState start(0.003, -0.05, 0.001, 0.2);
  const auto found = followed(loop, 1.0, start);
  auto mirror = followed(loop, 1.0, -start);
  for (SwitchedState& state : mirror.states) state = -state;
  EXPECT_GT(found.switches.size(), 5U);
  EXPECT_LT(states_apart(found.states, mirror.states), 1e-12);
  ASSERT_EQ(found.switches.size(), mirror.switches.size());
  for (std::size_t i = 0; i < found.switches.size(); ++i)
    EXPECT_EQ(found.switches[i].mode, mirror.switches[i].mode);
}

TEST(SwitchingReference, WithoutExcitationRestStaysRest) {
  auto loop = switched_loop(0.005, 0.0005);
  loop.excitation.amplitude = 0.0;
  const auto found = followed(loop, 1.0);
  EXPECT_TRUE(found.switches.empty());
  for (const SwitchedState& state : found.states) EXPECT_EQ(state, switched_rest);
}

TEST(SwitchingReference, ADriveWithoutCommandNeverSticksAndDoesNotChangeTheMotion) {
  auto loop = switched_loop(0.02, 0.001);
  loop.gains = {0.0, 0.0};
  const auto found = followed(loop, 3.0);
  EXPECT_GT(phases_of(found)[1], 30);
  EXPECT_EQ(phases_of(found)[2], 0);
  auto motion = harmonically_forced_motion(loop, switched_rest);
  for (const SwitchedState& state : found.states) {
    ASSERT_LT((state - motion.state()).cwiseAbs().maxCoeff(), 1e-9) << motion.time();
    motion.sense();
    motion.advance();
  }
}

/// The last parameter on the way from `holds` to `fails` at which the condition holds.
template <class Condition>
double last_that_holds(const Condition& condition, double holds, double fails) {
  EXPECT_TRUE(condition(holds));
  EXPECT_FALSE(condition(fails));
  for (int k = 0; k < 45; ++k) {
    const double middle = 0.5 * (holds + fails);
    (condition(middle) ? holds : fails) = middle;
  }
  return holds;
}

TEST(SwitchingReference, ADriveThatLeavesItsGapJustBeforeItTurnsIsNotMissed) {
  // Without a command the motion is the same with every gap. The one whose far end lies just before
  // the second reversal is left for an instant much shorter than CVODE's steps.
  const auto switches_with = [](double width) {
    auto loop = switched_loop(0.5, width);
    loop.gains = {0.0, 0.0};
    return followed(loop, 0.5).switches;
  };
  const double turn = switches_with(1e-5).at(2).time;
  const double width = last_that_holds(
      [&](double each) {
        const auto switches = switches_with(each);
        return switches.size() > 1 && switches[1].time <= turn;
      },
      1e-5, 0.1);
  EXPECT_NEAR(switches_with(width).at(1).time, turn, 1e-6);
}

/// Half a second under the one command that z₁ = 1 mm gives.
std::vector<ContactSwitch> under_one_command(double gain, double frequency, double initial_velocity,
                                             double relative_tolerance = 1e-12) {
  auto loop = switched_loop(0.5, 0.0005);
  loop.gains = {gain, 0.0};
  loop.excitation.frequency = frequency;
  const SwitchedState start(0.001, 0.0, 0.001, initial_velocity);
  return followed(loop, 0.5, start, {relative_tolerance, 1e-15}).switches;
}

TEST(SwitchingReference, ADriveThatStopsStickingForAnInstantIsNotMissed) {
  // Under a larger command it sticks through an extremum of σ a(u), under a smaller one it is
  // engaged around it.
  const auto with = [](double gain) { return under_one_command(gain, 10.0, 0.0); };
  const auto lets_go = [&with](double gain) { return with(gain).at(3).time < 0.4; };
  const auto switches = with(last_that_holds(lets_go, 1350.0, 1500.0));
  EXPECT_EQ(switches.at(2).mode, ContactMode::stick);
  EXPECT_EQ(switches.at(3).mode, ContactMode::engaged);
  EXPECT_EQ(switches.at(4).mode, ContactMode::stick);
  EXPECT_LT(switches[4].time - switches[3].time, 1e-5);
}

TEST(SwitchingReference, ADriveThatReversesForAnInstantIsNotMissed) {
  // Under a larger command v has its first minimum above zero, under a smaller one it reaches zero
  // there. CVODE's steps are of other lengths at another tolerance.
  const auto last_reversing_gain = [](double relative_tolerance) {
    const auto reverses = [relative_tolerance](double gain) {
      return under_one_command(gain, 20.0, 0.1, relative_tolerance).at(0).time < 0.08;
    };
    return last_that_holds(reverses, -400.0, -500.0);
  };
  EXPECT_NEAR(last_reversing_gain(1e-9), last_reversing_gain(1e-12), 1e-4);
}

TEST(SwitchingReference, CVodesFailureIsAnOutcome) {
  testing::internal::CaptureStderr();
  const auto loop = switched_loop(0.005, 0.001);
  const auto found = switching_reference(loop, switched_rest, 100, {1e-12, 1e-15, 5});
  EXPECT_EQ(found.outcome, IntegrationOutcome::too_much_work);
  EXPECT_NE(found.words.find("CV_TOO_MUCH_WORK"), std::string::npos) << found.words;
  EXPECT_EQ(found.states.size(), 1U);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(SwitchingReference, BadInputIsRefused) {
  const auto loop = switched_loop(0.005, 0.001);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Tolerances& fine = reference_tolerances;
  EXPECT_THROW(switching_reference(loop, switched_rest, 0, fine), InvalidParameter);
  EXPECT_THROW(switching_reference(loop, switched_rest, 10, {0.0, 1e-15}), InvalidParameter);
  EXPECT_THROW(switching_reference(loop, SwitchedState(0, 0, nan, 0), 10, fine), InvalidParameter);
  auto wrong = loop;
  wrong.backlash_width = -1.0;
  EXPECT_THROW(switching_reference(wrong, switched_rest, 10, fine), InvalidParameter);
}

}  // namespace
}  // namespace holdfast::cvode
