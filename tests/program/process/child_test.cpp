#include <holdfast/core/errors.hpp>

#include "process/child.hpp"
#include "process/errors.hpp"
#include "process/exit.hpp"
#include "process/interrupt.hpp"
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

struct Outcome {
  int code;
  std::string message;
};

Outcome outcome(const std::function<int()>& work) {
  ::testing::internal::CaptureStderr();
  const int code = run_guarded(work);
  return {code, ::testing::internal::GetCapturedStderr()};
}

template <typename Exception>
Outcome outcome_of(const Exception& exception) {
  return outcome([&]() -> int { throw exception; });
}

TEST(RunGuarded, GivesTheWorksOwnCodeSilently) {
  for (const int code : {0, 1, 2}) {
    const Outcome result = outcome([=] { return code; });
    EXPECT_EQ(result.code, code);
    EXPECT_EQ(result.message, "");
  }
}

TEST(RunGuarded, EveryExceptionHasItsCodeAndALineThatNamesTheProgram) {
  const std::vector<std::pair<Outcome, int>> outcomes = {
      {outcome_of(WrongInput("a\nb")), 2},
      {outcome_of(InvalidParameter("a\nb", -1.0, "s", "> 0")), 2},
      {outcome_of(NoAnswer("x")), 1},
      {outcome_of(OutputError("x")), 1},
      {outcome_of(std::bad_alloc()), 1},
      {outcome_of(std::runtime_error("a\r\nb\n")), 1},
      {outcome_of(3), 1},
      {outcome_of(Interrupted()), 130}};
  for (const auto& [result, code] : outcomes) {
    EXPECT_EQ(result.code, code) << result.message;
    EXPECT_EQ(result.message.rfind("holdfast: ", 0), 0u) << result.message;
    EXPECT_EQ(std::count(result.message.begin(), result.message.end(), '\n'), 1);
    EXPECT_EQ(result.message.back(), '\n');
  }
}

TEST(RunGuarded, ASignalDuringTheWorkIsAnInterruption) {
  const Outcome result = outcome([] {
    raise(SIGTERM);
    throw_if_interrupted();
    return 0;
  });
  clear_interrupt();
  EXPECT_EQ(result.code, 130);
}

}  // namespace
}  // namespace holdfast::program
