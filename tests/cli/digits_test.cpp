// What the metadata say of the digits of a table.

#include "cli/program.hpp"
#include "holdfast/math/stats/trusted_digits.hpp"
#include "support/temporary_folder.hpp"
#include "support/testing.hpp"

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
  for (const char* job : {"simulate", "section", "spectrum", "simulate --kick 1:0.001",
                          "simulate --no-control", "simulate --from 5"}) {
    EXPECT_EQ(metadata_of(job, errors).find("trusted"), std::string::npos) << job;
    EXPECT_EQ(errors, "") << job;
  }
}

TEST(DigitsInMetadata, OfAnIrregularMotionAreNoneAfterAWhile) {
  if (!long_double_is_wider) GTEST_SKIP() << "long double is no wider than double here";
  std::string errors;
  for (const std::string job : {"simulate", "section", "spectrum"}) {
    const std::string metadata = metadata_of(job + irregular + " --duration 60", errors);
    EXPECT_NE(metadata.find("\"trusted_digits\": 0"), std::string::npos) << job;
    EXPECT_NE(metadata.find("\"trusted_until_s\""), std::string::npos) << job;
    EXPECT_NE(errors.find("warning: after t = "), std::string::npos) << job << errors;
  }
  metadata_of(std::string("simulate --quiet --duration 60") + irregular, errors);
  EXPECT_EQ(errors, "");
}

TEST(DigitsInMetadata, OfAnIrregularMotionsBeginningAreEnough) {
  std::string errors;
  const std::string job = std::string("simulate --duration 1") + irregular;
  EXPECT_EQ(metadata_of(job, errors).find("trusted"), std::string::npos);
}

}  // namespace
}  // namespace holdfast::tests
