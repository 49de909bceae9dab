#include <nlohmann/json.hpp>

#include "cli/program.hpp"
#include "cli/running_program.hpp"
#include "io/file/folder_lock.hpp"
#include "report/figures/figure.hpp"
#include "support/other_gnuplot.hpp"

namespace holdfast::tests {
namespace {

namespace fs = std::filesystem;
using program::gnuplot_available;

/// A line with a dashpot, and the wind of its site.
const std::string damped_line =
    " --set conductor.name=Drake --set conductor.span=300 --set conductor.tension=28020 --set "
    "plant.model=string --set device.1.kind=dashpot --set device.1.position=1 --set "
    "device.1.damping=300 --set site.weibull_scale=5";

/// Each table that has a picture, soon made.
const std::vector<std::string> drawn_commands = {
    "statics --elements 10 --force -0.5:0.5:3",
    "stability --p -600:0:11 --d -20:0:11",
    "stability --p -600:0:11 --d -20:0:11 --continuous",
    "stability --p -600:0:11 --d -20:0:11 --radius",
    "stability --p -600:0:11 --d -20:0:11 --prove --undecided 0.01",
    "stability --p -600:0:11 --d -20:0:11 --prove --undecided 0.01 --set plant.model=string",
    "stability --axis control.sampling_period=0.001:0.03:11 --axis plant.absorber_mass=0.1:0.2:5",
    "boundary",
    "boundary --continuous --p -500:100",
    "response --p -600:0:11 --d -20:0:11",
    "design --frequency 5:15:4",
    "max-delay --frequency 5:6:3",
    "modal-damping --set plant.model=string --set plant.modes=9",
    "absorption --frequency 5:50:10" + damped_line,
    "aeolian --frequency 5:50:10" + damped_line,
    "aeolian --frequency 5:50:10 --set plant.model=string --set conductor.diameter=0.03",
    "fatigue --by-speed --frequency 5:50" + damped_line,
    "simulate --duration 0.5",
    "simulate --duration 0.5 --switching exact --no-control",
    "spectrum --duration 2",
    "deviation --duration 1",
    "basins --axis initial.z1=0:0.001:3 --axis initial.v2=0:0.1:3",
    "basins --map backlash.width=0.001:0.002:3 --map control.sampling_period=0.01:0.011:2",
    "orbit --map backlash.width=0.0004:0.0012 --map control.differential_gain=-14:-12",
    "diagram --axis backlash.width=0:0.001:3 --transient 1 --strobes 5",
    "diagram --axis control.differential_gain=-14:-12:3 --transient 1 --strobes 5",
    "section --duration 2 --from 1",
    "lyapunov --history --duration 1",
    "sweep --axis backlash.width=0:0.003:4 --duration 1",
    "sweep --axis control.sampling_period=0.001,0.002,0.01 --duration 1 --metric verdict",
    "sweep --axis control.sampling_period=log:0.001:0.1:4 --axis backlash.width=0:0.003:3 "
    "--duration 1",
};

/// What a file of such a name begins and ends with, line ends left out.
struct Format {
  std::string ending, beginning, end;
};
const std::vector<Format> formats = {
    {".svg", "<?xml", "</svg>"},
    {".png", "\x89PNG\r\n\x1a\n", "IEND\xae\x42\x60\x82"},
    {".pdf", "%PDF-", "%%EOF"},
};

std::size_t entries_of(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), {}));
}

Outcome draw(const std::string& command, const fs::path& file) {
  return run_holdfast(command + " --output '" + file.string() + "'");
}

/// Before a script: asked for its version, as the program does first, such a gnuplot is there.
const std::string has_version = "[ \"$4\" = --version ] && exit 0\n";

