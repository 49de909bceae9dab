#include "process/exit.hpp"

#include <holdfast/core/errors.hpp>

#include "process/errors.hpp"
#include "process/interrupt.hpp"
#include "support/testing.hpp"

namespace holdfast::program {
namespace {

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

TEST(RunGuarded, EveryExceptionHasItsCode) {
  EXPECT_EQ(outcome_of(WrongInput("x")).code, 2);
  EXPECT_EQ(outcome_of(InvalidParameter("sampling period", -1.0, "s", "> 0")).code, 2);
  EXPECT_EQ(outcome_of(NoAnswer("x")).code, 1);
  EXPECT_EQ(outcome_of(OutputError("x")).code, 1);
  EXPECT_EQ(outcome_of(std::bad_alloc()).code, 1);
  EXPECT_EQ(outcome_of(std::runtime_error("x")).code, 1);
  EXPECT_EQ(outcome_of(3).code, 1);
  EXPECT_EQ(outcome_of(Interrupted()).code, 130);
}

TEST(RunGuarded, TheMessageIsOneLineThatNamesTheProgram) {
  for (const Outcome& result :
       {outcome_of(WrongInput("a\nb")), outcome_of(std::runtime_error("a\r\nb\n")),
        outcome_of(InvalidParameter("a\nb", 1.0, "s", "> 2")), outcome_of(std::bad_alloc()),
        outcome_of(Interrupted()), outcome_of(3)}) {
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
