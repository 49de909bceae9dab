#include "output/trusted_digits.hpp"

#include "case/case_file.hpp"
#include "case/model/moving_loop.hpp"
#include "holdfast/math/stats/trusted_digits.hpp"
#include "jobs/motion/motion_digits.hpp"
#include "output/metadata.hpp"
#include "support/testing.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

Case case_of(const std::vector<std::string>& settings) { return load_case(std::nullopt, settings); }

TrustedDigits digits_of(const Case& the_case, Switching switching, int samples, double from) {
  return trusted_digits_of_motion(moving_loop_of(the_case, {switching}),
                                  built_loop_of(the_case, {switching}), samples, from);
}

/// D beyond the stable ones, bounded by the backlash: irregular.
Case irregular_case() {
  return case_of({"control.sampling_period=0.01", "control.differential_gain=-20.0",
                  "excitation.frequency=6.0"});
}

class TrustedDigitsOf : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!long_double_is_wider) GTEST_SKIP() << "long double is no wider than double here";
  }
};

TEST_F(TrustedDigitsOf, ARegularMotionAreNotWorthTelling) {
  const auto trusted = digits_of(case_of({}), Switching::sampled, 10001, 0.0);
  EXPECT_GE(trusted.digits, digits_taken_for_granted);
  EXPECT_FALSE(is_worth_telling(trusted));
  EXPECT_FALSE(trusted.until);
  EXPECT_EQ(trust_warning(trusted), "");
}

TEST_F(TrustedDigitsOf, AnIrregularMotionFallToNoneFromAnInstantOn) {
  const Case the_case = irregular_case();
  const auto whole = digits_of(the_case, Switching::sampled, 6001, 0.0);
  EXPECT_EQ(whole.digits, 0);
  ASSERT_TRUE(whole.until);
  EXPECT_GT(*whole.until, 0.0);
  EXPECT_LT(*whole.until, 60.0);
  EXPECT_NE(trust_warning(whole).find(format_number(*whole.until) + " s"), std::string::npos);

  const auto beginning = static_cast<int>(*whole.until / 0.01);
  EXPECT_FALSE(is_worth_telling(digits_of(the_case, Switching::sampled, beginning, 0.0)))
      << "up to that instant there are six";
  EXPECT_EQ(digits_of(the_case, Switching::sampled, 6001, 30.0).digits, 0)
      << "and later ones are not redeemed by leaving the beginning out";
}

TEST_F(TrustedDigitsOf, AMotionBelongToTheSamplesThatAreShown) {
  // The digits of a motion that has lost them before its rows begin and those of its beginning.
  const Case the_case = irregular_case();
  MotionDigits late(ideal_loop_of(the_case), initial_state_of(the_case), std::nullopt, 1e6);
  auto motion = motion_of(sampled_masses_of(the_case));
  run_trajectory(motion, 6001, std::nullopt, late);
  EXPECT_FALSE(is_worth_telling(late.result())) << "no row, nothing to distrust";
}

TEST_F(TrustedDigitsOf, AKickedMotionAreThoseOfTheSameKick) {
  const Case the_case = case_of({});
  const Kick kick{1.0, 1e-3};
  MotionDigits digits(ideal_loop_of(the_case), initial_state_of(the_case), kick);
  auto motion = motion_of(sampled_masses_of(the_case));
  run_trajectory(motion, 3001, kick, digits);
  EXPECT_GE(digits.result().digits, digits_taken_for_granted);

  MotionDigits without(ideal_loop_of(the_case), initial_state_of(the_case));
  auto again = motion_of(sampled_masses_of(the_case));
  run_trajectory(again, 3001, kick, without);
  EXPECT_EQ(without.result().digits, 0) << "another motion is told from it";
}

