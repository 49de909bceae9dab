#include "process/progress.hpp"

#include "support/testing.hpp"

#include <unistd.h>

namespace holdfast::program {
namespace {

template <typename Work>
std::string standard_error_of(const Work& work) {
  ::testing::internal::CaptureStderr();
  work();
  return ::testing::internal::GetCapturedStderr();
}

TEST(Progress, ShowsDoneRateAndRemainingTime) {
  EXPECT_EQ(progress_text("chart", {40, 100}, 8.0), "chart: 40/100, 5.0/s, 12 s left");
  EXPECT_EQ(progress_text("chart", {100, 100}, 8.0), "chart: 100/100, 12.5/s, 8.0 s");
  EXPECT_EQ(progress_text("chart", {1, 1000}, 7.2), "chart: 1/1000, 0.1/s, 2.0 h left");
  EXPECT_EQ(progress_text("chart", {0, 100}, 0.0), "chart: 0/100");
}

TEST(Progress, NamesStepsAndSamplesAndLeavesOutWhatWasDoneBefore) {
  EXPECT_EQ(progress_text("sweep, cells", {140, 200, 100, 8e8}, 8.0),
            "sweep: 140/200 cells, 5.0 cells/s, 1e+08 samples/s, 12 s left");
  EXPECT_EQ(progress_text("sweep, cells", {100, 200, 100, 0.0}, 8.0), "sweep: 100/200 cells");
}

TEST(Progress, AddsWhatWasDoneBefore) {
  const std::string shown = standard_error_of([] {
    Progress progress(100, "sweep, cells", true);
    progress.skip(50);
    progress.advance(30, 3000);
  });
  EXPECT_NE(shown.find("sweep: 80/100 cells"), std::string::npos) << shown;
  EXPECT_NE(shown.find("samples/s"), std::string::npos) << shown;
}

TEST(Progress, IsSilentUnlessEnabled) {
  EXPECT_EQ(standard_error_of([] { Progress(5, "chart", false).advance(5); }), "");
}

TEST(Progress, CountsFromManyThreadsAndUpdatesSeldom) {
  const std::string shown = standard_error_of([] {
    Progress progress(40000, "chart", true);
    std::vector<std::thread> threads;
    for (int i = 0; i < 4; ++i) {
      threads.emplace_back([&] {
        for (int j = 0; j < 10000; ++j) progress.advance();
      });
    }
    for (std::thread& thread : threads) thread.join();
  });
  EXPECT_NE(shown.find("chart: 40000/40000"), std::string::npos) << shown;
  EXPECT_LT(std::count(shown.begin(), shown.end(), '\n'), 1000);
}

/// A job that counts nothing, and one whose next step takes long, show that they are at work.
TEST(Progress, TicksWhereAJobSaysNothing) {
  using namespace std::chrono_literals;
  const auto wait_for = [](const Ticking&) { std::this_thread::sleep_for(200ms); };
  const std::string silent = standard_error_of([&] { wait_for(Ticking("answers", true, 1ms)); });
  EXPECT_EQ(silent.rfind("answers: 0.", 0), 0U) << silent;
  EXPECT_LT(std::count(silent.begin(), silent.end(), '\n'), 20) << "seldom, and ever less so";
  const std::string counting = standard_error_of([&] {
    const Ticking ticking("chart", true, 1ms);
    Progress progress(7, "chart", true);
    wait_for(ticking);
  });
  EXPECT_EQ(counting.rfind("chart: 0/7", 0), 0U) << counting;
  EXPECT_EQ(standard_error_of([&] { wait_for(Ticking("answers", false, 1ms)); }), "");
  EXPECT_EQ(standard_error_of([&] {
              const Ticking outer("report", true, 1h);
              wait_for(Ticking("stability", true, 1ms));
            }),
            "")
      << "a job within a job is part of it";
}

TEST(Progress, IsWantedWhenAskedForAndNeverWhenQuiet) {
  EXPECT_TRUE(progress_wanted(false, true));
  EXPECT_FALSE(progress_wanted(true, true));
  EXPECT_EQ(progress_wanted(false, false), isatty(STDERR_FILENO) == 1);
}

}  // namespace
}  // namespace holdfast::program