TEST(Pictures, OfEveryTableThatHasOneAreWholeAndTellTheirOrigin) {
  if (!gnuplot_available()) GTEST_SKIP() << "without gnuplot";
  const TextFile named("[backlash]\nwidth = 0.001\n", "it's_my @ahead@ line.toml");
  for (const std::string& command : drawn_commands) {
    for (const Format& format : formats) {
      const TemporaryFolder folder;
      const std::string name = "picture" + format.ending;
      const Outcome outcome =
          draw(command + " --quiet --case \"" + named.path() + "\"", folder / name);
      ASSERT_EQ(outcome.exit_code, 0) << command << outcome.errors;
      EXPECT_EQ(outcome.output + outcome.errors, "") << command;
      const std::string bytes = read_text(folder / name);
      EXPECT_EQ(bytes.substr(0, format.beginning.size()), format.beginning) << command;
      const std::size_t last = bytes.find_last_not_of("\r\n");
      ASSERT_GE(last, format.end.size()) << command;
      EXPECT_EQ(bytes.substr(last + 1 - format.end.size(), format.end.size()), format.end);
      EXPECT_EQ(entries_of(folder.path()), 2U) << command;
      const auto json = nlohmann::json::parse(read_text(folder / (name + "-metadata.json")));
      const auto& origin = json.at("notes").at(0).at("holdfast");
      EXPECT_EQ(json.at("url"), name);
      EXPECT_EQ(origin.at("job"), command.substr(0, command.find(' ')));
      EXPECT_EQ(origin.at("picture").at("bytes"), bytes.size());
      EXPECT_TRUE(origin.at("case").contains("plant")) << command;
      if (format.ending != ".svg") continue;
      expect_holds(bytes, {"my @ahead@ line", "("});  // the case's name, and units of the axes
      EXPECT_EQ(bytes.find("{/:"), std::string::npos) << command;
    }
  }
}

TEST(Pictures, AreTheSameForTheSameQuestion) {
  if (!gnuplot_available()) GTEST_SKIP() << "without gnuplot";
  const TemporaryFolder folder;
  for (const Format& format : formats) {
    const std::string ending = format.ending;
    ASSERT_EQ(draw("simulate --duration 0.5", folder / ("a" + ending)).exit_code, 0);
    ASSERT_EQ(draw("simulate --duration 0.5", folder / ("b" + ending)).exit_code, 0);
    EXPECT_EQ(read_text(folder / ("a" + ending)), read_text(folder / ("b" + ending)));
  }
  EXPECT_NE(read_text(folder / "a.pdf").find("(D:19700101000000"), std::string::npos);
}

/// The commands of a gnuplot script from the labels on, which do not name the picture.
std::string plotted(const std::string& script) { return script.substr(script.find("set xlabel")); }

TEST(Pictures, AreDrawnAsTheReportDrawsSuchATable) {
  // fig04a of the report: the same gains in another case.
  const TemporaryFolder folder;
  const fs::path kept = folder / "script.gp";
  const OtherGnuplot keeping(has_version + "cp \"$4\" '" + kept.string() +
                             "'; printf '<svg></svg>'\n");
  for (const std::string command : {"stability --p -1000:200:241 --d -40:20:241"}) {
    ASSERT_EQ(draw(command, folder / "a.svg").exit_code, 0);
    for (const program::Figure& figure : program::listed_figures("paper")) {
      if (figure.name != "fig04a") continue;
      std::string expected = plotted(gnuplot_script(figure));
      for (std::size_t at = 0; (at = expected.find("fig04a", at)) != std::string::npos;)
        expected.replace(at, 6, "stability");
      EXPECT_EQ(plotted(read_text(kept)), expected);
    }
  }
}

TEST(Pictures, ThatGnuplotCannotDrawLeaveNothing) {
  for (const std::string script :
       {"printf '<svg></svg>'; echo 'no such thing' >&2; exit 3\n", "printf '<svg><path'\n"}) {
    const OtherGnuplot failing(has_version + script);
    for (const Format& format : formats) {
      const TemporaryFolder folder;
      const Outcome outcome = draw("simulate --duration 0.1", folder / ("a" + format.ending));
      EXPECT_EQ(outcome.exit_code, 1) << outcome.errors;
      EXPECT_EQ(outcome.error_lines(), 1U) << outcome.errors;
      expect_holds(outcome.errors, {"gnuplot"});
      EXPECT_EQ(entries_of(folder.path()), 0U);
    }
  }
}