TEST(TrustedDigitsByRounding, OfRegularMotionsAreNotWorthTelling) {
  // With exact switching the play holds the irregular motion too: it is periodic.
  EXPECT_FALSE(is_worth_telling(digits_of(irregular_case(), Switching::exact, 6001, 0.0)));
  for (const char* setting :
       {"backlash.law=play", "backlash.law=immediate", "control.velocity_quantum=0.001",
        "control.jitter=0.0001", "excitation.noise_rms=0.2", "control.largest_force=0.5"}) {
    const auto trusted = digits_of(case_of({setting}), Switching::sampled, 20001, 0.0);
    EXPECT_FALSE(is_worth_telling(trusted)) << setting << ' ' << trusted.digits;
    EXPECT_TRUE(trusted.by_rounding) << setting;
  }
}

TEST(TrustedDigitsByRounding, AreLostWhereNeighboursPart) {
  // A force of 10 N, never reached, makes the paper's model another one and changes no motion.
  for (const bool limited : {false, true}) {
    Case the_case = irregular_case();
    if (limited) the_case.control.largest_force = 10.0;
    if (!limited && !long_double_is_wider) continue;
    const auto trusted = digits_of(the_case, Switching::sampled, 6001, 0.0);
    EXPECT_EQ(trusted.by_rounding, limited);
    EXPECT_EQ(trusted.digits, 0);
    ASSERT_TRUE(trusted.until);
    EXPECT_GT(*trusted.until, 5.0);
    EXPECT_LT(*trusted.until, 20.0);
    const std::string warning = trust_warning(trusted);
    EXPECT_EQ(warning.find("other rounding errors") != std::string::npos, limited) << warning;
  }
}

TEST_F(TrustedDigitsOf, ADeviationAreLostWhereItIsDownToRounding) {
  const MovingLoop moving = moving_loop_of(case_of({}), {});
  EXPECT_FALSE(is_worth_telling(trusted_digits_of_deviation(moving, 1e-5, 1001)));
  const auto died = trusted_digits_of_deviation(moving, 1e-5, 100001);
  EXPECT_TRUE(is_worth_telling(died));
  ASSERT_TRUE(died.until);
  EXPECT_GT(*died.until, 1.0);
  EXPECT_FALSE(is_worth_telling(trusted_digits_of_deviation(moving, 0.0, 1001)))
      << "no deviation at all is exact";
}

TEST_F(TrustedDigitsOf, AReductionAreThoseOfItsDiscriminantNearTheDoubleRoot) {
  FrequencyReduction<double> asked{50.3, 0.16, 1.999, 6.998};
  EXPECT_FALSE(is_worth_telling(trusted_digits_of_reduction(asked)));
  asked.absorber_mass = largest_absorber_mass(asked) * (1.0 - 1e-13);
  const auto near = trusted_digits_of_reduction(asked);
  EXPECT_TRUE(is_worth_telling(near));
  EXPECT_EQ(near.least, "discriminant");
  EXPECT_FALSE(near.until);
  EXPECT_EQ(trust_warning(near).find("discriminant has fewer than six digits"), 0U);
}

TEST(MetadataOfDigits, AreSilentWhereThereAreSix) {
  JobContext context;
  context.job = "simulate";
  context.case_data = case_of({});
  const std::string plain = json_text(table_metadata(context, {}, "out.csv"));
  EXPECT_EQ(plain, json_text(table_metadata(context, {}, "out.csv", {6, 1.0, "k"})));
  EXPECT_EQ(plain.find("trusted"), std::string::npos);
}

TEST(MetadataOfDigits, SayHowManyThereAreAndOfWhat) {
  JobContext context;
  context.job = "simulate";
  context.case_data = case_of({});
  const auto motion = table_metadata(context, {}, "out.csv", {0, 7.25, ""})["notes"][0]["holdfast"];
  EXPECT_EQ(motion["trusted_digits"], 0);
  EXPECT_EQ(motion["trusted_until_s"], 7.25);
  EXPECT_FALSE(motion.contains("least_trusted"));
  const auto single =
      table_metadata(context, {}, "out.csv", {3, std::nullopt, "k2"})["notes"][0]["holdfast"];
  EXPECT_EQ(single["trusted_digits"], 3);
  EXPECT_EQ(single["least_trusted"], "k2");
  EXPECT_FALSE(single.contains("trusted_until_s"));
}

}  // namespace
}  // namespace holdfast::program
