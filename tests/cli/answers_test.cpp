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

/// U+2212 as the minus sign of C.
std::string with_hyphens(std::string text) {
  for (std::size_t at = 0; (at = text.find("\u2212", at)) != std::string::npos;)
    text.replace(at, std::strlen("\u2212"), "-");
  return text;
}

/// Whether control helps, of a case that is doubted before.
std::string help_of_doubtful(const std::string& settings) {
  const Outcome outcome = run_holdfast("answers --quiet --set " + settings);
  const auto answers = program::parse_csv(outcome.output, settings);
  EXPECT_EQ(answers.text(0, "question"), "Is the case what you mean?");
  return answers.text(1, "answer");
}

const std::string idle = " --set control.proportional_gain=0 --set control.differential_gain=0";
constexpr std::size_t help = 0, gain = 1, slow = 2, play = 3, motion = 4, cable = 5;

/// The paper's gains are stable on two masses and not on its conductor, unless some of the absorber
/// moves with the clamp.
TEST(Answers, SayWhatDoesNotHoldOnTheConductorItself) {
  const std::string answer = with_hyphens(table_of("answers --quiet").text(cable, "answer"));
  EXPECT_EQ(answer.rfind("No: on the cable the loop is unstable with D = -13 N s/m", 0), 0U)
      << answer;
  const std::string on_cable = " --quiet --set plant.model=cable";
  const auto interval = table_of("boundary --stable-interval --p -557" + on_cable);
  EXPECT_NEAR(number_behind(answer, "stable for D from "), interval.number(0, "lower"), 1e-3);
  EXPECT_NEAR(number_behind(answer, " to "), interval.number(0, "upper"), 1e-3);
  const double clamp = number_behind(answer, "or with this D if ");
  const auto is_stable = [&](double grams) {
    return table_of("stability --p -557:-557:1 --d -13:-13:1" + on_cable +
                    " --set absorber.clamp_mass=" + std::to_string(1e-3 * grams))
               .number(0, "stable") == 1.0;
  };
  EXPECT_TRUE(is_stable(1.03 * clamp)) << clamp;
  EXPECT_FALSE(is_stable(0.96 * clamp)) << clamp;
}

TEST(Answers, AreUndecidedWhereTheModesDecide) {
  const std::string answer =
      table_of("answers --quiet --set control.differential_gain=-6.603").text(cable, "answer");
  EXPECT_EQ(answer.rfind("Undecided", 0), 0U) << answer;
}

TEST(Answers, SayWhatIsLeftOnTheConductorItself) {
  const std::string settings = " --set control.differential_gain=-4";
  const std::string answer = table_of("answers --quiet" + settings).text(cable, "answer");
  EXPECT_EQ(answer.rfind("Yes", 0), 0U) << answer;
  const std::string cell = "response --p -557:-557:1 --d -4:-4:1 --quiet";
  const double here = table_of(cell).number(0, "amplitude_m");
  EXPECT_NEAR(number_behind(answer, "on the cable, "), 100.0 * here / 1.2559e-3,
              0.6);  // the amplitude under 0.5 N without control
  const double there =
      table_of(cell + " --set plant.model=cable").number(0, "ratio_to_uncontrolled");
  EXPECT_NEAR(number_behind(answer, "without play "), 100.0 * there, 1.0);
}

TEST(Answers, AskTheConductorOnlyWhereTheCaseGivesIt) {
  const TextFile file(
      "[plant]\nconductor_mass = 0.08\nconductor_stiffness = 52\nconductor_damping = 0.08\n"
      "absorber_mass = 0.16\nabsorber_stiffness = 74\nabsorber_damping = 4\n"
      "[control]\nsampling_period = 0.001\n[excitation]\namplitude = 0.5\nfrequency = 10\n");
  const auto answers = table_of("answers --quiet" + file.as_case());
  expect_holds(answers.text(answers.rows() - 1, "answer"), {"Not computed"});
}