TEST(Pictures, WithoutGnuplotSayWhatToInstallAndComputeNothing) {
  const TemporaryFolder empty, folder;
  const Variable nowhere("PATH", empty.path().string());
  const Outcome outcome = draw("simulate --duration 1e9", folder / "a.png");
  EXPECT_EQ(outcome.exit_code, 1);
  expect_holds(outcome.errors, {"gnuplot-nox"});
  EXPECT_EQ(entries_of(folder.path()), 0U);
}

TEST(Pictures, AreRefusedWhereATableHasNone) {
  const TemporaryFolder folder;
  for (const std::string& command : std::vector<std::string>{
           "reduce", "margins", "answers", "boundary --regions", "boundary --stable-interval",
           "lyapunov --duration 1", "fatigue" + damped_line, "design", "design --band 9:11",
           "basins --fractions", "orbit", "sweep --dry-run --axis backlash.width=0:1:3",
           "stability --p -557 --d -20:0:11",
           "sweep --axis backlash.width=0:1:3 --axis initial.z1=0:1:3 --axis initial.z2=0:1:3",
           "sweep --axis backlash.width=0,1,3 --axis initial.z1=0:1:3"}) {
    expect_refused(command + " --output '" + (folder / "a.svg").string() + "'", {});
    EXPECT_EQ(entries_of(folder.path()), 0U) << command;
  }
}

/// What a killed picture left goes with the next one; what somebody else has put there, and what a
/// link points to, stays.
TEST(Pictures, WhatAKilledOneLeftGoesAndAUsersFilesStay) {
  if (!gnuplot_available()) GTEST_SKIP() << "no gnuplot";
  const TemporaryFolder scratch, folder, elsewhere;
  std::ofstream(elsewhere / "thesis.csv") << "years of work";
  const auto leave = [&](const std::string& name) {
    const fs::path left = scratch / name;
    for (const char* part : {"data", "pictures"}) fs::create_directories(left / part);
    std::ofstream(left / program::FolderLock::file_name);
    std::ofstream(left / "data" / "a.csv") << "1";
    std::ofstream(left / "pictures" / "a.gp") << "plot";
    return left;
  };
  const fs::path left = leave("holdfast-picture-aaaaaa"), used = leave("holdfast-picture-bbbbbb");
  std::ofstream(used / "data" / "chapter.txt") << "mine";
  fs::create_symlink(elsewhere / "thesis.csv", used / "data" / "b.csv");
  fs::create_directory_symlink(elsewhere.path(), scratch / "holdfast-picture-cccccc");
  const Variable there("TMPDIR", scratch.path().string());
  const Outcome outcome = draw("simulate --duration 0.1", folder / "a.svg");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_FALSE(fs::exists(left));
  EXPECT_EQ(read_text(used / "data" / "chapter.txt"), "mine");
  EXPECT_EQ(read_text(elsewhere / "thesis.csv"), "years of work");
  EXPECT_EQ(entries_of(elsewhere.path()), 1U);
}

/// An interrupted report leaves no empty folders.
TEST(Pictures, AnInterruptedReportLeavesNoEmptyFolders) {
  const TemporaryFolder folder;
  const fs::path report = folder / "deep" / "report";
  RunningProgram running({"report", "--quiet", "--output", report.string()});
  while (running.runs() && !fs::exists(report / "pictures"))
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  running.send(SIGINT);
  EXPECT_EQ(running.wait().exit_code, 130);
  for (const auto& entry : fs::recursive_directory_iterator(folder.path()))
    EXPECT_TRUE(!entry.is_directory() || !fs::is_empty(entry.path())) << entry.path();
}

/// A table whose metadata cannot appear does not either.
TEST(Pictures, ATableWhoseMetadataCannotAppearIsNone) {
  const TemporaryFolder folder;
  fs::create_directories(folder / "a.csv-metadata.json" / "full");
  expect_refused("simulate --quiet --duration 0.01 --output '" + (folder / "a.csv").string() + "'",
                 {});
  EXPECT_EQ(entries_of(folder.path()), 1U);
}

}  // namespace
}  // namespace holdfast::tests
