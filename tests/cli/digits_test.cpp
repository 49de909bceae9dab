// What the metadata say of the digits of a table.

#include "holdfast/math/stats/trusted_digits.hpp"

#include "cli/program.hpp"

namespace holdfast::tests {
namespace {

constexpr const char* irregular =
    " --set control.sampling_period=0.01 --set control.differential_gain=-20"
    " --set excitation.frequency=6";

/// The metadata of a job's table; its standard error into `errors`.
std::string metadata_of(const std::string& job, std::string& errors) {
  const TemporaryFolder folder;
  const std::string table = (folder / "table.csv").string();
  const Outcome outcome = run_holdfast(job + " --output '" + table + "'");
  EXPECT_EQ(outcome.exit_code, 0) << job << '\n' << outcome.errors;
  errors = outcome.errors;
  return read_text(table + "-metadata.json");
}

TEST(DigitsInMetadata, OfARegularMotionAreNotMentioned) {
  std::string errors;
  for (const char* job :
       {"simulate", "section", "spectrum", "simulate --kick 1:0.001", "simulate --no-control",
        "simulate --from 5", "coverage --durations 10", "simulate --switching exact",
        "section --switching exact", "spectrum --set control.velocity_quantum=0.001"}) {
    EXPECT_EQ(metadata_of(job, errors).find("trusted"), std::string::npos) << job;
    EXPECT_EQ(errors, "") << job;
  }
}

TEST(DigitsInMetadata, OfAnIrregularMotionAreNoneAfterAWhile) {
  if (!long_double_is_wider) GTEST_SKIP() << "long double is no wider than double here";
  std::string errors;
  for (const std::string job : {"simulate --duration 60", "section --duration 60",
                                "spectrum --duration 60", "coverage --durations 10,60"}) {
    const std::string metadata = metadata_of(job + irregular, errors);
    expect_holds(metadata, {"\"trusted_digits\": 0", "\"trusted_until_s\""});
    expect_holds(errors, {"warning: after t = "});
  }
  metadata_of(std::string("simulate --quiet --duration 60") + irregular, errors);
  EXPECT_EQ(errors, "");
}

TEST(DigitsInMetadata, OfADeviationThatStaysTellThatNeighboursPart) {
  std::string errors;
  metadata_of(std::string("deviation --offset 1e-9 --duration 60") + irregular, errors);
  expect_holds(errors, {"still differ by"});
}

TEST(DigitsInMetadata, OfAnotherLoopAreThoseThatAnotherRoundingConfirms) {
  std::string errors;
  const std::string metadata = metadata_of(
      "simulate --duration 60 --set excitation.amplitude=0 --set initial.z1=0.002 --set "
      "backlash.width=0 --set control.displacement_quantum=0.0001",
      errors);
  expect_holds(metadata, {"\"trusted_until_s\""});
  expect_holds(errors, {"that a run with other rounding errors confirms"});
}

TEST(DigitsInMetadata, OfASweepAreThoseOfItsChaoticCells) {
  const std::string sweep =
      std::string("sweep --axis backlash.width=0.0003,0.0005 --metric steady_peak --duration 2") +
      irregular;
  EXPECT_EQ(run_holdfast(sweep).errors, "");
  const Outcome judged = run_holdfast(sweep + " --metric verdict");
  const auto chaotic = judged.output.find("chaotic") != std::string::npos;
  EXPECT_TRUE(chaotic);
  expect_holds(judged.errors, {"are chaotic: their motions depend on rounding"});
  EXPECT_EQ(run_holdfast(sweep + " --metric verdict --quiet").errors, "");
}

// An answer that a small change of the question would change much comes with one line that says so,
// and one that is safe comes without.

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
  expect_warning("reduce --set reduction.second_frequency=6.88", "two nearly equal solutions");
  EXPECT_EQ(run_holdfast("reduce").errors.find("nearly equal solutions"), std::string::npos);
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
  expect_warning("lyapunov --duration 2", "may be zero");
  EXPECT_EQ(run_holdfast("lyapunov --duration 200").errors, "");
}

}  // namespace
}  // namespace holdfast::tests
