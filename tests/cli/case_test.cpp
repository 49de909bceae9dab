#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "cli/program.hpp"

namespace holdfast::tests {
namespace {

/// A cell of the row of a key in what `case --check` writes.
std::string told(const program::CsvTable& table, const std::string& key,
                 const std::string& column) {
  for (std::size_t row = 0; row < table.rows(); ++row)
    if (table.text(row, "key") == key) return table.text(row, column);
  ADD_FAILURE() << "no row " << key;
  return "";
}

double number_told(const program::CsvTable& table, const std::string& key) {
  return std::strtod(told(table, key, "value").c_str(), nullptr);
}

TEST(CaseJob, BeginsAFileThatIsTheSameCase) {
  const TemporaryFolder folder;
  const std::string file = (folder / "my cable.toml").string();
  const Outcome begun =
      run_holdfast("case --set control.sampling_period=0.004 --init '" + file + "'");
  EXPECT_EQ(begun.exit_code, 0) << begun.errors;
  EXPECT_EQ(begun.output, "");
  const std::string text = read_text(file);
  EXPECT_NE(text.find("sampling_period = 0.004"), std::string::npos) << text;
  EXPECT_NE(text.find("# N/m, k1"), std::string::npos) << "commented with units\n" << text;
  const auto expected = table_of("case --set control.sampling_period=0.004");
  const auto read = table_of("case --check '" + file + "'");
  ASSERT_EQ(read.rows(), expected.rows());
  for (std::size_t row = 0; row < read.rows(); ++row) {
    EXPECT_EQ(read.text(row, "key"), expected.text(row, "key"));
    EXPECT_EQ(read.text(row, "value"), expected.text(row, "value")) << read.text(row, "key");
  }
}

TEST(CaseJob, TellsWhenTheNoiseRepeats) {
  const auto table = table_of(
      "case --set excitation.noise_rms=0.1 --set excitation.noise_lines=980 --set "
      "excitation.noise_lowest=1 --set excitation.noise_highest=50");
  EXPECT_EQ(number_told(table, "noise_period"), 20.0);
}

TEST(CaseJob, WritesOverNobodysWork) {
  const TemporaryFolder folder;
  const std::string file = (folder / "mine.toml").string();
  write_text(file, "# mine\n");
  const Outcome again = run_holdfast("case --init '" + file + "'");
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_EQ(again.error_lines(), 1U);
  EXPECT_NE(again.errors.find("already"), std::string::npos) << again.errors;
  EXPECT_EQ(read_text(file), "# mine\n");
}

TEST(CaseJob, TellsWhereEachValueComesFrom) {
  const TemporaryFolder folder;
  const std::string file = (folder / "mine.toml").string();
  write_text(file, "[control]\nsampling_period = 0.01\n[backlash]\nwidth = 0.002\n");
  const auto table = table_of("case --check '" + file + "' --set backlash.width=0.001");
  EXPECT_EQ(told(table, "control.sampling_period", "origin"), file + ":2");
  EXPECT_EQ(told(table, "backlash.width", "origin"), "--set backlash.width=0.001");
  EXPECT_EQ(told(table, "plant.conductor_mass", "origin"), "built-in");
  EXPECT_EQ(told(table, "spectral_radius", "origin"), "derived");
  EXPECT_NE(told(table, "backlash.width", "meaning").find("at least 0 m"), std::string::npos);
}

TEST(CaseJob, TellsWhatFollowsFromTheCase) {
  const auto table = table_of("case --set control.sampling_period=0.01");
  // Kollár 2022, Fig. 4a: the boundary at P = −557 N/m; Table 1: Eq. 6 at 10 Hz.
  EXPECT_NEAR(number_told(table, "stable_from"), -15.49, 0.005);
  EXPECT_NEAR(number_told(table, "tuned_proportional_gain"), -557.25, 0.01);
  EXPECT_NEAR(number_told(table, "samples_per_forcing_period"), 10.0, 1e-12);
  EXPECT_EQ(number_told(table, "samples_to_coincidence"), 10.0);
  // The frequencies that the plant of Table 1 has (docs/reading-the-paper.md).
  EXPECT_NEAR(number_told(table, "first_natural_frequency"), 1.999, 0.001);
  EXPECT_NEAR(number_told(table, "second_natural_frequency"), 6.998, 0.003);
  EXPECT_NEAR(number_told(table, "static_displacement"), 0.5 / 50.3, 1e-6);
}

TEST(CaseJob, RefusesWhatDoesNotFitTogether) {
  for (const std::string arguments :
       {"case --init a.toml --check b.toml", "case --check absent.toml",
        "case --case absent.toml --check absent.toml", "case --chek a.toml"}) {
    const Outcome outcome = run_holdfast(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_EQ(outcome.error_lines(), 1U) << outcome.errors;
  }
}

TEST(CaseJob, AGivenKeyOfThePlantGoesOverTheReduction) {
  if (!both_packages) GTEST_SKIP() << "the reduction fits c2 with Ceres Solver";
  const std::string drake =
      "case --case '" + std::string(HOLDFAST_SOURCE_DIR) + "/data/acsr-drake-300m.toml' ";
  const auto reduced = program::parse_csv(run_holdfast(drake).output, "reduced");
  const Outcome outcome = run_holdfast(drake + "--set plant.absorber_damping=50");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_NE(outcome.errors.find("reduced from the conductor"), std::string::npos);
  const auto changed = program::parse_csv(outcome.output, "changed");
  EXPECT_EQ(number_told(changed, "plant.absorber_damping"), 50.0);
  for (const std::string key : {"plant.conductor_mass", "plant.conductor_stiffness",
                                "plant.conductor_damping", "plant.absorber_stiffness"}) {
    EXPECT_EQ(number_told(changed, key), number_told(reduced, key)) << key;
    EXPECT_EQ(told(changed, key, "origin"), "computed from the conductor");
  }
}

}  // namespace
}  // namespace holdfast::tests
