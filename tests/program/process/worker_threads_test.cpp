#include "process/worker_threads.hpp"

#include <sched.h>

#include <cstddef>

#include "support/testing.hpp"

namespace holdfast::program {
namespace {

TEST(WorkerThreads, AreThoseAskedForElseTheCoresLeftToTheProcess) {
  EXPECT_EQ(worker_threads(7), 7);
  cpu_set_t before;
  ASSERT_EQ(sched_getaffinity(0, sizeof(before), &before), 0);
  EXPECT_EQ(worker_threads(0), CPU_COUNT(&before));
  std::size_t first = 0;
  while (!CPU_ISSET(first, &before)) ++first;
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(first, &one);
  ASSERT_EQ(sched_setaffinity(0, sizeof(one), &one), 0);
  EXPECT_EQ(worker_threads(0), 1);
  EXPECT_EQ(sched_setaffinity(0, sizeof(before), &before), 0);
}

}  // namespace
}  // namespace holdfast::program
