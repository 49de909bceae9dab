#include "holdfast/motion/ideal_loop.hpp"

#include "holdfast/motion/implemented_loop.hpp"
#include "support/kollar_case.hpp"
#include "support/random.hpp"

namespace holdfast {
namespace {

const Vector<double, 4> some_state(0.003, -0.05, 0.001, 0.2);

TEST(IdealLoop, ThePeriodicMotionIsTheHarmonicOne) {
  for (const double period : {0.001, 0.01}) {
    for (const ForceHold hold : {ForceHold::sampled, ForceHold::exact}) {
      IdealLoop<double> loop = test::kollar_loop(period, 0.002, 0.25);
      loop.hold = hold;
      const Rational ratio = forcing_ratio(loop).value();
      auto periodic = periodically_forced_motion(loop, ratio, some_state);
      auto harmonic = harmonically_forced_motion(loop, some_state);
      int inside = 0;
      for (int j = 0; j < 2000; ++j) {
        ASSERT_LE((periodic.state() - harmonic.state()).norm(), 1e-11) << j;
        const auto sample = periodic.sense();
        ASSERT_EQ(sample.engaged, harmonic.sense().engaged) << j;
        inside += sample.engaged ? 0 : 1;
        periodic.advance();
        harmonic.advance();
      }
      EXPECT_GT(inside, 20);
      EXPECT_LT(inside, 1980);
    }
  }
}

TEST(IdealLoop, TheHarmonicMotionIsTheOneOfItsParts) {
  test::KollarCase which;
  which.initial_state = some_state;
  auto parts = which.motion();
  auto whole = harmonically_forced_motion(which.ideal_loop(), some_state);
  for (int j = 0; j < 3000; ++j) {
    ASSERT_EQ(parts.sense().control_force, whole.sense().control_force);
    parts.advance();
    whole.advance();
    ASSERT_EQ(parts.state(), whole.state());
  }
}

TEST(MotionMemory, AMotionGoesOnFromItToTheLastBit) {
  const IdealLoop<double> loop = test::kollar_loop(0.01, 0.002, 0.4);
  const Rational ratio = forcing_ratio(loop).value();
  ASSERT_EQ(ratio.denominator, 10);
  auto motion = periodically_forced_motion(loop, ratio, some_state);
  int stored_inside = 0;
  for (int common_period = 0; common_period < 50; ++common_period) {
    const auto memory = motion.memory();
    stored_inside += memory.backlash.inside ? 1 : 0;
    auto other = periodically_forced_motion(loop, ratio, Vector<double, 4>::Ones().eval());
    other.restore(memory);
    auto here = motion;
    for (int j = 0; j < 200; ++j) {
      const auto expected = here.sense(), found = other.sense();
      ASSERT_EQ(expected.engaged, found.engaged);
      ASSERT_EQ(expected.control_force, found.control_force);
      here.advance();
      other.advance();
      ASSERT_EQ(here.state(), other.state());
      ASSERT_EQ(here.law().lower(), other.law().lower());
    }
    for (int j = 0; j < 10; ++j) motion.sense(), motion.advance();
  }
  EXPECT_GT(stored_inside, 0) << "and not only outside";
  EXPECT_LT(stored_inside, 50);
}

TEST(ForcingRatio, IsWhatTheDecimalsMean) {
  IdealLoop<double> loop = test::kollar_loop(0.011, 0.002, 0.0);
  const Rational ratio = forcing_ratio(loop).value();
  EXPECT_EQ(ratio.numerator, 11);
  EXPECT_EQ(ratio.denominator, 100);
  loop.excitation.frequency = 10.0 * std::sqrt(0.5);
  EXPECT_FALSE(forcing_ratio(loop));
  loop.excitation.frequency = 1e300;
  EXPECT_FALSE(forcing_ratio(loop));
  loop.excitation.amplitude = 0.0;
  EXPECT_EQ(forcing_ratio(loop).value().numerator, 0);
  EXPECT_EQ(forcing_ratio(loop).value().denominator, 1);
}

TEST(IdealLoop, IsFoundAgainInTheLoopThatIsBuilt) {
  const IdealLoop<double> loop = test::kollar_loop(0.003, 0.002, 0.0005);
  const auto found = ideal_loop(implemented_loop(loop));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->sampling.period, loop.sampling.period);
  EXPECT_EQ(found->gains.differential, loop.gains.differential);
  EXPECT_EQ(found->excitation.amplitude, loop.excitation.amplitude);
  EXPECT_EQ(found->excitation.frequency, loop.excitation.frequency);
  EXPECT_EQ(found->backlash_width, loop.backlash_width);
  EXPECT_EQ(found->hold, loop.hold);
}

TEST(IdealLoop, SaysNothingOfWhatThePaperDoesNotHave) {
  const ImplementedLoop plain = implemented_loop(test::kollar_loop(0.003, 0.002, 0.0005));
  ImplementedLoop loop = plain;
  loop.switching = Switching::exact;
  EXPECT_FALSE(ideal_loop(loop));
  loop = plain;
  loop.digital.jitter.half_width = 1e-6;
  EXPECT_FALSE(ideal_loop(loop));
  loop = plain;
  loop.digital.limits.largest_force = 1.0;
  EXPECT_FALSE(ideal_loop(loop));
  loop = plain;
  loop.digital.force.harmonics.front().phase = 0.1;
  EXPECT_FALSE(ideal_loop(loop));
  loop = plain;
  loop.digital.force.harmonics.push_back({0.1, 3.0});
  EXPECT_FALSE(ideal_loop(loop));
  loop = plain;
  for (const ContactLaw law : {ContactLaw::immediate, ContactLaw::play, ContactLaw::dead_zone}) {
    loop.backlash.law = law;
    EXPECT_FALSE(ideal_loop(loop));
  }
  loop.backlash.law = ContactLaw::none;
  ASSERT_TRUE(ideal_loop(loop));
  EXPECT_EQ(ideal_loop(loop)->backlash_width, 0.0);
}

TEST(IdealLoop, ConvertedThereAndBackIsTheSame) {
  IdealLoop<double> loop = test::kollar_loop(0.003, 0.002, 0.3);
  loop.hold = ForceHold::exact;
  const auto back = converted<double>(converted<long double>(loop));
  EXPECT_EQ(back.plant.state_matrix(), loop.plant.state_matrix());
  EXPECT_EQ(back.plant.control_input(), loop.plant.control_input());
  EXPECT_EQ(back.sampling.period, loop.sampling.period);
  EXPECT_EQ(back.sampling.processing_delay, loop.sampling.processing_delay);
  EXPECT_EQ(back.gains.feedback_row(), loop.gains.feedback_row());
  EXPECT_EQ(back.excitation.amplitude, loop.excitation.amplitude);
  EXPECT_EQ(back.excitation.frequency, loop.excitation.frequency);
  EXPECT_EQ(back.backlash_width, loop.backlash_width);
  EXPECT_EQ(back.hold, loop.hold);
}

TEST(IdealLoop, NoMotionBeginsInOneThatIsNotAdmissible) {
  const IdealLoop<double> good = test::KollarCase().ideal_loop();
  const Vector<double, 4> rest = Vector<double, 4>::Zero();
  const auto refuses = [](const IdealLoop<double>& loop, const Vector<double, 4>& state) {
    EXPECT_THROW(harmonically_forced_motion(loop, state), InvalidParameter);
    EXPECT_THROW(periodically_forced_motion(loop, Rational{1, 100}, state), InvalidParameter);
    const auto extended = converted<long double>(loop);
    const Vector<long double, 4> extended_state = state.cast<long double>();
    EXPECT_THROW(harmonically_forced_motion(extended, extended_state), InvalidParameter);
  };
  const auto refused = [&](auto&& spoil) {
    IdealLoop<double> spoiled = good;
    spoil(spoiled);
    EXPECT_THROW(validate(spoiled), InvalidParameter);
    refuses(spoiled, rest);
  };
  EXPECT_NO_THROW(harmonically_forced_motion(good, rest));
  refused([](auto& bad) { bad.plant.absorber_mass = 0.0; });
  refused([](auto& bad) { bad.sampling.processing_delay = 2.0 * bad.sampling.period; });
  refused([](auto& bad) { bad.gains.differential = std::numeric_limits<double>::infinity(); });
  refused([](auto& bad) { bad.excitation.frequency = 0.0; });
  refused([](auto& bad) { bad.backlash_width = -1e-9; });
  refuses(good, Vector<double, 4>(0.0, std::numeric_limits<double>::infinity(), 0.0, 0.0));
}

}  // namespace
}  // namespace holdfast
