#include "cli/every_job.hpp"
#include "cli/running_program.hpp"

// What the surroundings of the program do to it: no memory, no space, no reader, a signal. Every
// job is to end with the right code and one line, and to leave nothing behind.

namespace holdfast::tests {
namespace {

namespace fs = std::filesystem;
using std::chrono::seconds;

std::vector<std::string> with(const std::string& job, const std::vector<std::string>& more) {
  std::vector<std::string> words = words_of(job);
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

Ending ending_of(const std::string& job, const std::vector<std::string>& more,
                 const std::string& surroundings = "") {
  return RunningProgram(with(job, more), surroundings).wait_at_most();
}

std::size_t lines_in(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

/// The right code and one line that says why.
void expect_ends(const Ending& ending, int exit_code, const std::string& mentioned) {
  EXPECT_EQ(ending.ended_by_signal, 0);
  EXPECT_EQ(ending.exit_code, exit_code) << ending.errors;
  EXPECT_EQ(lines_in(ending.errors), 1U) << ending.errors;
  EXPECT_EQ(ending.errors.rfind("holdfast: ", 0), 0U) << ending.errors;
  expect_holds(ending.errors, {mentioned});
}

TEST(Surroundings, EveryJobIsTried) {
  std::vector<std::string> tried = {"convert", "explore", "report"};  // have tests of their own
  for (const JobToTry& job : jobs_with_table) tried.push_back(job.name());
  for (const std::string& job : jobs_with_text) tried.push_back(job.substr(0, job.find(' ')));
  std::sort(tried.begin(), tried.end());
  std::vector<std::string> jobs;
  bool listed = false;
  for (const std::string& line : lines_of(run_holdfast("--help").output)) {
    listed = listed || line.rfind("What does my case say?", 0) == 0;
    if (listed && line.rfind("  ", 0) == 0 && line[2] != ' ') jobs.push_back(words_of(line)[0]);
  }
  std::sort(jobs.begin(), jobs.end());
  EXPECT_EQ(tried, jobs);
}

// ---- memory -----------------------------------------------------------------------------------

std::string address_space(int kibibytes) { return "ulimit -v " + std::to_string(kibibytes); }

/// The least address space in which the program gets as far as to tell its version, to 64 KiB.
int least_address_space() {
  int least = 1 << 20, too_little = 0;
  while (least - too_little > 64) {
    const int middle = (least + too_little) / 2;
    const bool enough = ending_of("--version", {}, address_space(middle)).exit_code == 0;
    (enough ? least : too_little) = middle;
  }
  return least;
}

TEST(Surroundings, WithoutMemoryAJobSaysSoOrIsDone) {
  if (is_sanitized) GTEST_SKIP() << "a sanitizer reserves all addresses";
  const int least = least_address_space();
  for (const JobToTry& job : tables_to_try()) {
    for (const int more : {0, 192, 512, 1200, 3000, 8000}) {
      SCOPED_TRACE(job.quick + " with " + std::to_string(least + more) + " KiB");
      const Ending ending = ending_of(job.quick, {"--quiet"}, address_space(least + more));
      if (ending.exit_code == 0) break;
      expect_ends(ending, 1, "");
    }
  }
}

TEST(Surroundings, ALargeDecayWithoutMemoryForItsMatrixSaysSo) {
  if (is_sanitized) GTEST_SKIP() << "a sanitizer reserves all addresses";
  if (!both_packages) GTEST_SKIP() << "without SUNDIALS";
  const std::string decay = "decay --elements 20000 --duration 0.001";
  const int least = least_address_space();
  for (int more = 20 << 10; more < 52 << 10; more += 2 << 10) {
    SCOPED_TRACE(std::to_string(least + more) + " KiB");
    const Ending ending = ending_of(decay, {}, address_space(least + more));
    if (ending.exit_code == 0) return;
    expect_ends(ending, 1, "memory");
  }
}

// ---- space ------------------------------------------------------------------------------------

TEST(Surroundings, AFileBeyondTheSizeLimitIsReportedAndLeavesNothing) {
  for (const JobToTry& job : tables_to_try()) {
    SCOPED_TRACE(job.quick);
    const TemporaryFolder folder;
    const std::string file = (folder / "table.csv").string();
    expect_ends(ending_of(job.quick, {"--quiet", "--output", file}, "ulimit -f 1"), 1,
                "File too large");
    EXPECT_EQ(folder.names(), std::vector<std::string>{});
  }
  const TemporaryFolder folder;
  const std::string file = (folder / "table.csv").string();
  expect_ends(ending_of("simulate", {"--output", file}, "ulimit -f 200"), 1, "File too large");
  EXPECT_EQ(folder.names(), std::vector<std::string>{});
}

TEST(Surroundings, AFullDiskIsReported) {
  for (const JobToTry& job : tables_to_try()) {
    SCOPED_TRACE(job.quick);
    expect_ends(ending_of(job.quick, {"--quiet"}, "exec >/dev/full"), 1, "No space left");
    if (job.name() == "reduce" || job.name() == "fit") continue;  // a second each, to say the same
    expect_ends(ending_of(job.quick, {"--quiet", "--output", "/dev/full"}), 1, "No space left");
  }
  for (const std::string& job : jobs_with_text)
    expect_ends(ending_of(job, {}, "exec >/dev/full"), 1, "No space left");
  for (const std::string words : {"--help", "--version", "simulate --help"})
    expect_ends(ending_of(words, {}, "exec >/dev/full"), 1, "No space left");
}

TEST(Surroundings, APlaceThatCannotBeWrittenIsRefused) {
  const TemporaryFolder folder;
  write_text(folder / "file", "");
  fs::create_directory(folder / "gone");
  for (const JobToTry& job : tables_to_try()) {
    for (const fs::path& place : {folder / "file/table.csv", folder / "absent/table.csv",
                                  folder.path(), fs::path("/proc/table.csv")}) {
      SCOPED_TRACE(job.quick + " to " + place.string());
      if (job.name() == "modes" && place != folder.path()) continue;  // computes before it opens
      expect_ends(ending_of(job.quick, {"--quiet", "--output", place.string()}), 2, "cannot write");
    }
  }
  const std::string from_removed_folder = "cd " + (folder / "gone").string() + " && rmdir ../gone";
  expect_ends(ending_of("simulate", {"--output", "table.csv"}, from_removed_folder), 2,
              "cannot write");
  EXPECT_EQ(folder.names(), std::vector<std::string>{"file"});
}

TEST(Surroundings, NoJobWritesOverWhatItReads) {
  const TemporaryFolder folder;
  const std::string case_file = (folder / "case.toml").string();
  const std::string record = (folder / "record.csv").string();
  write_text(case_file, "[backlash]\nwidth = 0.001\n");
  write_text(record, "time_s,force_N,displacement_m\n0,0,0.01\n30,0.1,0\n");
  fs::create_symlink(case_file, folder / "link.toml");
  for (const JobToTry& job : tables_to_try()) {
    SCOPED_TRACE(job.quick);
    expect_ends(ending_of(job.quick, {"--case", case_file, "--output", case_file}), 2,
                "reads this file");
  }
  expect_ends(
      ending_of("simulate --case", {case_file, "--output", (folder / "link.toml").string()}), 2,
      "reads this file");
  expect_ends(
      ending_of("simulate --set", {"excitation.record=\"" + record + "\"", "--output", record}), 2,
      "reads this file");
  if (both_packages)
    expect_ends(ending_of("fit --data", {record, "--output", record}), 2, "reads this file");
  EXPECT_EQ(read_text(case_file), "[backlash]\nwidth = 0.001\n");
}

// ---- readers ----------------------------------------------------------------------------------

TEST(Surroundings, AReaderThatHasGoneEndsAJobWithOneLine) {
  // A pipe that is open for writing has had a reader, which is closed before the program begins.
  for (const JobToTry& job : tables_to_try()) {
    SCOPED_TRACE(job.quick);
    const TemporaryFolder folder;
    const std::string pipe = (folder / "pipe").string();
    expect_ends(ending_of(job.quick, {"--quiet"},
                          "mkfifo '" + pipe + "'; exec 3<>'" + pipe + "' >'" + pipe + "' 3>&-"),
                1, "closed by its reader");
  }
}

TEST(Surroundings, ASlowReaderGetsEveryByte) {
  const TemporaryFolder folder;
  const std::string table = (folder / "table.csv").string();
  const std::string job = "simulate --duration 5";
  run_holdfast(job, "| (sleep 0.3; dd bs=977 iflag=fullblock status=none; cat) >'" + table + "' #");
  EXPECT_EQ(read_text(table), run_holdfast(job).output);
}

// ---- signals ----------------------------------------------------------------------------------

/// Three seconds end a computation that does not look; the rest is for a machine with other work.
void expect_interrupted(RunningProgram& program, int signal_number) {
  program.wait_until_it_computes(std::chrono::milliseconds(50));
  const auto start = std::chrono::steady_clock::now();
  program.send(signal_number);
  expect_ends(program.wait_at_most(), 130, "interrupted");
  EXPECT_LT(std::chrono::steady_clock::now() - start, seconds(30));
}

void expect_every_slow_job_to_end(int signal_number) {
  for (const JobToTry& job : tables_to_try()) {
    if (job.slow.empty()) continue;
    SCOPED_TRACE(job.slow);
    const TemporaryFolder folder;
    // Of a sweep that is to be resumed the work folder stays, hence here without --output.
    const bool named = job.name() != "sweep";
    const auto words =
        named ? with(job.slow, {"--output", (folder / "table.csv").string()}) : words_of(job.slow);
    RunningProgram program(words, "export TMPDIR='" + folder.path().string() + "'");
    expect_interrupted(program, signal_number);
    EXPECT_EQ(folder.names(), std::vector<std::string>{});
  }
}

TEST(Surroundings, AnInterruptEndsEverySlowJob) { expect_every_slow_job_to_end(SIGINT); }

TEST(Surroundings, ATerminationEndsEverySlowJob) { expect_every_slow_job_to_end(SIGTERM); }

TEST(Surroundings, AnInterruptedReportLeavesNothingUnfinished) {
  const TemporaryFolder folder;
  const fs::path pictures = folder / "report/pictures";
  RunningProgram program({"report", "--output", (folder / "report").string()});
  std::error_code absent;
  while (program.runs() && (!fs::exists(pictures, absent) || fs::is_empty(pictures, absent)))
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  expect_interrupted(program, SIGTERM);
  for (const auto& entry : fs::recursive_directory_iterator(folder.path())) {
    const std::string name = entry.path().filename().string();
    EXPECT_EQ(name.find("partial"), std::string::npos) << name;
    EXPECT_EQ(name.find(".tmp"), std::string::npos) << name;
  }
  EXPECT_FALSE(fs::exists(folder / "report/report.html"));
}

// ---- requests without end ---------------------------------------------------------------------

/// Refused at once, or computed piece by piece in little memory until a signal comes.
void expect_bounded(const std::string& job) {
  SCOPED_TRACE(job);
  const TemporaryFolder folder;
  RunningProgram program(words_of(job), (is_sanitized ? "" : address_space(1 << 20) + "; ") +
                                            "cd '" + folder.path().string() + "'; export TMPDIR=.");
  program.wait_until_it_computes(std::chrono::milliseconds(250));
  const std::size_t peak = program.peak_memory_so_far_kib();
  program.send(SIGINT);
  const Ending ending = program.wait_at_most();
  EXPECT_EQ(ending.ended_by_signal, 0);
  EXPECT_TRUE(ending.exit_code == 130 || ending.exit_code == 1 || ending.exit_code == 2)
      << ending.exit_code << ending.errors;
  EXPECT_EQ(lines_in(ending.errors), 1U) << ending.errors;
  EXPECT_EQ(folder.names(), std::vector<std::string>{});
  EXPECT_TRUE(is_sanitized || peak < std::size_t{400} << 10) << peak << " KiB";
}

TEST(Surroundings, ABillionRowsTakeLittleMemoryOrAreRefused) {
  const std::string billion = ":1000000000";
  for (const std::string& job :
       {"statics --force -1:1" + billion,
        "stability --yes --p -1000:200" + billion + " --d -40:20:3",
        "stability --yes --d -40:20" + billion + " --p -1:1:2",
        "stability --yes --axis control.sampling_period=0.001:0.01" + billion +
            " --axis plant.absorber_mass=0.1:0.2" + billion,
        "response --yes --p -1000:200" + billion + " --d -40:20" + billion,
        "design --frequency 5:60" + billion, "max-delay --frequency 5:60" + billion,
        std::string("simulate --yes --duration 9e6"), std::string("spectrum --duration 1e9"),
        std::string("deviation --yes --duration 9e6"), std::string("coverage --durations 9e6"),
        "basins --axis initial.z1=0:0.001" + billion + " --axis initial.v2=0:0.1" + billion,
        "diagram --axis backlash.width=0:0.003" + billion,
        std::string("section --duration 9e6 --from 0"),
        std::string("lyapunov --duration 9e6 --history"),
        "sweep --axis backlash.width=0:0.003" + billion})
    expect_bounded(job);
  if (!both_packages) return;
  expect_bounded("peaks --force -0.1:0.1" + billion);
  expect_bounded("decay --duration 10 --interval 1e-8");
}

TEST(Surroundings, MoreThreadsThanCoresAreNoMatterForAWord) {
  const Outcome outcome = run_holdfast("stability --p -600:0:40 --d -20:0:40 --threads 1000");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.errors, "");
}

}  // namespace
}  // namespace holdfast::tests
