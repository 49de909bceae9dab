#include "cli/program.hpp"

namespace holdfast::tests {
namespace {

TEST(WrongInput, UnknownKeysComeWithTheNearestKnownOne) {
  expect_refused("simulate --set control.sampling_perod=0.1", {"control.sampling_period"});
  const TemporaryFolder folder;
  std::ofstream(folder / "case.toml") << "[backlash]\nwidht = 0.001\n";
  expect_refused("simulate --case '" + (folder / "case.toml").string() + "'",
                 {"case.toml:2", "width"});
  expect_refused("simulate --case '" + (folder / "absent.toml").string() + "'", {"absent.toml"});
}

TEST(WrongInput, OptionsAreNamedWithWhatWasExpected) {
  expect_refused("stability --p 5:1:10", {"--p"});
  expect_refused("stability --p 0:1:0", {"--p"});
  expect_refused("stability --d 1:2", {"MIN:MAX:COUNT"});
  expect_refused("boundary --p 3:3", {"proportional gains"});
  expect_refused("max-delay --criterion quick", {"criterion"});
  expect_refused("stability --axis control.sampling_period=0.001:0.01:2", {"two keys"});
  expect_refused("stability --axis backlash.width=0:1:2 --axis plant.absorber_mass=0.1:0.2:3",
                 {"does not depend on backlash.width"});
  expect_refused("stability --axis plant.conductor_mass=0:1:2 --axis plant.absorber_mass=0.1:0.2:3",
                 {"greater than 0"});
  expect_refused("stability --axis control.processing_delay=0:1:2 --axis plant.absorber_mass=1:2:3",
                 {"processing delay"});
  expect_refused("stability --p 0:1:2 --axis plant.absorber_mass=1:2:3", {"excludes"});
  expect_refused("max-delay --frequency 0:5:3", {"frequency"});
  expect_refused("simulate --from nan", {"from"});
  expect_refused("simulate --kick nan:1", {"--kick"});
  expect_refused("deviation --offset nan", {"offset"});
  expect_refused("spectrum --discard inf", {"discard"});
  expect_refused("simulate --switching exakt", {"switching"});
  expect_refused("coverage --window 1:0:0:1", {"--window"});
  expect_refused("lyapunov --tangent best", {"tangent"});
  expect_refused("spectrum --duration 0.05", {"less than one period of the excitation", "0.1 s"});
  expect_refused("simulate --threads -1", {"threads"});
  expect_refused("simulate --duration 1 --kick 2:0.001", {"--kick"});
  expect_refused("report", {"--output"});
}

TEST(Output, UnwritablePlacesAreRefusedBeforeAnythingIsComputed) {
  const TemporaryFolder folder;
  expect_refused("report --output '/dev/null/report'", {"report"});
  expect_refused("simulate --output '" + (folder / "x.nc").string() + "'", {"netCDF"});
  EXPECT_TRUE(folder.names().empty());
}

TEST(Output, FileAndMetadataAppearTogether) {
  const TemporaryFolder folder;
  printed_by("simulate --duration 0.1 --output '" + (folder / "motion.csv").string() + "'");
  std::vector<std::string> names = folder.names();
  std::sort(names.begin(), names.end());
  EXPECT_EQ(names, (std::vector<std::string>{"motion.csv", "motion.csv-metadata.json"}));
  expect_holds(read_text(folder / "motion.csv-metadata.json"), {"\"sampling_period\": 0.001"});
}

TEST(NoAnswer, DivergingMotionSaysWhenAndLeavesNoFile) {
  const TemporaryFolder folder;
  expect_refused(
      "simulate --duration 1000 --set control.sampling_period=0.011 --set "
      "control.processing_delay=0.011 "
      "--output '" +
          (folder / "motion.csv").string() + "'",
      {"diverges"}, 1);
  EXPECT_TRUE(folder.names().empty());
}

TEST(Faults, AHugeRequestIsRefusedBeforeItIsMade) {
  expect_refused("diagram --axis nosuch.key=0:1:1000000000", {"unknown key"});
  expect_refused("diagram --axis backlash.width=0:0.003:1000000000", {"at most 1000000"});
  if (both_packages)
    expect_refused("margins --set reduction.first_frequency=3.68e-10", {"periods of the cable"}, 1);
}

TEST(Faults, ALongMessageIsCut) {
  const Outcome outcome = run_holdfast("margins --set " + std::string(100000, 'x') + "=1");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_LT(outcome.errors.size(), 2000U);
}

TEST(PaperReport, OfAShortRecordShowsWhatItReachesAndSaysWhyNotTheRest) {
  const TemporaryFolder folder;
  const std::string record = (folder / "short.csv").string();
  write_text(record, "time_s,force_N\n0,0\n0.2,0.3\n0.45,0\n");
  printed_by("report --set excitation.record=" + record + " --output '" +
             (folder / "mine").string() + "'");
  const std::string page = read_text(folder / "mine/report.html");
  expect_holds(page, {"No picture: ", "ends at", "id=\"stability\""});
}

/// Work without an end in sight is named instead of begun.
TEST(NoAnswer, MotionsOfMoreSamplesThanAreFollowed) {
  const std::string fast = " --set control.sampling_period=1e-12";
  for (const std::string job :
       {"simulate --duration 1", "deviation", "coverage", "section", "lyapunov", "spectrum",
        "answers", "diagram --axis backlash.width=0:0.001:2"}) {
    expect_refused(job + fast + " --quiet", {"samples, more than the limit of 1e+10"}, 1);
  }
  expect_said("sweep --axis backlash.width=0:0.001:2 --metric outcome" + fast,
              {"samples, more than"});
  expect_refused("simulate --duration 20000", {"20000001 rows", "--yes"});
  expect_refused("deviation --duration 20000", {"20000001 rows", "--yes"});
}

}  // namespace
}  // namespace holdfast::tests
