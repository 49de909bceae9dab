#include "process/child.hpp"

#include "support/testing.hpp"

namespace holdfast::program {
namespace {

TEST(Child, ItsEndIsToldWhateverItIs) {
  EXPECT_EQ(run_in_child([] { return 0; }), 0);
  EXPECT_EQ(run_in_child([] { return 28; }), 28);
  EXPECT_EQ(run_in_child([]() -> int { throw std::runtime_error("in vain"); }), 255);
  EXPECT_EQ(run_in_child([] { return raise(SIGKILL); }), -SIGKILL);
}

TEST(Child, LeavesThisProcessAsItIs) {
  int value = 1;
  EXPECT_EQ(run_in_child([&value] { return value = 2; }), 2);
  EXPECT_EQ(value, 1);
}

}  // namespace
}  // namespace holdfast::program