TEST(Answers, AreThoseOfTheJobsThatTheyName) {
  const auto answers = table_of("answers --details");
  ASSERT_EQ(answers.rows(), 6U);
  const auto vibration = table_of(
      "sweep --axis backlash.width=0.0005:0.0005:1 --metric ratio_to_uncontrolled --metric "
      "force_peak --set control.sampling_period=0.001 --duration 20");
  EXPECT_NEAR(number_behind(answers.text(help, "answer"), "Yes: "),
              100.0 * vibration.number(0, "ratio_to_uncontrolled"), 0.06);
  EXPECT_NEAR(number_behind(answers.text(help, "detail"), "for up to "),
              vibration.number(0, "force_peak"), 0.006);
  const double best = -number_behind(answers.text(gain, "answer"), "D = −");
  const auto in_play = table_of("sweep --axis control.differential_gain=" + std::to_string(best) +
                                " --metric ratio_to_uncontrolled --duration 20");
  EXPECT_NEAR(number_behind(answers.text(gain, "detail"), "play of 0.5 mm this D leaves "),
              100.0 * in_play.number(0, "ratio_to_uncontrolled"), 0.2);
  const auto delay = table_of("max-delay --frequency 10:10:1 --quiet");
  EXPECT_NEAR(number_behind(answers.text(slow, "answer"), "Up to a sampling period of "),
              1e3 * delay.number(0, "max_sampling_period_s"), 0.06);
  expect_holds(answers.text(play, "answer"), {"the case has 0.5 mm"});
  expect_holds(answers.text(motion, "answer"), {"periodic(100)"});
}

/// On the conductor itself, where they are five.
TEST(Answers, OnTheCableAreThoseOfTheJobsThatTheyName) {
  const std::string there =
      " --quiet --set plant.model=cable --set control.sampling_period=0.005"
      " --set control.differential_gain=-4 --set backlash.width=0.0001";
  const auto answers = table_of("answers --details" + there);
  ASSERT_EQ(answers.rows(), 5U);
  const auto vibration = table_of(
      "sweep --axis backlash.width=0.0001:0.0001:1 --metric ratio_to_uncontrolled --duration 60" +
      there);
  EXPECT_NEAR(number_behind(answers.text(help, "answer"), "Yes: "),
              100.0 * vibration.number(0, "ratio_to_uncontrolled"), 0.06);
  const auto design = table_of("design" + there);
  EXPECT_NEAR(-number_behind(answers.text(gain, "answer"), "D = −"),
              design.number(0, "least_amplitude_gain"), 1e-3);
  const auto delay = table_of("max-delay --frequency 10:10:1" + there);
  EXPECT_NEAR(number_behind(answers.text(slow, "answer"), "Up to a sampling period of "),
              1e3 * delay.number(0, "max_sampling_period_s"), 0.06);
  expect_holds(answers.text(play, "answer"), {"the case has 0.1 mm"});
  const auto verdict = table_of("verdict" + there);
  EXPECT_TRUE(holds(answers.text(motion, "answer"), verdict.text(0, "verdict")));
}

TEST(Answers, AloneAreTwoColumns) {
  const auto lines = lines_of(run_holdfast("answers").output);
  ASSERT_EQ(lines.size(), 7U);
  EXPECT_EQ(lines.front(), "question,answer");
}

TEST(Answers, CallNoPlayHelpfulWhereTheVibrationIsTheSame) {
  const TextFile file(
      "[conductor]\nmass_per_length = 60\nspan = 100\nsag = 0.184\narea = 0.006\n"
      "youngs_modulus = 1.95e11\ndamping_ratio = 0.001\n[absorber]\nmass = 30\n"
      "position = 3\n[wind]\nspeed = 2\ndiameter = 0.16\neffective_length = 50\n"
      "[control]\nproportional_gain = \"tuned\"\ndifferential_gain = -1000\n"
      "sampling_period = 0.002\n[backlash]\nwidth = 1e-4\n");
  const auto answers =
      program::parse_csv(run_holdfast("answers" + file.as_case()).output, "answers");
  EXPECT_EQ(answers.text(help, "answer").rfind("No", 0), 0U) << answers.text(help, "answer");
  EXPECT_EQ(answers.text(play, "answer").rfind("None", 0), 0U) << answers.text(play, "answer");
}

