#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "cli/program.hpp"

namespace holdfast::tests {
namespace {

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// The number behind a text.
double number_behind(const std::string& text, const std::string& before) {
  const std::size_t at = text.find(before);
  EXPECT_NE(at, std::string::npos) << before << " is not in " << text;
  return at == std::string::npos ? 0.0 : std::strtod(text.c_str() + at + before.size(), nullptr);
}

constexpr std::size_t help = 0, gain = 1, slow = 2, play = 3, motion = 4;

TEST(Answers, AreThoseOfTheJobsThatTheyName) {
  const auto answers = table_of("answers --details");
  ASSERT_EQ(answers.rows(), 5U);
  const auto vibration = table_of(
      "sweep --axis backlash.width=0.0005:0.0005:1 --metric ratio_to_uncontrolled --metric "
      "force_peak --set control.sampling_period=0.001 --duration 20");
  EXPECT_NEAR(number_behind(answers.text(help, "answer"), "Yes: "),
              100.0 * vibration.number(0, "ratio_to_uncontrolled"), 0.06);
  EXPECT_NEAR(number_behind(answers.text(help, "detail"), "for up to "),
              vibration.number(0, "force_peak"), 0.006);
  const auto exact = table_of(
      "sweep --axis backlash.width=0.0005:0.0005:1 --metric ratio_to_uncontrolled --switching "
      "exact --duration 20");
  EXPECT_NEAR(number_behind(answers.text(help, "detail"), "not at samples, leaves "),
              100.0 * exact.number(0, "ratio_to_uncontrolled"), 0.06);
  const double best = -number_behind(answers.text(gain, "answer"), "D = −");
  const auto in_play = table_of("sweep --axis control.differential_gain=" + std::to_string(best) +
                                " --metric ratio_to_uncontrolled --duration 20");
  EXPECT_NEAR(number_behind(answers.text(gain, "detail"), "play of 0.5 mm it leaves "),
              100.0 * in_play.number(0, "ratio_to_uncontrolled"), 0.2);
  const auto delay = table_of("max-delay --frequency 10:10:1");
  EXPECT_NEAR(number_behind(answers.text(slow, "answer"), "Up to "),
              1e3 * delay.number(0, "max_sampling_period_s"), 0.06);
  EXPECT_TRUE(holds(answers.text(play, "answer"), "the case has 0.5 mm"));
  EXPECT_TRUE(holds(answers.text(motion, "answer"), "periodic(100)"));
}

TEST(Answers, AloneAreTwoColumns) {
  const auto lines = lines_of(run_holdfast("answers").output);
  ASSERT_EQ(lines.size(), 6U);
  EXPECT_EQ(lines.front(), "question,answer");
}

TEST(Answers, SayWhichGainsAndWhichPlayAreNotOfTheUsersCase) {
  const TemporaryFolder folder;
  const std::string file = (folder / "mine.toml").string();
  write_text(file, "[plant]\nabsorber_damping = 5\n[control]\nproportional_gain = -500\n");
  const auto answers = table_of("answers --details --case '" + file + "'");
  const std::string detail = answers.text(help, "detail");
  EXPECT_TRUE(holds(detail,
                    "does not give control.differential_gain, control.sampling_period, "
                    "backlash.width: the built-in value stands in"))
      << detail;
  EXPECT_FALSE(holds(table_of("answers --details").text(help, "detail"), "stands in"));
}

TEST(Classification, SaysItInWordsWhereProgressIsShown) {
  const Outcome outcome = run_holdfast("verdict --progress");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_TRUE(holds(outcome.errors, "holdfast: periodic(100), 0.1 s: ")) << outcome.errors;
  EXPECT_EQ(run_holdfast("verdict").errors, "");
}

}  // namespace
}  // namespace holdfast::tests
