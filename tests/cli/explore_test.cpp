#include "cli/program.hpp"

namespace holdfast::tests {
namespace {

namespace fs = std::filesystem;

/// The program in a place of its own, with a page beside it as it is installed, or without one.
class InstalledProgram {
 public:
  explicit InstalledProgram(const std::string& page) {
    fs::create_directories(folder_ / "bin");
    fs::create_directories(folder_ / "share/holdfast");
    fs::copy_file(HOLDFAST_PROGRAM, folder_ / "bin/holdfast");
    if (!page.empty()) write_text(folder_ / "share/holdfast/explorer.html", page);
  }

  Outcome run(const std::string& arguments) const {
    return run_holdfast(arguments, "", folder_.path().string(), "bin/holdfast");
  }

  fs::path operator/(const std::string& name) const { return folder_ / name; }

 private:
  TemporaryFolder folder_;
};

constexpr const char* skeleton = R"(<script id="case-of-page">{"name":"","text":""}</script>)";

TEST(ExploreJob, PutsTheCaseIntoThePage) {
  const InstalledProgram program(skeleton);
  write_text(program / "mine.toml",
             "# </script><script>alert(1)</script>\n[control]\ndifferential_gain = -9.0\n");
  ASSERT_EQ(program.run("explore --case mine.toml --output page.html").exit_code, 0);
  const std::string page = read_text(program / "page.html");
  expect_holds(page, {R"("name":"mine.toml")", "differential_gain = -9.0"});
  EXPECT_EQ(page.find("</script><script>"), std::string::npos) << page;
}

TEST(ExploreJob, OfTheBuiltInCaseIsThePageAsItIs) {
  const InstalledProgram program(skeleton);
  ASSERT_EQ(program.run("explore --output page.html").exit_code, 0);
  EXPECT_EQ(read_text(program / "page.html"), skeleton);
}

TEST(ExploreJob, WithValuesSetThePageHasTheWholeCase) {
  const InstalledProgram program(skeleton);
  ASSERT_EQ(program.run("explore --set backlash.width=0.0007 --output page.html").exit_code, 0);
  const std::string page = read_text(program / "page.html");
  expect_holds(page, {"width = 7e-04", "conductor_mass"});
}

TEST(ExploreJob, SaysWhatIsMissingWhereThePageWasNotBuilt) {
  const InstalledProgram program("");
  const Outcome outcome = program.run("explore --output page.html");
  EXPECT_EQ(outcome.exit_code, 1);
  expect_holds(outcome.errors, {"was not built", "./run --explorer"});
  EXPECT_FALSE(fs::exists(program / "page.html"));
}

TEST(ExploreJob, RefusesWhatIsNoPageAndCasesOfSeveralFiles) {
  const InstalledProgram program(skeleton);
  write_text(program / "force.csv", "time_s,force_N\n0,0\n1,1\n");
  const auto expect_refusal = [&](const std::string& arguments, const std::string& mentioned) {
    const Outcome outcome = program.run(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    expect_holds(outcome.errors, {mentioned});
  };
  expect_refusal("explore", "--output FILE.html is needed");
  expect_refusal("explore --output page.csv", "let its name end in .html");
  expect_refusal("explore --set excitation.record=force.csv --output page.html",
                 "cannot include a recorded force");
  expect_refusal(
      "explore --set device.1.kind=dashpot --set device.1.position=0.5 --set device.1.damping=1 "
      "--output page.html",
      "[[device]]");
  expect_refusal("explore --set plant.model=string --set plant.absorber_mass=0 --output page.html",
                 "absorber");
}

// A browser has no package to fit the damping with.
TEST(ExploreJob, APlantThatIsReducedStandsInThePage) {
  if (!both_packages) GTEST_SKIP() << "the fit needs Ceres Solver";
  const InstalledProgram program(skeleton);
  const std::string line = HOLDFAST_SOURCE_DIR "/data/acsr-drake-300m.toml";
  ASSERT_EQ(program.run("explore --case '" + line + "' --output page.html").exit_code, 0);
  EXPECT_EQ(read_text(line).find("conductor_mass = "), std::string::npos);
  expect_holds(read_text(program / "page.html"), {"conductor_mass = "});
}

}  // namespace
}  // namespace holdfast::tests
