#include "cli/program.hpp"
#include "cli/running_program.hpp"

namespace holdfast::tests {
namespace {

const std::string small_grid = " --p -600:0:3 --d -20:0:5";

TEST(Netcdf, ChartsOfGainsAreWrittenAsNetcdfAndCarryTheirMetadata) {
  for (const std::string job : {"stability --radius", "stability --continuous", "response"}) {
    const TemporaryFolder folder;
    const std::string file = (folder / "x.nc").string();
    const Outcome outcome = run_holdfast(job + small_grid + " --output '" + file + "'");
    EXPECT_EQ(outcome.error_lines(), outcome.exit_code == 0 ? 0U : 1U) << outcome.errors;
#ifdef HOLDFAST_HAS_NETCDF
    EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
    EXPECT_EQ(folder.names(), std::vector<std::string>{"x.nc"});
    EXPECT_EQ(read_text(file).substr(0, 8), "\x89HDF\r\n\x1a\n") << job;
    expect_holds(read_text(file), {"sampling_period"});
#else
    EXPECT_EQ(outcome.exit_code, 1);
    expect_holds(outcome.errors, {"libnetcdf-dev"});
    EXPECT_TRUE(folder.names().empty());
#endif
  }
}

TEST(Netcdf, OtherJobsSayWhichWriteIt) {
  const TemporaryFolder folder;
  for (const std::string job : {"simulate --duration 0.1", "boundary", "modes", "spectrum"}) {
    expect_refused(job + " --output '" + (folder / "x.nc").string() + "'",
                   {"only stability, response, basins and sweep write netCDF"});
  }
  EXPECT_TRUE(folder.names().empty());
}

TEST(Netcdf, WithoutSpaceTheProgramSaysSoEndsInOrderAndLeavesNothing) {
  const TemporaryFolder folder;
  const std::string file = (folder / "x.nc").string(), errors = (folder / "errors").string();
  const std::string command = "trap '' XFSZ; ulimit -f 64; '" + std::string(HOLDFAST_PROGRAM) +
                              "' response --p -600:0:200 --d -20:0:500 --output '" + file +
                              "' 2>'" + errors + "'";
  const int status = std::system(command.c_str());
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 1) << status;
#ifdef HOLDFAST_HAS_NETCDF
  EXPECT_EQ(read_text(errors), "holdfast: cannot write " + file + ": File too large\n");
#endif
  EXPECT_EQ(folder.names(), std::vector<std::string>{"errors"});
}

#if defined(HOLDFAST_HAS_NETCDF) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

Ending ending_within(int kibibytes, const std::filesystem::path& folder) {
  std::vector<std::string> words = words_of("stability --threads 1 --p -600:0:40 --d -10:10:40");
  words.insert(words.end(), {"--output", (folder / "o.nc").string()});
  return RunningProgram(words, "ulimit -v " + std::to_string(kibibytes))
      .wait_at_most(std::chrono::seconds(20));
}

/// At every size of the address space below the least that is enough, which differs from machine to
/// machine.
TEST(Netcdf, WithoutMemoryTheProgramSaysSoEndsInOrderAndLeavesNothing) {
  int enough = 1 << 20, too_little = 1 << 15;
  while (enough - too_little > 1024) {
    const TemporaryFolder folder;
    const int middle = (enough + too_little) / 2;
    (ending_within(middle, folder.path()).exit_code == 0 ? enough : too_little) = middle;
  }
  for (int less = 0; less < 24; ++less) {
    const TemporaryFolder folder;
    const Ending ending = ending_within(too_little - less * 1024, folder.path());
    if (ending.exit_code == 0) continue;
    SCOPED_TRACE(std::to_string(too_little - less * 1024) + " KiB");
    EXPECT_EQ(ending.ended_by_signal, 0);
    EXPECT_EQ(ending.exit_code, 1) << ending.errors;
    EXPECT_EQ(std::count(ending.errors.begin(), ending.errors.end(), '\n'), 1) << ending.errors;
    EXPECT_TRUE(folder.names().empty());
  }
}

#endif

}  // namespace
}  // namespace holdfast::tests
