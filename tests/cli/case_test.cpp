#include "cli/program.hpp"
#include "holdfast/plant/free_decay.hpp"
#include "holdfast/plant/two_mass.hpp"

namespace holdfast::tests {
namespace {

/// A cell of the row of a key in what `case --check` writes.
std::string told(const program::CsvTable& table, const std::string& key,
                 const std::string& column) {
  return table.text(row_of(table, key, "key"), column);
}

double number_told(const program::CsvTable& table, const std::string& key) {
  return table.number(row_of(table, key, "key"), "value");
}

TEST(CaseJob, BeginsAFileThatIsTheSameCase) {
  const TemporaryFolder folder;
  const std::string file = (folder / "my cable.toml").string();
  EXPECT_EQ(
      printed_by("case --from plant --set control.sampling_period=0.004 --init '" + file + "'"),
      "");
  const std::string text = read_text(file);
  expect_holds(text, {"sampling_period = 0.004", "# N/m, stiffness k1"});
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
  const TextFile file("# mine\n");
  expect_refused("case --init '" + file.path() + "'", {"already"});
  EXPECT_EQ(read_text(file.path()), "# mine\n");
}

TEST(CaseJob, TellsWhereEachValueComesFrom) {
  const TextFile file("[control]\nsampling_period = 0.01\n[backlash]\nwidth = 0.002\n");
  const auto table = table_of("case --check '" + file.path() + "' --set backlash.width=0.001");
  EXPECT_EQ(told(table, "control.sampling_period", "origin"), file.path() + ":2");
  EXPECT_EQ(told(table, "backlash.width", "origin"), "--set backlash.width=0.001");
  EXPECT_EQ(told(table, "plant.conductor_mass", "origin"), "built-in");
  EXPECT_EQ(told(table, "spectral_radius", "origin"), "derived");
  expect_holds(told(table, "backlash.width", "meaning"), {"at least 0 m"});
}

TEST(CaseJob, TellsOfDevicesAndOfTheSite) {
  const TextFile file(
      "[site]\nspeeds = [1, 2]\nhours = [3, 4]\n[[device]]\nkind = \"dashpot\"\n"
      "position = 1.5\ndamping = 30\n");
  const auto table = table_of("case --check '" + file.path() + "' --set device.1.damping=20");
  EXPECT_EQ(told(table, "site.speeds", "value"), "[1.0, 2.0]");
  EXPECT_EQ(told(table, "device.1.position", "origin"), file.path() + ":6");
  EXPECT_EQ(told(table, "device.1.damping", "value"), "20.0");
  EXPECT_EQ(told(table, "device.1.damping", "origin"), "--set device.1.damping=20");
  EXPECT_EQ(told(table, "device.1.damping", "unit"), "N s/m");
  EXPECT_EQ(told(table, "device.1.to", "origin"), "default");
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
  expect_holds(run_holdfast(device).errors, {"cannot read"});
  write_text(csv, "frequency_Hz,magnitude_N_s_per_m,phase_deg\n5,3,-1.5\n6,3,1.2\n");
  expect_said(device, {"are the phases in radians?"});
  EXPECT_EQ(run_holdfast(device + " --output '" + csv + "'").exit_code, 2);
  write_text(csv, "frequency_Hz,magnitude_N_s_per_m,phase_deg\n5,3,0\n6,3,120\n");
  expect_refused(device, {"gives no power"});
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
    expect_refused(job + bare, {"plant.absorber_mass = 0: this job needs"});
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
    expect_refused(arguments, {});
  }
}

TEST(CaseJob, AGivenKeyOfThePlantGoesOverTheReduction) {
  if (!both_packages) GTEST_SKIP() << "the reduction fits c2 with Ceres Solver";
  const std::string drake =
      "case --case '" + std::string(HOLDFAST_SOURCE_DIR) + "/data/acsr-drake-300m.toml' ";
  const auto reduced = program::parse_csv(run_holdfast(drake).output, "reduced");
  const Outcome outcome = run_holdfast(drake + "--set plant.absorber_damping=50");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  expect_holds(outcome.errors, {"reduced from the conductor"});
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
  printed_by("case " + arguments + " --quiet --init '" + file + "'");
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

/// A begun case with lines of it taken out of their comments and changed.
std::string edited(std::string text,
                   const std::vector<std::pair<std::string, std::string>>& lines) {
  for (const auto& [key, value] : lines) {
    const std::string from = "\n# " + key + " = ";
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << key << text;
    const std::size_t end = text.find(" #", at + from.size());
    text.replace(at, end - at, "\n" + key + " = " + value);
  }
  return text;
}

TEST(CaseJob, ABegunCaseMakesNothingOfTheBuiltInOneTheUsers) {
  const TemporaryFolder folder;
  const std::string file = begun_case_in(folder, "");
  const std::string text = read_text(file);
  EXPECT_EQ(text.find("\n[plant]\nconductor_mass"), std::string::npos) << text;
  EXPECT_EQ(told(table_of("case --check '" + file + "'"), "conductor.span", "origin"), "built-in");
  // A name and a tension alone: the span is asked for, and neither sag nor modulus is in the way.
  write_text(file, edited(text, {{"name", "\"Drake\""}, {"tension", "\"28.02 kN\""}}));
  expect_refused("aeolian --case '" + file + "'", {"conductor.span (m)"});
  write_text(file, edited(read_text(file), {{"span", "\"300 m\""}}));
  const auto table = table_of("case --check '" + file + "'");
  EXPECT_EQ(told(table, "conductor.area", "origin"), "conductor library");
  EXPECT_EQ(told(table, "conductor.sag", "origin"), "follows from conductor.tension");
  EXPECT_EQ(told(table, "conductor.gravity", "origin"), "default");
  EXPECT_EQ(told(table, "plant.conductor_mass", "origin"), "not given");
  EXPECT_EQ(told(table, "control.proportional_gain", "value"), "0.0");
  const auto vibration = table_of("aeolian --frequency 20:20:1 --case '" + file + "'");
  const auto by_options = table_of(
      "aeolian --quiet --frequency 20:20:1 --set conductor.name=Drake --set conductor.span=300 "
      "--set conductor.tension=28020");
  EXPECT_EQ(vibration.text(0, "amplitude_bare_m"), by_options.text(0, "amplitude_bare_m"));
  EXPECT_EQ(vibration.text(0, "amplitude_m"), vibration.text(0, "amplitude_bare_m"));
  expect_refused("margins --case '" + file + "'", {"absorber.mass (kg)"});
}

TEST(CaseJob, OfAStringTellsOfNoConductorsMassThatItIsComputed) {
  const auto table = program::parse_csv(
      run_holdfast("case --quiet --set plant.model=string --set conductor.tension=7.5").output,
      "case");
  EXPECT_EQ(told(table, "plant.conductor_mass", "origin"), "built-in");
  EXPECT_EQ(told(table, "conductor.sag", "origin"), "follows from conductor.tension");
}

/// The nine commands of an engineer of stays, who has a dashpot and no absorber.
TEST(OwnCase, AStayWithADashpotIsAnsweredByWhatItGives) {
  const TextFile file(
      "[conductor]\nmass_per_length = 60\nspan = 180\ntension = \"3 MN\"\n"
      "damping_ratio = 0.001\n[[device]]\nkind = \"dashpot\"\nposition = 3.6\n"
      "damping = 120000\n");
  const std::string of_stay = file.as_case();
  for (const std::string job :
       {"case", "modal-damping --quiet --count 3", "absorption --frequency 1:3:3", "answers"}) {
    const Outcome outcome = run_holdfast(job + of_stay);
    EXPECT_EQ(outcome.exit_code, 0) << job << outcome.errors;
    EXPECT_EQ(outcome.errors, "") << job;
    EXPECT_EQ(outcome.output.find("built-in"), std::string::npos) << job << outcome.output;
  }
  const auto modes = table_of("modal-damping --quiet --count 1" + of_stay);
  // Of a taut string: c/(2 L), and at most half of the damper's share of the length beside its own.
  EXPECT_NEAR(modes.number(0, "frequency_Hz"), std::sqrt(3e6 / 60) / 360, 1e-9);
  EXPECT_GT(modes.number(0, "damping_ratio"), 0.001);
  EXPECT_LT(modes.number(0, "damping_ratio"), 0.001 + 0.51 * 3.6 / 180);
  expect_refused("aeolian" + of_stay, {"conductor.diameter (m)"});
  expect_refused("verdict" + of_stay, {"[[device]]", "remove the [[device]] tables"});
  expect_refused("margins" + of_stay, {"absorber.mass (kg)"});
}

TEST(OwnCase, ANumberWithAUnitOfSomethingElseIsRefusedWithThoseThatWouldDo) {
  expect_refused("case --set 'conductor.tension=28.2 kg'", {"kg is not a unit", "kN", "lbf"});
  const auto table = table_of("case --set 'control.sampling_period=2 ms'");
  EXPECT_EQ(number_told(table, "control.sampling_period"), 0.002);
}

TEST(CaseJob, BeginsAPlantAloneWhereThatIsAskedForOrGiven) {
  const TemporaryFolder folder;
  for (const std::string arguments : {"--from plant", "--set plant.absorber_mass=0.2"}) {
    const std::string text = read_text(begun_case_in(folder, arguments));
    expect_holds(text, {"\n[plant]"});
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
  const std::string control =
      "[control]\nproportional_gain = -557\ndifferential_gain = -13\nsampling_period = 0.001\n"
      "[backlash]\nwidth = 0.0005\n[excitation]\namplitude = 0.5\nfrequency = 10\n"
      "[plant]\nconductor_mass = 0.0767\nconductor_stiffness = 50.3\nconductor_damping = 0.079\n"
      "absorber_mass = 0.16\nabsorber_stiffness = 74.4\nabsorber_damping = 4\n"
      "[absorber]\nmass = 0.16\nposition = 0.64\n"
      "[reduction]\nfirst_frequency = 1.999\nsecond_frequency = 6.998\n"
      "[conductor]\nmass_per_length = 0.043\nspan = 6.4\narea = 5.5e-6\nyoungs_modulus = 18e9\n"
      "damping_ratio = 0.02\nsag = ";
  write_text(file, control + "0.5\n");
  const std::string asked = " --case '" + file + "'";
  for (const std::string job : {"margins", "modes --count 1", "answers",
                                "sweep --axis backlash.width=0.001 --duration 0.1"}) {
    const Outcome outcome = run_holdfast(job + asked);
    expect_holds(outcome.errors, {"contradict [plant]: k1 50.3 instead"});
    if (job == "answers") {
      expect_holds(lines_of(outcome.output).at(1), {"contradict [plant]"});
    }
  }
  write_text(file, control + "0.29\n");
  EXPECT_EQ(run_holdfast("margins" + asked).errors, "");
}

TEST(Plausibility, IsDoubtedByEveryKindOfJobAndOnTheFirstLineOfTheAnswers) {
  for (const std::string job :
       {"stability --p -557:-557:1 --d -13:-13:1", "simulate --duration 0.1", "modes --count 1",
        "case", "answers", "sweep --axis plant.absorber_mass=0.16 --duration 0.1"}) {
    const Outcome outcome = run_holdfast(job + " --set backlash.width=0.5");
    EXPECT_EQ(outcome.exit_code, 0) << job << outcome.errors;
    EXPECT_EQ(outcome.error_lines(), 1U) << job << outcome.errors;
    expect_holds(outcome.errors, {"did you mean mm"});
    if (job == "answers") {
      expect_holds(lines_of(outcome.output).at(1), {"did you mean mm"});
    }
  }
}

/// A decay of the paper's plant whose stamps are true and off an even step by up to 4 ms.
std::string jittering_decay(double unit_of_time, double left_out) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> jitter(-0.004, 0.004);
  std::vector<double> times = {0.0};
  for (int k = 1; k < 120; ++k) times.push_back(0.01 * k + jitter(random));
  const auto motion = free_decay(kollar2022_plant(), 0.01, times);
  std::string text = "time_s,displacement_m\n";
  for (std::size_t k = 0; k < times.size(); ++k)
    if (!(times[k] > 0.5 && times[k] < 0.5 + left_out))
      text += program::format_number(times[k] / unit_of_time) + "," +
              program::format_number(motion[k]) + "\n";
  return text;
}

TEST(Fit, TakesStampsAsTheyAreAndSaysWhatIsDoubtfulOfThem) {
  if (!both_packages) GTEST_SKIP() << "needs Ceres Solver";
  const TemporaryFolder folder;
  const std::string file = (folder / "decay.csv").string();
  const auto fitted = [&](const std::string& text, const std::string& options = "") {
    write_text(file, text);
    return run_holdfast("fit --data '" + file + "'" + options);
  };
  for (const double left_out : {0.0, 0.3}) {
    const Outcome outcome = fitted(jittering_decay(1.0, left_out));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
    EXPECT_EQ(outcome.errors.find("a gap of 0.3") != std::string::npos, left_out > 0.0)
        << outcome.errors;
    EXPECT_NEAR(program::parse_csv(outcome.output, "fit").number(0, "value"),
                kollar2022_plant().absorber_damping, 1e-6);
  }
  const Outcome peaks = fitted(jittering_decay(1.0, 0.3), " --target peak");
  EXPECT_EQ(peaks.exit_code, 2);
  expect_holds(peaks.errors, {"--target history"});
  const Outcome slow = fitted(jittering_decay(1e-3, 0.0));
  expect_holds(slow.errors, {"is time_s in ms?"});
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
  expect_said("fit --data '" + file + "'", {"in-mm.csv: displacement_m reaches", "in mm (0.00"});
}

}  // namespace
}  // namespace holdfast::tests
