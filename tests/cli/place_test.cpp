#include "cli/program.hpp"
#include "holdfast/core/types.hpp"
#include "io/text/csv.hpp"
#include "io/text/text.hpp"
#include "support/drake_case.hpp"
#include "support/testing.hpp"

namespace holdfast::tests {
namespace {

using program::CsvTable;
using program::parse_csv;

constexpr const char* stockbridge = R"([[device]]
kind = "stockbridge"
position = 1.0
mass = 4.5
frequencies = [9.0, 28.0]
damping_ratios = [0.2, 0.25]
mass_share = 0.6
clamp_mass = 0.5
)";

constexpr const char* stay_text = R"([conductor]
mass_per_length = 60.0
span = 300.0
tension = 3.5e6
area = 0.007
youngs_modulus = 1.95e11
damping_ratio = 0.0
[[device]]
kind = "dashpot"
position = 6.0
damping = 50000.0
)";

class PlaceJob : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!both_packages) GTEST_SKIP() << "built without Ceres Solver";
  }

  /// `holdfast JOB` of a case of that text.
  Outcome run(const std::string& text, const std::string& job) const {
    std::ofstream(folder_ / "case.toml") << text;
    return run_holdfast(job + " --case '" + (folder_ / "case.toml").string() + "'");
  }

  std::map<std::string, double> answer(const std::string& text, const std::string& options) const {
    const Outcome outcome = run(text, "place " + options);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
    const CsvTable table = parse_csv(outcome.output, options);
    std::map<std::string, double> numbers;
    for (std::size_t row = 0; row < table.rows(); ++row)
      numbers[table.text(row, "quantity")] = table.number(row, "value");
    return numbers;
  }

  void expect_wrong(const std::string& text, const std::string& options,
                    const std::string& part) const {
    const Outcome outcome = run(text, "place --quiet " + options);
    EXPECT_EQ(outcome.exit_code, 2) << options;
    EXPECT_EQ(outcome.output, "") << options;
    EXPECT_NE(outcome.errors.find(part), std::string::npos) << outcome.errors;
  }

  double largest_strain(const std::string& text, const std::string& settings) const {
    const Outcome outcome = run(text, "aeolian --quiet --frequency 5:60:56 " + settings);
    const CsvTable table = parse_csv(outcome.output, settings);
    double largest = 0.0;
    for (std::size_t row = 0; row < table.rows(); ++row)
      largest = std::max(largest, table.number(row, "strain"));
    return largest;
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(PlaceJob, HasTheColumnsThatOtherProgramsRead) {
  const Outcome outcome = run(stay_text, "place --quiet --modes 1:2 --keep position");
  EXPECT_EQ(lines_of(outcome.output).front(), "quantity,value,unit");
  EXPECT_EQ(lines_of(outcome.output)[1], "position,6,m");
}

TEST_F(PlaceJob, AStockbridgeOnDrakeGoesWhereTheBalanceSaysTheSame) {
  const std::string text = drake_line + stockbridge;
  const auto found = answer(text, "--quiet");
  EXPECT_LT(found.at("largest_strain"), 0.4 * found.at("largest_strain_before"));
  EXPECT_NEAR(largest_strain(text, ""), found.at("largest_strain_before"), 1e-12);
  const auto at = [&](double place) {
    return largest_strain(text, "--set device.1.position=" + program::format_number(place));
  };
  EXPECT_NEAR(at(found.at("position")), found.at("largest_strain"), 1e-12);
  for (double place = 0.25; place < 6.5; place += 0.25)
    EXPECT_GE(at(place), found.at("largest_strain") * (1.0 - 1e-9)) << place;
}

TEST_F(PlaceJob, ADashpotOnAStayIsThatOfTheFormulas) {
  const double wave_impedance = std::sqrt(3.5e6 * 60.0), speed = std::sqrt(3.5e6 / 60.0);
  const auto mode = answer(stay_text, "--quiet --modes 1:1 --keep position");
  EXPECT_EQ(mode.at("position"), 6.0);
  EXPECT_NEAR(mode.at("least_damping_ratio"), 0.0102114712, 1e-8);
  EXPECT_NEAR(mode.at("damping"), wave_impedance / (0.02 * pi<double>), 1e-3 * mode.at("damping"));
  EXPECT_LT(mode.at("least_damping_ratio_before"), 0.005);
  const auto wave = answer(stay_text, "--quiet --for damping --frequency 3:3:1 --keep position");
  const double phase = 2.0 * pi<double> * 3.0 * 6.0 / speed;
  EXPECT_NEAR(wave.at("damping"), wave_impedance / std::sin(phase), 1e-3 * wave.at("damping"));
  EXPECT_NEAR(wave.at("least_ratio"), std::tan(phase / 2.0), 1e-6);
}

TEST_F(PlaceJob, WhatIsNotKnownHasNoRowAndIsSaid) {
  const Outcome outcome = run_holdfast("place --for damping --frequency 20:40:3");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_EQ(outcome.output.find("nan"), std::string::npos) << outcome.output;
  EXPECT_EQ(outcome.output.find("largest_force"), std::string::npos) << outcome.output;
  EXPECT_NE(outcome.errors.find("conductor.diameter"), std::string::npos) << outcome.errors;
}

TEST_F(PlaceJob, SaysWhereABoundEndsIt) {
  const Outcome outcome = run(stay_text, "place --modes 1:5");
  EXPECT_NE(outcome.errors.find("position ends at the upper bound of what was searched, 30 m"),
            std::string::npos)
      << outcome.errors;
  const auto best = answer(stay_text, "--quiet --modes 2:2 --keep position");
  const Outcome again = run(stay_text, "place --modes 2:2 --keep position --set device.1.damping=" +
                                           program::format_number(best.at("damping")));
  EXPECT_NE(again.errors.find("nothing better was found"), std::string::npos) << again.errors;
}

TEST_F(PlaceJob, ANegativeStiffnessLeavesTheConductorAtRest) {
  std::string text = stay_text;
  text.replace(text.find("dashpot"), 7, "stiffness");
  const Outcome outcome = run(text + "stiffness = -2e5\n", "place --modes 1:5 --keep position");
  EXPECT_NE(outcome.errors.find("away from its rest"), std::string::npos) << outcome.errors;
  const auto found = answer(text + "stiffness = -2e5\n", "--quiet --modes 1:5 --keep position");
  EXPECT_LT(found.at("stiffness"), -2e5);
  EXPECT_GT(found.at("stiffness"), -3.5e6 * (1.0 / 6.0 + 1.0 / 294.0));
  EXPECT_GT(found.at("least_damping_ratio"), 0.05);
}

TEST_F(PlaceJob, TheAbsorberOnDrakeHoldsAndTellsWhatItTakes) {
  const std::string text = drake_line + drake_absorber;
  const auto found = answer(text, "--quiet");
  EXPECT_EQ(found.at("position"), 1.5);
  EXPECT_LT(found.at("largest_strain"), 0.7 * found.at("largest_strain_before"));
  EXPECT_LT(found.at("largest_strain"), found.at("largest_strain_without_absorber"));
  EXPECT_EQ(found.at("perfect_absorption_frequency"), 32.5);
  EXPECT_GT(found.at("largest_force"), 1.0);
  EXPECT_GT(found.at("largest_stroke"), 1e-5);
  EXPECT_NEAR(found.at("energy_per_day"), 86400.0 * found.at("drive_power"),
              1e-9 * std::abs(found.at("energy_per_day")));
  const std::string gains =
      "--set control.proportional_gain=" + program::format_number(found.at("proportional_gain")) +
      " --set control.differential_gain=" + program::format_number(found.at("differential_gain"));
  EXPECT_NEAR(largest_strain(text, gains), found.at("largest_strain"), 1e-12);
  EXPECT_EQ(run(text, "aeolian --frequency 20:20:1 " + gains).errors.find("unstable"),
            std::string::npos);
}

TEST_F(PlaceJob, RefusesWhatIsNoQuestion) {
  const std::string passive = drake_line + stockbridge;
  expect_wrong(passive, "--device 2", "--device 2: must be 1");
  expect_wrong(passive, "--device 0", "--device 0: must be 1");
  expect_wrong(passive, "--device first", "--device first: must be 1");
  expect_wrong(passive, "--device absorber", "no absorber");
  expect_wrong(passive, "--frequency 0:60:56", "greater than 0 Hz");
  expect_wrong(passive, "--frequency -5:60:56", "greater than 0 Hz");
  expect_wrong(passive, "--keep position", "the maker's");
  expect_wrong(passive, "--margin 0.3", "device 1 has none");
  expect_wrong(passive, "--modes 1:2 --for strain", "--modes goes with --for damping");
  expect_wrong(passive, "--modes 0:2", "FIRST:LAST");
  expect_wrong(passive, "--modes 1.5:2", "FIRST:LAST");
  expect_wrong(stay_text, "", "diameter");
  expect_wrong(drake_line, "", "no device is on the span");
  expect_wrong(drake_line + drake_absorber, "--device 1", "no [[device]]");
}

/// A line whose absorber is of [absorber] alone: every job has the same one, and what is placed is
/// stable by all of them.
constexpr const char* cardinal = R"([conductor]
name = "Cardinal"
span = 350
tension = 30070
damping_ratio = 0.0003
[absorber]
mass = 5
position = 1.5
[plant]
model = "string"
absorber_stiffness = 12580
absorber_damping = 30
[control]
proportional_gain = 0
differential_gain = 0
sampling_period = 0.002
processing_delay = 0.0005
[backlash]
width = 0
)";

