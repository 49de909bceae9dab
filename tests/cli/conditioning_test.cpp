// An answer that a small change of the question would change much comes with one line that says so,
// and one that is safe comes without.

#include "cli/program.hpp"
#include "support/testing.hpp"
#include "text/text.hpp"

namespace holdfast::tests {
namespace {

/// The command line answers, with one warning that holds the words.
void expect_warning(const std::string& arguments, const std::string& words) {
  const Outcome outcome = run_holdfast(arguments);
  EXPECT_EQ(outcome.exit_code, 0) << arguments << '\n' << outcome.errors;
  EXPECT_EQ(outcome.error_lines(), 1U) << arguments << '\n' << outcome.errors;
  EXPECT_EQ(outcome.errors.rfind("holdfast: warning: ", 0), 0U) << outcome.errors;
  expect_holds(outcome.errors, {words});
  EXPECT_EQ(run_holdfast(arguments + " --quiet").errors, "") << arguments;
}

TEST(Conditioning, AReductionNearItsDoubleSolutionIsTold) {
  if (!both_packages) GTEST_SKIP() << "SUNDIALS or Ceres Solver is missing";
  expect_warning("reduce --set reduction.second_frequency=6.88", "near its double solution");
  EXPECT_EQ(run_holdfast("reduce").errors.find("double solution"), std::string::npos);
}

TEST(Conditioning, AnOrbitNearABorderIsTold) {
  const auto ends = table_of("orbit --follow backlash.width=0:0.003");
  const double border = ends.number(1, "position");
  EXPECT_EQ(run_holdfast("orbit").errors, "");
  EXPECT_GT(border, 0.0005);
  expect_warning("orbit --set backlash.width=" + program::format_number(border - 1e-8),
                 "passes a switching surface");
}

TEST(Conditioning, AnExponentWithoutASignIsTold) {
  expect_warning("lyapunov --duration 2", "not told from zero");
  EXPECT_EQ(run_holdfast("lyapunov --duration 200").errors, "");
}

}  // namespace
}  // namespace holdfast::tests
