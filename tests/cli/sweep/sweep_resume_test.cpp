#include "cli/sweep/stopped_sweep.hpp"

namespace holdfast::tests {
namespace {

namespace fs = std::filesystem;

/// Starts or goes on with the sweep, and kills it some chunks and up to 3 ms later.
Ending killed_sweep(const fs::path& output, const std::string& more, std::mt19937& random) {
  const std::size_t chunks = chunks_kept_for(output).size() + random() % 15;
  RunningProgram program(sweep_words(output, more));
  wait_for_chunks(program, output, chunks);
  std::this_thread::sleep_for(std::chrono::microseconds(random() % 3000));
  program.send(SIGKILL);
  return program.wait();
}

void expect_still_there(const ChunkStamps& kept, const ChunkStamps& now) {
  for (const auto& [name, stamp] : kept) {
    const auto found = now.find(name);
    EXPECT_TRUE(found != now.end() && found->second == stamp) << name << " was computed again";
  }
}

TEST(SweepResume, KilledTwentyTimesItGivesTheSameBytesAndComputesNoFinishedChunkAgain) {
  const SweepResult expected = undisturbed_result("sweep.csv");
  std::mt19937 random(20);
  for (int round = 0; round < 5; ++round) {
    const TemporaryFolder folder;
    const fs::path output = folder / "sweep.csv";
    const std::string threads = "--threads " + std::to_string(1 + round % 3);
    ChunkStamps kept;
    for (int kill = 0; kill < 4 && !fs::exists(output); ++kill) {
      const Ending ending = killed_sweep(output, threads + (kill == 0 ? "" : " --resume"), random);
      EXPECT_TRUE(ending.ended_by_signal == SIGKILL || ending.exit_code == 0) << ending.errors;
      const ChunkStamps now = chunks_kept_for(output);
      // Once the output is there its store goes.
      if (!fs::exists(output)) expect_still_there(kept, now);
      kept = now;
    }
    const Ending resumed = swept(output, threads + " --resume");
    EXPECT_EQ(resumed.exit_code, 0) << resumed.errors;
    EXPECT_TRUE(result_at(output) == expected) << "round " << round;
    EXPECT_FALSE(fs::exists(store_of(output)));
  }
}

void expect_interrupted_and_resumed(int signal_number) {
  const StoppedSweep stopped(signal_number);
  const Ending& ending = stopped.ending();
  EXPECT_EQ(ending.exit_code, 130) << ending.errors;
  expect_holds(ending.errors, {"--resume", std::to_string(stopped.chunks().size())});
  // No half a table, whole or hidden.
  EXPECT_EQ(stopped.folder().names(), std::vector<std::string>{"sweep.csv.zarr"});
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

TEST(SweepResume, DamagedChunksAreComputedAgain) {
  const StoppedSweep stopped(SIGKILL);
  ASSERT_GE(stopped.chunks().size(), 7U);
  fs::resize_file(stopped.chunk(0), fs::file_size(stopped.chunk(0)) / 2);
  flip_bit(stopped.chunk(1), fs::file_size(stopped.chunk(1)) - 9, 0);
  flip_bit(stopped.chunk(2), fs::file_size(stopped.chunk(2)) / 2, 5);
  fs::resize_file(stopped.chunk(4), 0);
  fs::remove(stopped.chunk(5));
  write_text(stopped.chunk(6), read_text(stopped.chunk(6)) + "more");
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
  expect_holds(ending.errors, mentioned);
  expect_still_there(stopped.chunks(), chunks_kept_for(stopped.output()));
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
  const std::string sweep = "sweep --axis initial.z1=0:0.001:300 --chunk 1 --output " +
                            (folder / "sweep.csv").string() + " --duration ";
  {
    RunningProgram program(words_of(sweep + "100"));
    wait_for_chunks(program, folder / "sweep.csv", 4);
    program.send(SIGKILL);
    program.wait();
  }
  const Ending other = RunningProgram(words_of(sweep + "60 --resume")).wait();
  EXPECT_EQ(other.exit_code, 2) << other.errors;
  expect_holds(other.errors, {"--duration", "100", "60"});
}

TEST(SweepResume, WithoutAnythingToGoOnWithBeginsAnew) {
  const TemporaryFolder folder;
  const Ending ending = swept(folder / "sweep.csv", "--resume");
  EXPECT_EQ(ending.exit_code, 0) << ending.errors;
  EXPECT_TRUE(result_at(folder / "sweep.csv") == undisturbed_result("sweep.csv"));
}

}  // namespace
}  // namespace holdfast::tests
