#include "cli/program.hpp"
#include "support/testing.hpp"

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
      run_holdfast("case --from plant --set control.sampling_period=0.004 --init '" + file + "'");
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

TEST(CaseJob, TellsOfDevicesAndOfTheSite) {
  const TemporaryFolder folder;
  const std::string file = (folder / "mine.toml").string();
  write_text(file,
             "[site]\nspeeds = [1, 2]\nhours = [3, 4]\n[[device]]\nkind = \"dashpot\"\n"
             "position = 1.5\ndamping = 30\n");
  const auto table = table_of("case --check '" + file + "' --set device.1.damping=20");
  EXPECT_EQ(told(table, "site.speeds", "value"), "[1.0, 2.0]");
  EXPECT_EQ(told(table, "device.1.position", "origin"), file + ":6");
  EXPECT_EQ(told(table, "device.1.damping", "value"), "20.0");
  EXPECT_EQ(told(table, "device.1.damping", "origin"), "--set device.1.damping=20");
  EXPECT_EQ(told(table, "device.1.damping", "unit"), "N s/m");
  EXPECT_EQ(told(table, "device.1.to", "origin"), "built-in");
  const auto bare = table_of("case");
  for (std::size_t row = 0; row < bare.rows(); ++row) {
    EXPECT_EQ(bare.text(row, "key").rfind("site.", 0), std::string::npos);
    EXPECT_EQ(bare.text(row, "key").rfind("device.", 0), std::string::npos);
  }
}

TEST(CaseJob, TablesOfDevicesAreReadAndNotOverwritten) {
  const TemporaryFolder folder;
  const std::string csv = (folder / "shaker.csv").string();
  const std::string device =
      "case --set device.1.kind=measured --set device.1.position=1 --set device.1.file='" + csv +
      "'";
  EXPECT_NE(run_holdfast(device).errors.find("cannot read"), std::string::npos);
  write_text(csv, "frequency_Hz,magnitude_N_s_per_m,phase_deg\n5,3,-1.5\n6,3,1.2\n");
  const Outcome doubted = run_holdfast(device);
  EXPECT_EQ(doubted.exit_code, 0) << doubted.errors;
  EXPECT_NE(doubted.errors.find("are they in radians?"), std::string::npos) << doubted.errors;
  EXPECT_EQ(run_holdfast(device + " --output '" + csv + "'").exit_code, 2);
  write_text(csv, "frequency_Hz,magnitude_N_s_per_m,phase_deg\n5,3,0\n6,3,120\n");
  const Outcome active = run_holdfast(device);
  EXPECT_EQ(active.exit_code, 2);
  EXPECT_EQ(active.error_lines(), 1U);
  EXPECT_NE(active.errors.find("would give power"), std::string::npos) << active.errors;
}

TEST(CaseJob, ASpanWithoutAbsorberIsACaseAndJobsAboutAbsorbersSaySo) {
  const std::string bare =
      " --quiet --set plant.model=string --set plant.absorber_mass=0 --set "
      "control.proportional_gain=0 --set control.differential_gain=0";
  const auto table = table_of("case" + bare);
  EXPECT_EQ(number_told(table, "plant.absorber_mass"), 0.0);
  EXPECT_EQ(number_told(table, "sampling_rate"), 1000.0);
  for (const std::string job : {"margins", "response --p 0:0:1 --d 0:0:1", "simulate",
                                "sweep --axis excitation.frequency=1:3:2"}) {
    const Outcome outcome = run_holdfast(job + bare);
    EXPECT_EQ(outcome.exit_code, 2) << job;
    EXPECT_EQ(outcome.error_lines(), 1U) << outcome.errors;
    EXPECT_NE(outcome.errors.find("plant.absorber_mass = 0: there is no absorber"),
              std::string::npos)
        << outcome.errors;
  }
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

std::string in_data(const std::string& name) {
  return "'" + std::string(HOLDFAST_SOURCE_DIR) + "/data/" + name + "'";
}

/// What a job says of the case that `case ARGUMENTS --init` writes.
std::string begun_case_in(const TemporaryFolder& folder, const std::string& arguments) {
  const std::string file = (folder / "begun.toml").string();
  std::filesystem::remove(file);
  const Outcome begun = run_holdfast("case " + arguments + " --quiet --init '" + file + "'");
  EXPECT_EQ(begun.exit_code, 0) << begun.errors;
  return file;
}

TEST(CaseJob, ABegunCaseIsTheSameToEveryJob) {
  if (!both_packages) GTEST_SKIP() << "the reduction fits c2 with Ceres Solver";
  const TemporaryFolder folder;
  for (const auto& [arguments, of_case] : std::vector<std::pair<std::string, std::string>>{
           {"--from plant", ""},
           {"--case " + in_data("acsr-drake-300m.toml"),
            " --case " + in_data("acsr-drake-300m.toml")},
           {"--from conductor --case " + in_data("stay-cable-sutong.toml"),
            " --case " + in_data("stay-cable-sutong.toml")}}) {
    const std::string file = begun_case_in(folder, arguments);
    for (const std::string job :
         {"margins", "response --p -557:-557:1 --d -15:0:3", "simulate --duration 0.2",
          "design --frequency 10:10:1", "max-delay --frequency 10:10:1"})
      EXPECT_EQ(run_holdfast(job + " --quiet --case '" + file + "'").output,
                run_holdfast(job + " --quiet" + of_case).output)
          << arguments << ' ' << job;
  }
}

TEST(CaseJob, EditingTheConductorOfABegunCaseChangesTheAnswer) {
  if (!both_packages) GTEST_SKIP() << "the reduction fits c2 with Ceres Solver";
  const TemporaryFolder folder;
  const std::string file = begun_case_in(folder, "");
  const std::string text = read_text(file);
  EXPECT_EQ(text.find("\n[plant]"), std::string::npos) << text;
  const std::string ask = "case --quiet --check '" + file + "'";
  const auto before = program::parse_csv(run_holdfast(ask).output, "before");
  for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
           {"\nspan = 6.4 ", "\nspan = 5.0 "}, {"\nspan = 6.4 ", "\nspan = 4.5 "}}) {
    std::string edited = text;
    edited.replace(edited.find(from), from.size(), to);
    write_text(file, edited);
    const auto after = program::parse_csv(run_holdfast(ask).output, "after");
    for (const std::string key : {"plant.conductor_stiffness", "spectral_radius"})
      EXPECT_NE(number_told(after, key), number_told(before, key)) << to << key;
  }
}

