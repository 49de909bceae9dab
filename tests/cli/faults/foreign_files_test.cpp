#include <sys/stat.h>

#include "cli/program.hpp"
#include "cli/running_program.hpp"

// Files that came from others, or that are none of the program's business: it does not fall over
// them, tell what stands in them, hang on them or remove them.

namespace holdfast::tests {
namespace {

namespace fs = std::filesystem;

std::string repeated(const std::string& part, std::size_t times) {
  std::string text;
  for (std::size_t k = 0; k < times; ++k) text += part;
  return text;
}

Ending ending_of(const std::vector<std::string>& words, const std::string& surroundings = "") {
  return RunningProgram(words, surroundings).wait_at_most();
}

// ---- what is too deep or too wide ---------------------------------------------------------------

TEST(ForeignFiles, ACaseThatIsNestedWithoutEndIsRefusedWithItsLine) {
  const TemporaryFolder folder;
  const std::string file = (folder / "deep.toml").string();
  for (const std::string& deep :
       {"a" + repeated(".a", 50'000) + " = 1\n", "[a" + repeated(".a", 50'000) + "]\n",
        "x = " + repeated("[", 50'000) + "\n", "x = " + repeated("{a=", 50'000) + "\n"}) {
    write_text(file, "[control]\n" + deep);
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"margins", "--case", file},
          std::vector<std::string>{"case", "--check", file}}) {
      const Ending ending = ending_of(words);
      EXPECT_EQ(ending.exit_code, 2) << deep.substr(0, 20) << ending.ended_by_signal;
      EXPECT_EQ(ending.errors.rfind("holdfast: " + file + ":2: ", 0), 0U) << ending.errors;
    }
    const Ending ending =
        ending_of({"margins", "--set", "backlash.width=1\n" + deep.substr(0, 100'000)});
    EXPECT_EQ(ending.exit_code, 2) << deep.substr(0, 20) << ending.ended_by_signal;
  }
}

// By comparing each name with each this took many minutes of a processor.
TEST(ForeignFiles, AHeaderOfAMillionColumnsIsReadInOneGo) {
  const TemporaryFolder folder;
  std::string header = "time_s,force_N";
  for (int column = 0; column < 1'000'000; ++column) header += ",c" + std::to_string(column);
  write_text(folder / "wide.csv", header + "\n");
  const Ending ending = ending_of(
      {"margins", "--set", "excitation.record=" + (folder / "wide.csv").string()}, "ulimit -t 60");
  EXPECT_EQ(ending.exit_code, 2) << ending.ended_by_signal;
  expect_holds(ending.errors, {"2 rows"});
}

// ---- what is secret -----------------------------------------------------------------------------

TEST(ForeignFiles, WhatIsNoRecordIsNotQuoted) {
  const TemporaryFolder folder;
  const std::string file = (folder / "shadow").string();
  for (const std::string text :
       {"root:hunter2:19000:0\nbin:hunter2:1:0\n", "hunter2,hunter2\nx,y\n", "a,hunter2\n1,2\n",
        "time_s,other\nhunter2,1\nhunter2,2\n", "other,force_N\n1,hunter2\n2,3\n",
        "other,displacement_m\n1,hunter2\n2,3\n", "a,hun\"ter2\n", "a,\"hunter2\n",
        "a,b\nhunter2\n", "a\n\"x\"hunter2\n", "hunter2", "\"hunter2\"\n\"hunter2\"\n"}) {
    write_text(file, text);
    std::vector<std::vector<std::string>> readers = {
        {"margins", "--set", "excitation.record=" + file},
        {"simulate", "--duration", "0.1", "--set", "excitation.record=" + file}};
    if (both_packages) readers.push_back({"fit", "--data", file});
    for (const std::vector<std::string>& words : readers) {
      const Ending ending = ending_of(words);
      EXPECT_EQ(ending.exit_code, 2) << text;
      expect_holds(ending.errors, {file});
      EXPECT_EQ(ending.errors.find("hunter2"), std::string::npos) << ending.errors;
      EXPECT_EQ(ending.output, "");
    }
  }
}

TEST(ForeignFiles, OfARecordTheWrongCellIsShown) {
  const TemporaryFolder folder;
  const std::string file = (folder / "record.csv").string();
  write_text(file, "time_s,force_N\n0,1\n1,strong\n");
  const Ending ending = ending_of({"margins", "--set", "excitation.record=" + file});
  EXPECT_EQ(ending.errors, "holdfast: " + file + ":3: force_N = \"strong\" is not a number\n");
}

// ---- what never comes ---------------------------------------------------------------------------

void expect_interrupted_while_it_waits(const std::vector<std::string>& words, int signal_number) {
  RunningProgram program(words);
  program.wait_until_it_computes(std::chrono::milliseconds(0));
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  program.send(signal_number);
  const Ending ending = program.wait_at_most();
  EXPECT_EQ(ending.exit_code, 130) << words.back();
  EXPECT_EQ(ending.errors, "holdfast: interrupted\n");
}

TEST(ForeignFiles, WaitingOnAPipeEndsWithASignal) {
  const TemporaryFolder folder;
  const std::string pipe = (folder / "pipe").string();
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  for (const bool writer : {false, true}) {  // nobody writes, or one who says nothing
    const int held = writer ? open(pipe.c_str(), O_RDWR) : -1;
    for (const int signal_number : {SIGINT, SIGTERM, SIGHUP}) {
      expect_interrupted_while_it_waits({"margins", "--case", pipe}, signal_number);
      expect_interrupted_while_it_waits({"margins", "--set", "excitation.record=" + pipe},
                                        signal_number);
      if (both_packages) expect_interrupted_while_it_waits({"fit", "--data", pipe}, signal_number);
    }
    if (held >= 0) close(held);
  }
  expect_interrupted_while_it_waits({"simulate", "--output", pipe}, SIGINT);
}

// ---- what a killed run leaves -------------------------------------------------------------------

TEST(ForeignFiles, WhatAKilledRunLeavesGoesWithTheNextOfTheSameOutput) {
  const TemporaryFolder folder;
  const std::string output = (folder / "x.csv").string(), other = (folder / "y.csv").string();
  for (const std::string& file : {output, output, other}) {
    RunningProgram program({"simulate", "--yes", "--duration", "9e6", "--output", file});
    program.wait_until_it_computes(std::chrono::milliseconds(100));
    program.send(SIGKILL);
    EXPECT_EQ(program.wait().ended_by_signal, SIGKILL);
  }
  EXPECT_EQ(folder.files(), 4);  // two of each output
  write_text(folder / ".holdfast-mine.tmp", "");
  EXPECT_EQ(ending_of({"simulate", "--duration", "0.1", "--output", output}).exit_code, 0);
  EXPECT_EQ(folder.files(), 5);  // a table, its metadata, and what is not of this output
  EXPECT_EQ(ending_of({"simulate", "--duration", "0.1", "--output", other}).exit_code, 0);
  std::vector<std::string> names = folder.names();
  std::sort(names.begin(), names.end());
  EXPECT_EQ(names, (std::vector<std::string>{".holdfast-mine.tmp", "x.csv", "x.csv-metadata.json",
                                             "y.csv", "y.csv-metadata.json"}));
}

TEST(ForeignFiles, WhatAKilledSweepToTheScreenLeavesGoesWithTheNext) {
  const TemporaryFolder folder;
  const std::string there = "export TMPDIR='" + folder.path().string() + "'";
  const std::vector<std::string> sweep = words_of("sweep --axis initial.z1=0,0.001 --duration ");
  const auto lasting = [&](const char* duration) {
    std::vector<std::string> words = sweep;
    words.emplace_back(duration);
    return words;
  };
  RunningProgram running(lasting("1e6"), there), killed(lasting("1e6"), there);
  for (RunningProgram* program : {&running, &killed})
    program->wait_until_it_computes(std::chrono::milliseconds(100));
  killed.send(SIGKILL);
  killed.wait();
  EXPECT_EQ(folder.files(), 2);
  EXPECT_EQ(ending_of(lasting("0.1"), there).exit_code, 0);
  EXPECT_EQ(folder.files(), 1);  // of the one that runs
  running.send(SIGINT);
  EXPECT_EQ(running.wait().exit_code, 130);
  EXPECT_EQ(folder.files(), 0);
}

TEST(ForeignFiles, TwoRunsOfOneOutputDoNotDisturbEachOther) {
  const TemporaryFolder folder;
  const std::string output = (folder / "x.csv").string();
  RunningProgram running({"simulate", "--yes", "--duration", "9e6", "--output", output});
  running.wait_until_it_computes(std::chrono::milliseconds(100));
  EXPECT_EQ(ending_of({"simulate", "--duration", "0.1", "--output", output}).exit_code, 0);
  EXPECT_TRUE(running.runs());
  EXPECT_EQ(folder.files(), 4);
  running.send(SIGINT);
  EXPECT_EQ(running.wait().exit_code, 130);
  EXPECT_EQ(folder.files(), 2);
}

// ---- what lies in the folder of a report --------------------------------------------------------

TEST(ForeignFiles, AReportRemovesNothingThatItDidNotMake) {
  const TemporaryFolder folder;
  write_text(folder / "short.csv", "time_s,force_N\n0,0\n0.2,0.3\n0.45,0\n");
  const auto report = [&] {
    return ending_of({"report", "--quiet", "--set",
                      "excitation.record=" + (folder / "short.csv").string(), "--output",
                      (folder / "mine").string()});
  };
  ASSERT_EQ(report().exit_code, 0);
  std::vector<fs::path> precious;
  for (const auto& entry : fs::directory_iterator(folder / "mine/data")) {
    const std::string table = entry.path().string();
    if (entry.path().extension() == ".csv")
      for (const char* name : {"letter", "c.0", "zarr.json", "lock"})
        precious.emplace_back(table + ".zarr/" + name);
  }
  for (const auto& entry : fs::directory_iterator(folder / "mine/pictures")) {
    if (entry.path().extension() != ".svg") continue;
    precious.emplace_back(entry.path().string() + ".partial");
    precious.emplace_back(fs::path(entry.path()).replace_extension(".log.partial"));
  }
  EXPECT_GE(precious.size(), 40U);
  for (const fs::path& file : precious) {
    fs::create_directories(file.parent_path());
    write_text(file, "precious");
  }
  const Ending ending = report();
  EXPECT_EQ(ending.exit_code, 0) << ending.errors;
  for (const fs::path& file : precious) EXPECT_EQ(read_text(file), "precious") << file;
}

}  // namespace
}  // namespace holdfast::tests