TEST(Answers, SayWhichGainsAndWhichPlayAreNotOfTheUsersCase) {
  const TextFile file("[plant]\nabsorber_damping = 5\n[control]\nproportional_gain = -500\n");
  const auto answers = table_of("answers --details" + file.as_case());
  expect_holds(answers.text(help, "detail"),
               {"does not give control.differential_gain, control.sampling_period, "
                "backlash.width, so the built-in value is used"});
  EXPECT_FALSE(holds(table_of("answers --details").text(help, "detail"), "built-in value"));
}

TEST(Answers, OfASpanWhoseAbsorberNobodyGaveAreOfTheWindAndItsDevicesAlone) {
  const TextFile file("[conductor]\nname = \"Drake\"\nspan = 900\ntension = \"28.02 kN\"\n");
  for (const std::string& line :
       {file.as_case(), std::string(" --quiet --set conductor.name=Drake --set "
                                    "conductor.span=900 --set conductor.tension=28020")}) {
    const Outcome outcome = run_holdfast("answers" + line);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
    EXPECT_EQ(outcome.errors, "");
    expect_holds(outcome.output, {"vibrate"});
    for (const char* other : {"D =", "tuned", "the case has"})
      EXPECT_FALSE(holds(outcome.output, other)) << outcome.output;
  }
}

TEST(Answers, SayThatAMotionDivergesAndRecommendNoGainThatIsNotWorthItsDrive) {
  const auto answers = table_of("answers --set control.sampling_period=0.03");
  const std::string text = answers.text(help, "answer"), advice = answers.text(gain, "answer");
  expect_holds(text, {"diverges"});
  EXPECT_FALSE(holds(text, "%")) << text;
  expect_holds(answers.text(motion, "answer"), {"diverges"});
  EXPECT_EQ(advice.rfind("No D is worth a drive", 0), 0U) << advice;
  EXPECT_GT(number_behind(advice, "leaves "), 95.0);
  EXPECT_EQ(table_of("answers").text(gain, "answer").rfind("D = ", 0), 0U);
}

TEST(Answers, NameAPlayThatTheDriveNeverLeaves) {
  const std::string text = help_of_doubtful("backlash.width=10");
  expect_holds(text, {"never leaves its play"});
  EXPECT_FALSE(holds(text, "%")) << text;
}

TEST(Answers, CallNoForceNoHelp) {
  const auto answers = table_of("answers" + idle);
  for (const std::size_t row : {help, play})
    expect_holds(answers.text(row, "answer"), {"both gains are 0"});
}

TEST(Answers, SayThatALoopLivesOnItsPlay) {
  const auto answers =
      table_of("answers --set control.differential_gain=-40 --set backlash.width=0.001");
  const std::string text = answers.text(help, "answer");
  EXPECT_FALSE(holds(text, "Yes")) << text;
  EXPECT_GT(number_behind(text, "spectral radius "), 1.0);
  expect_holds(answers.text(play, "answer"), {"tried from ", "without play the loop is unstable"});
}

TEST(Answers, CompareWithThePlantWithoutAComputer) {
  // The force held over a sample of 30 ms would shake the plant less than the one that acts on it.
  const std::string held = " --set control.sampling_period=0.03 --set control.differential_gain=-3";
  const auto slow_one = table_of("answers --details" + held);
  const double shaken =
      number_behind(slow_one.text(help, "detail"), "vibration without control is ");
  const auto fine = table_of("sweep --axis control.sampling_period=0.0002:0.0002:1" + idle +
                             " --set excitation.hold=exact --metric steady_peak --duration 20");
  EXPECT_NEAR(shaken, 1e3 * fine.number(0, "steady_peak"), 0.006);
  EXPECT_FALSE(holds(table_of("answers --details").text(help, "detail"), "held over a sample"));
}

TEST(Answers, DoNotTakeTheForceOfFewSamplesForTheVibration) {
  for (const char* blind : {"control.sampling_period=10", "excitation.frequency=10000"})
    expect_holds(help_of_doubtful(blind), {"fewer than two samples"});
}

TEST(Classification, SaysItInWordsWhereProgressIsShown) {
  const Outcome outcome = run_holdfast("verdict --progress");
  EXPECT_EQ(outcome.exit_code, 0);
  expect_holds(outcome.errors, {"holdfast: periodic(100), 0.1 s: "});
  EXPECT_EQ(run_holdfast("verdict").errors, "");
}

}  // namespace
}  // namespace holdfast::tests