TEST(CaseJob, BeginsAPlantAloneWhereThatIsAskedForOrGiven) {
  const TemporaryFolder folder;
  for (const std::string arguments : {"--from plant", "--set plant.absorber_mass=0.2"}) {
    const std::string text = read_text(begun_case_in(folder, arguments));
    EXPECT_NE(text.find("\n[plant]"), std::string::npos) << text;
    EXPECT_EQ(text.find("\n[conductor]"), std::string::npos) << text;
  }
}

TEST(CaseJob, BeginsAWindInPlaceOfTheForce) {
  const TemporaryFolder folder;
  const std::string file = begun_case_in(folder, "--from plant --wind");
  const auto table = table_of("case --check '" + file + "'");
  EXPECT_NEAR(number_told(table, "force_frequency"), 10.0, 0.1) << "that of the force";
  EXPECT_EQ(read_text(file).find("\nfrequency = "), std::string::npos);
  expect_refused("case --wind", {"--init"});
  expect_refused("case --from plant", {"--init"});
}

TEST(CaseJob, AConductorThatContradictsItsPlantIsNamedInEveryAnswer) {
  const TemporaryFolder folder;
  const std::string file = (folder / "both.toml").string();
  const std::string plant = read_text(begun_case_in(folder, "--from plant"));
  write_text(file, plant + "[conductor]\nsag = 0.5\n");
  const std::string asked = " --case '" + file + "'";
  for (const std::string job : {"margins", "modes --count 1", "answers",
                                "sweep --axis backlash.width=0.001 --duration 0.1"}) {
    const Outcome outcome = run_holdfast(job + asked);
    EXPECT_NE(outcome.errors.find("it is not theirs: k1 50.3 instead"), std::string::npos)
        << job << outcome.errors;
    if (job == "answers") {
      EXPECT_NE(lines_of(outcome.output).at(1).find("it is not theirs"), std::string::npos);
    }
  }
  write_text(file, plant + "[conductor]\nsag = 0.29\n");
  EXPECT_EQ(run_holdfast("margins" + asked).errors, "");
}

TEST(Plausibility, IsDoubtedByEveryKindOfJobAndOnTheFirstLineOfTheAnswers) {
  for (const std::string job :
       {"stability --p -557:-557:1 --d -13:-13:1", "simulate --duration 0.1", "modes --count 1",
        "case", "answers", "sweep --axis plant.absorber_mass=0.16 --duration 0.1"}) {
    const Outcome outcome = run_holdfast(job + " --set backlash.width=0.5");
    EXPECT_EQ(outcome.exit_code, 0) << job << outcome.errors;
    EXPECT_EQ(outcome.error_lines(), 1U) << job << outcome.errors;
    EXPECT_NE(outcome.errors.find("is it in mm"), std::string::npos) << job << outcome.errors;
    if (job == "answers") {
      EXPECT_NE(lines_of(outcome.output).at(1).find("is it in mm"), std::string::npos);
    }
  }
}

TEST(Plausibility, ARecordInMillimetresIsNamedAsSuch) {
  if (!both_packages) GTEST_SKIP() << "needs Ceres Solver";
  const TemporaryFolder folder;
  const std::string data = std::string(HOLDFAST_SOURCE_DIR) + "/data/kollar2022-decay.csv";
  EXPECT_EQ(run_holdfast("fit --data '" + data + "'").errors, "");
  const auto record = program::parse_csv(read_text(data), "decay");
  std::string text = "time_s,displacement_m\n";
  for (std::size_t row = 0; row < record.rows(); ++row)
    text += record.text(row, "time_s") + "," +
            std::to_string(1e3 * record.number(row, "displacement_m")) + "\n";
  const std::string file = (folder / "in-mm.csv").string();
  write_text(file, text);
  const Outcome outcome = run_holdfast("fit --data '" + file + "'");
  EXPECT_NE(outcome.errors.find("in-mm.csv: displacement_m reaches"), std::string::npos);
  EXPECT_NE(outcome.errors.find("is it in mm"), std::string::npos) << outcome.errors;
}

}  // namespace
}  // namespace holdfast::tests
