#include "cli/program.hpp"
#include "holdfast/core/types.hpp"
#include "support/drake_case.hpp"

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

  /// The option that names a case of that text.
  std::string case_of(const std::string& text) const {
    write_text(folder_ / "case.toml", text);
    return " --case '" + (folder_ / "case.toml").string() + "'";
  }

  Outcome run(const std::string& text, const std::string& job) const {
    return run_holdfast(job + case_of(text));
  }

  CsvTable answer(const std::string& text, const std::string& options) const {
    return parse_csv(printed_by("place " + options + case_of(text)), options);
  }

  void expect_wrong(const std::string& text, const std::string& options,
                    const std::string& part) const {
    expect_refused("place --quiet " + options + case_of(text), {part});
  }

  double largest_strain(const std::string& text, const std::string& settings) const {
    const Outcome outcome = run(text, "aeolian --quiet --frequency 5:60:56 " + settings);
    return largest_in(parse_csv(outcome.output, settings), "strain");
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
  const auto found = answer(text, "--quiet --frequency 5:60:56");
  EXPECT_LT(value_of(found, "largest_strain"), 0.4 * value_of(found, "largest_strain_before"));
  EXPECT_NEAR(largest_strain(text, ""), value_of(found, "largest_strain_before"), 1e-12);
  const auto at = [&](double place) {
    return largest_strain(text, "--set device.1.position=" + program::format_number(place));
  };
  EXPECT_NEAR(at(value_of(found, "position")), value_of(found, "largest_strain"), 1e-12);
  for (double place = 0.25; place < 6.5; place += 0.25)
    EXPECT_GE(at(place), value_of(found, "largest_strain") * (1.0 - 1e-9)) << place;
}

TEST_F(PlaceJob, ADashpotOnAStayIsThatOfTheFormulas) {
  const double wave_impedance = std::sqrt(3.5e6 * 60.0), speed = std::sqrt(3.5e6 / 60.0);
  const auto mode = answer(stay_text, "--quiet --modes 1:1 --keep position");
  EXPECT_EQ(value_of(mode, "position"), 6.0);
  EXPECT_NEAR(value_of(mode, "least_damping_ratio"), 0.0102114712, 1e-8);
  EXPECT_NEAR(value_of(mode, "damping"), wave_impedance / (0.02 * pi<double>),
              1e-3 * value_of(mode, "damping"));
  EXPECT_LT(value_of(mode, "least_damping_ratio_before"), 0.005);
  const auto wave = answer(stay_text, "--quiet --for damping --frequency 3:3:1 --keep position");
  const double phase = 2.0 * pi<double> * 3.0 * 6.0 / speed;
  EXPECT_NEAR(value_of(wave, "damping"), wave_impedance / std::sin(phase),
              1e-3 * value_of(wave, "damping"));
  EXPECT_NEAR(value_of(wave, "least_ratio"), std::tan(phase / 2.0), 1e-6);
}

TEST_F(PlaceJob, WhatIsNotKnownHasNoRowAndIsSaid) {
  const Outcome outcome = run_holdfast("place --for damping --frequency 20:40:3");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_EQ(outcome.output.find("nan"), std::string::npos) << outcome.output;
  EXPECT_EQ(outcome.output.find("largest_force"), std::string::npos) << outcome.output;
  expect_holds(outcome.errors, {"conductor.diameter"});
}

TEST_F(PlaceJob, SaysWhereABoundEndsIt) {
  expect_said("place --modes 1:5" + case_of(stay_text),
              {"position lies at the upper bound of the search, 30 m"});
  const auto best = answer(stay_text, "--quiet --modes 2:2 --keep position");
  expect_said("place --modes 2:2 --keep position --set device.1.damping=" +
                  program::format_number(value_of(best, "damping")) + case_of(stay_text),
              {"no values better than the case's"});
}

TEST_F(PlaceJob, ANegativeStiffnessLeavesTheConductorAtRest) {
  std::string text = stay_text;
  text.replace(text.find("dashpot"), 7, "stiffness");
  expect_said("place --modes 1:5 --keep position" + case_of(text + "stiffness = -2e5\n"),
              {"unstable at rest"});
  const auto found = answer(text + "stiffness = -2e5\n", "--quiet --modes 1:5 --keep position");
  EXPECT_LT(value_of(found, "stiffness"), -2e5);
  EXPECT_GT(value_of(found, "stiffness"), -3.5e6 * (1.0 / 6.0 + 1.0 / 294.0));
  EXPECT_GT(value_of(found, "least_damping_ratio"), 0.05);
}

TEST_F(PlaceJob, TheAbsorberOnDrakeHoldsAndTellsWhatItTakes) {
  const std::string text = drake_line + drake_absorber;
  const auto found = answer(text, "--quiet --frequency 5:60:56");
  EXPECT_EQ(value_of(found, "position"), 1.5);
  EXPECT_LT(value_of(found, "largest_strain"), 0.7 * value_of(found, "largest_strain_before"));
  EXPECT_LT(value_of(found, "largest_strain"), value_of(found, "largest_strain_without_absorber"));
  EXPECT_EQ(value_of(found, "perfect_absorption_frequency"), 32.5);
  EXPECT_GT(value_of(found, "largest_force"), 1.0);
  EXPECT_GT(value_of(found, "largest_stroke"), 1e-5);
  EXPECT_NEAR(value_of(found, "energy_per_day"), 86400.0 * value_of(found, "drive_power"),
              1e-9 * std::abs(value_of(found, "energy_per_day")));
  const std::string gains = "--set control.proportional_gain=" +
                            program::format_number(value_of(found, "proportional_gain")) +
                            " --set control.differential_gain=" +
                            program::format_number(value_of(found, "differential_gain"));
  EXPECT_NEAR(largest_strain(text, gains), value_of(found, "largest_strain"), 1e-12);
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
  expect_wrong(passive, "--keep position", "nothing to vary");
  expect_wrong(passive, "--margin 0.3", "device 1 has none");
  expect_wrong(passive, "--modes 1:2 --for strain", "--modes works only with --for damping");
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
  const auto found = answer(cardinal, "--device absorber --frequency 10:40:4 --quiet");
  const std::string gains =
      gains_of(value_of(found, "proportional_gain"), value_of(found, "differential_gain"));
  EXPECT_GT(value_of(found, "judged_modes"), 1000.0);
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
