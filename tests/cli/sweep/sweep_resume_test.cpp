#include "cli/running_program.hpp"
#include "cli/sweep/stopped_sweep.hpp"
#include "support/testing.hpp"

namespace holdfast::tests {
namespace {

namespace fs = std::filesystem;

/// Starts or goes on with the sweep, and kills it some tiles and up to 3 ms later.
Ending killed_sweep(const fs::path& output, const std::string& more, std::mt19937& random) {
  const std::size_t tiles = tiles_kept_for(output).size() + random() % 15;
  RunningProgram program(sweep_words(output, more));
  wait_for_tiles(program, output, tiles);
  std::this_thread::sleep_for(std::chrono::microseconds(random() % 3000));
  program.send(SIGKILL);
  return program.wait();
}

void expect_still_there(const TileStamps& kept, const TileStamps& now) {
  for (const auto& [name, stamp] : kept) {
    const auto found = now.find(name);
    EXPECT_TRUE(found != now.end() && found->second == stamp) << name << " was computed again";
  }
}

TEST(SweepResume, KilledTwentyTimesItGivesTheSameBytesAndComputesNoFinishedTileAgain) {
  const SweepResult expected = undisturbed_result("sweep.csv");
  std::mt19937 random(20);
  for (int round = 0; round < 5; ++round) {
    const TemporaryFolder folder;
    const fs::path output = folder / "sweep.csv";
    const std::string threads = "--threads " + std::to_string(1 + round % 3);
    TileStamps kept;
    for (int kill = 0; kill < 4 && !fs::exists(output); ++kill) {
      const Ending ending = killed_sweep(output, threads + (kill == 0 ? "" : " --resume"), random);
      EXPECT_TRUE(ending.ended_by_signal == SIGKILL || ending.exit_code == 0) << ending.errors;
      const TileStamps now = tiles_kept_for(output);
      // Once the output is there its tiles go.
      if (!fs::exists(output)) expect_still_there(kept, now);
      kept = now;
    }
    const Ending resumed = swept(output, threads + " --resume");
    EXPECT_EQ(resumed.exit_code, 0) << resumed.errors;
    EXPECT_TRUE(result_at(output) == expected) << "round " << round;
    EXPECT_FALSE(fs::exists(tile_folder_of(output)));
  }
}

void expect_interrupted_and_resumed(int signal_number) {
  const StoppedSweep stopped(signal_number);
  const Ending& ending = stopped.ending();
  EXPECT_EQ(ending.exit_code, 130) << ending.errors;
  EXPECT_NE(ending.errors.find("--resume"), std::string::npos) << ending.errors;
  EXPECT_NE(ending.errors.find(std::to_string(stopped.tiles().size())), std::string::npos)
      << stopped.tiles().size() << " tiles: " << ending.errors;
  // No half a table, whole or hidden.
  EXPECT_EQ(stopped.folder().names(), std::vector<std::string>{"sweep.csv.tiles"});
  stopped.expect_resumes();
}

TEST(SweepResume, InterruptedItSaysHowToGoOn) { expect_interrupted_and_resumed(SIGINT); }

TEST(SweepResume, TerminatedItSaysHowToGoOn) { expect_interrupted_and_resumed(SIGTERM); }

TEST(SweepResume, WhenItsTerminalClosesItSaysHowToGoOn) { expect_interrupted_and_resumed(SIGHUP); }

void flip_bit(const fs::path& file, std::size_t byte, unsigned bit) {
  std::string text = read_text(file);
  text.at(byte) = static_cast<char>(static_cast<unsigned char>(text.at(byte)) ^ (1U << bit));
  write_text(file, text);
}

TEST(SweepResume, DamagedTilesAreComputedAgain) {
  const StoppedSweep stopped(SIGKILL);
  ASSERT_GE(stopped.tiles().size(), 7U);
  fs::resize_file(stopped.tile(0), fs::file_size(stopped.tile(0)) / 2);
  flip_bit(stopped.tile(1), fs::file_size(stopped.tile(1)) - 9, 0);
  fs::copy_file(stopped.tile(3), stopped.tile(2), fs::copy_options::overwrite_existing);
  fs::resize_file(stopped.tile(4), 0);
  fs::remove(stopped.tile(5));
  write_text(stopped.tile(6), read_text(stopped.tile(6)) + "more");
  stopped.expect_resumes();
}

#ifdef HOLDFAST_HAS_NETCDF

TEST(SweepResume, ANetcdfFileHasTheSameBytesToo) {
  StoppedSweep(SIGKILL, "sweep.nc").expect_resumes();
}

#endif

void expect_not_resumed(const StoppedSweep& stopped, const std::string& more,
                        const std::vector<std::string>& mentioned) {
  const Ending ending = swept(stopped.output(), more);
  EXPECT_EQ(ending.exit_code, 2) << more << '\n' << ending.errors;
  for (const std::string& part : mentioned)
    EXPECT_NE(ending.errors.find(part), std::string::npos) << part << '\n' << ending.errors;
  expect_still_there(stopped.tiles(), tiles_kept_for(stopped.output()));
  EXPECT_FALSE(fs::exists(stopped.output()));
}

TEST(SweepResume, OfAnotherSweepIsRefusedWithWhatDiffers) {
  const StoppedSweep stopped(SIGKILL);
  expect_not_resumed(stopped, "", {"--resume"});
  expect_not_resumed(stopped, "--resume --max-period 50", {"--max-period", "1000000", "50"});
  expect_not_resumed(stopped, "--resume --metric outcome", {"--metric", "outcome"});
  expect_not_resumed(stopped, "--resume --axis initial.z2=0,1", {"--axis", "initial.z2=0,1"});
  expect_not_resumed(stopped, "--resume --set control.differential_gain=-12",
                     {"control.differential_gain", "-13", "-12"});
  stopped.expect_resumes();
}

TEST(SweepResume, OfAnotherDurationIsRefused) {
  const TemporaryFolder folder;
  const std::string sweep = "sweep --axis initial.z1=0:0.001:300 --tile 1 --output " +
                            (folder / "sweep.csv").string() + " --duration ";
  {
    RunningProgram program(words_of(sweep + "100"));
    wait_for_tiles(program, folder / "sweep.csv", 4);
    program.send(SIGKILL);
    program.wait();
  }
  const Ending other = RunningProgram(words_of(sweep + "60 --resume")).wait();
  EXPECT_EQ(other.exit_code, 2) << other.errors;
  for (const std::string part : {"--duration", "100", "60"})
    EXPECT_NE(other.errors.find(part), std::string::npos) << other.errors;
}

TEST(SweepResume, WithoutAnythingToGoOnWithBeginsAnew) {
  const TemporaryFolder folder;
  const Ending ending = swept(folder / "sweep.csv", "--resume");
  EXPECT_EQ(ending.exit_code, 0) << ending.errors;
  EXPECT_TRUE(result_at(folder / "sweep.csv") == undisturbed_result("sweep.csv"));
}

}  // namespace
}  // namespace holdfast::tests
