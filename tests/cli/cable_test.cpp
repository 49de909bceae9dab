#include "cli/program.hpp"
#include "io/text/csv.hpp"
#include "jobs/cable/cable_decay.hpp"
#include "support/testing.hpp"

namespace holdfast::tests {
namespace {

using program::CsvTable;

std::map<std::string, double> values_of(const CsvTable& table) {
  std::map<std::string, double> values;
  for (std::size_t row = 0; row < table.rows(); ++row)
    values[table.text(row, "quantity")] = table.number(row, "value");
  return values;
}

TEST(Statics, FourModelsBesideEachOther) {
  const CsvTable table = table_of("statics --force -0.4:0.4:5");
  EXPECT_EQ(table.names(),
            (std::vector<std::string>{"force_N", "exact_m", "irvine_m", "linear_m", "elements_m"}));
  ASSERT_EQ(table.rows(), 5U);
  EXPECT_EQ(table.number(2, "exact_m"), 0.0);
  EXPECT_NEAR(table.number(3, "exact_m"), 3.76e-3, 5e-6);
  EXPECT_NEAR(table.number(3, "irvine_m"), 3.845e-3, 4e-6);
  EXPECT_NEAR(table.number(3, "linear_m"), 0.2 / 50.3, 1e-12);
  EXPECT_NEAR(table.number(3, "elements_m"), table.number(3, "exact_m"), 1e-6);
}

TEST(Modes, FamiliesAndFrequencies) {
  const CsvTable table = table_of("modes --count 6");
  ASSERT_EQ(table.rows(), 6U);
  const double irvine[] = {2.056, 2.934, 4.113, 5.043, 6.169, 7.114};
  const double elements[] = {2.038, 2.928, 4.100, 5.036, 6.158, 7.108};
  for (std::size_t k = 0; k < 6; ++k) {
    EXPECT_EQ(table.number(k, "mode"), static_cast<double>(k + 1));
    EXPECT_EQ(table.text(k, "family"), k % 2 == 0 ? "antisymmetric" : "symmetric");
    EXPECT_NEAR(table.number(k, "irvine_Hz"), irvine[k], 1e-3 * irvine[k]);
    EXPECT_NEAR(table.number(k, "elements_Hz"), elements[k], 1e-3 * elements[k]);
  }
}

TEST(Reduce, GivesThePlantAndHowSureItIs) {
  if (!both_packages) GTEST_SKIP() << "needs SUNDIALS and Ceres Solver";
  const CsvTable table = table_of("reduce");
  EXPECT_EQ(table.names(), (std::vector<std::string>{"quantity", "symbol", "value", "unit"}));
  auto values = values_of(table);
  EXPECT_NEAR(values.at("conductor_stiffness"), 50.17, 0.1);
  EXPECT_NEAR(values.at("conductor_damping"), 0.079, 0.001);
  EXPECT_EQ(values.at("absorber_mass"), 0.16);
  EXPECT_GT(values.at("absorber_damping"), 3.6);
  EXPECT_LT(values.at("absorber_damping"), 5.9);
  EXPECT_LT(values.at("absorber_damping_second_minimum"), 1.2);
  EXPECT_GT(values.at("absorber_stiffness_condition"), 10.0) << "close to the double root";
  // The two frequencies of [reduction] are those of the plant: their squares' sum and product.
  const double m1 = values.at("conductor_mass"), k1 = values.at("conductor_stiffness");
  const double m2 = values.at("absorber_mass"), k2 = values.at("absorber_stiffness");
  const double first = std::pow(2.0 * M_PI * 1.999, 2), second = std::pow(2.0 * M_PI * 6.998, 2);
  EXPECT_NEAR((k1 + k2) / m1 + k2 / m2, first + second, 1e-9 * second);
  EXPECT_NEAR(k1 * k2 / (m1 * m2), first * second, 1e-9 * first * second);
}

TEST(Reduce, WithoutARealPlantSaysWhatWouldHaveOne) {
  expect_refused(
      "reduce --set reduction.first_frequency=2.056 --set reduction.second_frequency=7.114",
      {"with this k1 the absorber may weigh 0.15"}, 1);
  expect_refused("simulate --set conductor.span=6.5", {"the absorber may weigh"}, 1);
}

TEST(Reduce, AnotherConductorCarriesTheWholeProgram) {
  if (!both_packages) GTEST_SKIP() << "needs SUNDIALS and Ceres Solver";
  const std::string span =
      std::string("--case '") + HOLDFAST_SOURCE_DIR + "/data/acsr-drake-300m.toml'";
  const auto values = values_of(table_of("reduce --quiet " + span));
  EXPECT_EQ(values.at("absorber_mass"), 5.0);
  EXPECT_GT(values.at("conductor_mass"), 0.0);
  EXPECT_EQ(table_of("simulate --quiet --duration 0.01 " + span).rows(), 11U);
  // Without more words a fit is the one that the reduction makes.
  const auto fitted = values_of(table_of("fit --quiet " + span));
  EXPECT_EQ(fitted.at("absorber_damping"), values.at("absorber_damping"));
  const Outcome warned = run_holdfast("reduce " + span);
  EXPECT_EQ(warned.error_lines(), 1U) << warned.errors;
  EXPECT_NE(warned.errors.find("no absorber_damping makes the two-mass plant meet"),
            std::string::npos);
}

TEST(Reduce, APeakThatThePlantCannotMeetIsNotTaken) {
  if (!both_packages) GTEST_SKIP() << "needs SUNDIALS and Ceres Solver";
  const std::string stay =
      std::string("--case '") + HOLDFAST_SOURCE_DIR + "/data/stay-cable-sutong.toml'";
  const auto values = values_of(table_of("reduce --quiet " + stay));
  EXPECT_LT(values.at("absorber_damping_misfit_history"), 0.5);
  EXPECT_LT(values.at("absorber_damping_standard_error"), 0.2 * values.at("absorber_damping"));
  EXPECT_LE(values.at("absorber_damping_lowest"), values.at("absorber_damping"));
  EXPECT_GE(values.at("absorber_damping_highest"), values.at("absorber_damping"));
}

TEST(Reduce, TheFrequenciesFollowTheConductorAndTheAbsorbersPlace) {
  const auto frequency = [](const std::string& setting) {
    const Outcome outcome = run_holdfast("reduce --quiet " + setting);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
    return values_of(program::parse_csv(outcome.output, setting)).at("first_frequency");
  };
  // What is set to what it was changes nothing.
  EXPECT_EQ(frequency("--set conductor.youngs_modulus=18e9"), frequency(""));
  // The antisymmetric first mode has a node at mid-span.
  EXPECT_GT(frequency("--set absorber.position=3.2 --set absorber.mass=0.05"), 2.5);
}

TEST(Decay, ComparesTheContinuousCableWithThePlant) {
  if (!both_packages) GTEST_SKIP() << "needs SUNDIALS";
  const CsvTable table = table_of("decay --duration 0.5 --equal-displacement");
  EXPECT_EQ(table.names(), (std::vector<std::string>{"time_s", "elements_m", "two_dof_m"}));
  ASSERT_EQ(table.rows(), 501U);
  EXPECT_NEAR(table.number(0, "elements_m"), 3.758e-3, 4e-6);
  EXPECT_EQ(table.number(0, "two_dof_m"), table.number(0, "elements_m"));
  const CsvTable same_force = table_of("decay --duration 0.1");
  EXPECT_NEAR(same_force.number(0, "two_dof_m"), 0.2 / 50.3, 1e-12);
  for (const std::string absorber : {"rigid", "spring"})
    EXPECT_EQ(table_of("decay --duration 0.1 --elements 20 --absorber " + absorber).rows(), 101U);
}

TEST(Peaks, DiscrepancyIsThatOfTheTwoColumns) {
  if (!both_packages) GTEST_SKIP() << "needs SUNDIALS";
  const CsvTable table = table_of("peaks --force 0.1:0.4:4");
  ASSERT_EQ(table.rows(), 4U);
  for (std::size_t row = 0; row < 4; ++row) {
    const double cable = table.number(row, "elements_peak_m");
    const double plant = table.number(row, "two_dof_peak_m");
    EXPECT_LT(cable, 0.0) << "above the equilibrium";
    EXPECT_NEAR(table.number(row, "discrepancy"), std::abs(plant - cable) / -cable, 1e-12);
    EXPECT_LT(table.number(row, "discrepancy"), 0.1) << "Fig. 2b";
  }
}

TEST(Statics, OfADeepCableWarnThatIrvineIsForShallowOnes) {
  for (const std::string job : {"statics --force 0.1:0.2:2", "modes"}) {
    const Outcome outcome = run_holdfast(job + " --set conductor.sag=1.6");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
    EXPECT_EQ(outcome.error_lines(), 1U) << outcome.errors;
    EXPECT_NE(outcome.errors.find("conductor.sag over conductor.span is 0.25"), std::string::npos)
        << outcome.errors;
  }
}

TEST(Peaks, UnderNoForceThereIsNone) {
  if (!both_packages) GTEST_SKIP() << "needs SUNDIALS";
  const CsvTable table = table_of("peaks --force 0:0:1");
  EXPECT_EQ(table.number(0, "elements_peak_m"), 0.0);
  EXPECT_TRUE(std::isnan(table.number(0, "discrepancy")));
}

TEST(Peaks, TheUsualDurationIsThatOfTheCable) {
  if (!both_packages) GTEST_SKIP() << "needs SUNDIALS";
  const std::string stay =
      std::string("--quiet --case '") + HOLDFAST_SOURCE_DIR + "/data/stay-cable-sutong.toml'";
  const CsvTable table = table_of("peaks --force 100:1000:2 " + stay);
  for (std::size_t row = 0; row < 2; ++row) EXPECT_LT(table.number(row, "elements_peak_m"), 0.0);
}

TEST(Modes, ThoseAlongTheSpanAreLeftOut) {
  // So soft a cable has its first mode along the span among those across it.
  const CsvTable table = table_of("modes --count 8 --set conductor.youngs_modulus=1.5e7");
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (table.text(row, "family") != "antisymmetric") continue;
    EXPECT_NEAR(table.number(row, "elements_Hz") / table.number(row, "irvine_Hz"), 1.0, 0.02);
  }
}

TEST(Fit, ReadsARecordAndReportsEveryMinimum) {
  if (!both_packages) GTEST_SKIP() << "needs SUNDIALS and Ceres Solver";
  EXPECT_EQ(header_of("fit"), "quantity,value,standard_error,unit");
  const auto built_in = values_of(table_of("fit"));
  EXPECT_GT(built_in.at("absorber_damping"), 3.6);
  EXPECT_LT(built_in.at("absorber_damping"), 5.9);
  EXPECT_LT(built_in.at("absorber_damping_minimum_2"), 1.2);
  const auto record = values_of(
      table_of(std::string("fit --data '") + HOLDFAST_SOURCE_DIR + "/data/kollar2022-decay.csv'"));
  EXPECT_GT(record.at("absorber_damping"), 3.6);
  EXPECT_LT(record.at("absorber_damping"), 5.9);
}

TEST(Cable, WrongInputIsOneLineAndNothingIsWritten) {
  expect_refused("reduce --set conductor.sag=3.2", {"--set conductor.sag=3.2"});
  expect_refused("statics --set absorber.position=7", {"--set absorber.position=7"});
  expect_refused("reduce --set conductor.youngs_modulus=1e3", {"would stretch it"});
  expect_refused("statics --force -9:1:5", {"admissible is greater than -2.9"});
  expect_refused("modes --count 0", {"--count"});
  expect_refused("modes --elements 7", {"admissible is an even number from 24 on"});
  expect_refused("reduce --set absorber.position=0.01",
                 {"absorber.position = 0.01 m", "reduction.reading_above = 0.007 m"});
  expect_refused("reduce --set reduction.reading_below=1", {"reduction.reading_below = 1 m"});
  expect_refused("reduce --set conductor.youngs_modulus=1e20", {"would stretch it"});
  const TemporaryFolder folder;
  std::ofstream(folder / "gap.csv") << "time_s,displacement_m\n0,1\n1,.9\n2,.8\n3,.7\n4,.6\n5,.5\n"
                                       "6,.4\n9,.3\n10,.2\n";
  if (!both_packages) return;
  const std::string out = " --output '" + (folder / "out.csv").string() + "'";
  expect_refused("fit --data '" + (folder / "gap.csv").string() + "'" + out, {"gap.csv:9: a gap"});
  expect_refused("fit --parameters absorber_dampin" + out, {"absorber_dampin"});
  for (const std::string interval : {"0.001", "0.5"})
    expect_refused("decay --force 40 --interval " + interval + out, {"slack"});
  expect_refused("decay --duration 1e6 --interval 1e-9" + out, {"--interval"});
  expect_refused("decay --duration 1 --interval 2" + out, {"--interval"});
  expect_refused("fit --parameters absorber_damping,absorber_damping" + out, {"--parameters"});
  expect_refused("fit --target peak --parameters conductor_mass,absorber_damping" + out,
                 {"--target peak determines 1"});
  expect_refused("fit --parameters absorber_damping," + out, {"a name is missing"});
  expect_refused("fit --parameters conductor_damping --set plant.conductor_damping=0" + out,
                 {"plant.conductor_damping"});
  EXPECT_EQ(folder.names(), std::vector<std::string>{"gap.csv"});
}

TEST(Cable, WithoutThePackagesTheJobsNameThem) {
  if (both_packages) GTEST_SKIP() << "both are here";
  if (!program::has_sundials()) expect_refused("decay", {"libsundials-dev"}, 1);
#ifndef HOLDFAST_HAS_CERES
  expect_refused("fit", {"libceres-dev"}, 1);
#endif
}

TEST(Wind, OutsideAeolianVibrationTheProgramWarns) {
  const Outcome outcome = run_holdfast(
      "design --set wind.speed=0.01 --set wind.diameter=0.0032 "
      "--set wind.effective_length=2");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.errors.find("outside the 3 to 150 Hz"), std::string::npos) << outcome.errors;
  EXPECT_EQ(outcome.error_lines(), 1U);
}

}  // namespace
}  // namespace holdfast::tests
