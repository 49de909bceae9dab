#include "progress.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <thread>
#include <vector>

namespace holdfast::program {
namespace {

template <typename Work>
std::string standard_error_of(const Work& work) {
  ::testing::internal::CaptureStderr();
  work();
  return ::testing::internal::GetCapturedStderr();
}

TEST(Progress, ShowsDoneRateAndRemainingTime) {
  EXPECT_EQ(progress_text("chart", 40, 100, 8.0), "chart: 40/100, 5.0/s, 12 s left");
  EXPECT_EQ(progress_text("chart", 100, 100, 8.0), "chart: 100/100, 12.5/s, 8.0 s");
  EXPECT_EQ(progress_text("chart", 1, 1000, 7.2), "chart: 1/1000, 0.1/s, 2.0 h left");
  EXPECT_EQ(progress_text("chart", 0, 100, 0.0), "chart: 0/100");
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

TEST(Progress, IsWantedWhenAskedForAndNeverWhenQuiet) {
  JobContext context;
  context.progress = true;
  EXPECT_TRUE(progress_wanted(context));
  context.quiet = true;
  EXPECT_FALSE(progress_wanted(context));
  context = {};
  EXPECT_EQ(progress_wanted(context), isatty(STDERR_FILENO) == 1);
}

}  // namespace
}  // namespace holdfast::program