std::string gains_of(double p, double d) {
  return " --quiet --set control.proportional_gain=" + program::format_number(p) +
         " --set control.differential_gain=" + program::format_number(d);
}

TEST_F(PlaceJob, PlacesGainsThatEveryJobCallsStable) {
  auto found = answer(cardinal, "--device absorber --frequency 10:40:4 --quiet");
  const std::string gains = gains_of(found["proportional_gain"], found["differential_gain"]);
  EXPECT_GT(found["judged_modes"], 1000.0);
  EXPECT_EQ(run(cardinal, "margins" + gains).exit_code, 0);
  const CsvTable modes =
      parse_csv(run(cardinal, "modal-damping --count 400" + gains).output, "modes");
  for (std::size_t row = 0; row < modes.rows(); ++row)
    EXPECT_GT(modes.number(row, "damping_ratio"), 0.0) << row;
}

/// Gains with which modes 157 and more grow: nobody calls them stable, and no amplitude is told.
TEST_F(PlaceJob, OfAGrowingLoopNoAmplitudeIsTold) {
  const std::string gains = gains_of(-76810, 48.1);
  EXPECT_EQ(run(cardinal, "margins" + gains).exit_code, 1);
  const CsvTable vibration =
      parse_csv(run(cardinal, "aeolian --frequency 10:40:4" + gains).output, "aeolian");
  for (std::size_t row = 0; row < vibration.rows(); ++row) {
    EXPECT_TRUE(std::isnan(vibration.number(row, "amplitude_m")));
    EXPECT_TRUE(std::isnan(vibration.number(row, "strain")));
    EXPECT_GT(vibration.number(row, "amplitude_bare_m"), 0.0);
  }
}

TEST_F(PlaceJob, HasTheAbsorberOfItsOwnTable) {
  const std::string job = "absorption --frequency 5:45:5 --quiet";
  EXPECT_EQ(run(cardinal, job).output, run(cardinal, job + " --set plant.absorber_mass=5").output);
}

}  // namespace
}  // namespace holdfast::tests
