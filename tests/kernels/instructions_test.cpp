#include <nlohmann/json.hpp>

#include "cli/program.hpp"
#include "cli/sweep/stopped_sweep.hpp"
#include "kernels/instruction_set.hpp"
#include "process/errors.hpp"
#include "support/testing.hpp"

namespace holdfast::tests {
namespace {

using program::available_instruction_sets;
using program::InstructionSet;
using program::name_of;

std::string with(InstructionSet set) { return " --instructions " + std::string(name_of(set)); }

/// The same rows and words, and numbers apart by at most `tolerance` of the larger.
void expect_same_table(const program::CsvTable& one, const program::CsvTable& other,
                       double tolerance, const std::string& which) {
  ASSERT_EQ(one.names(), other.names()) << which;
  ASSERT_EQ(one.rows(), other.rows()) << which;
  ASSERT_GT(one.rows(), 0U) << which;
  for (std::size_t row = 0; row < one.rows(); ++row) {
    for (const std::string& column : one.names()) {
      if (one.text(row, column) == other.text(row, column)) continue;
      const double x = one.number(row, column), y = other.number(row, column);
      EXPECT_LE(std::abs(x - y), tolerance * std::max(std::abs(x), std::abs(y)))
          << which << ", row " << row << ", " << column << ": " << x << ' ' << y;
    }
  }
}

void expect_same_on_every_set(const std::string& job, double tolerance) {
  const program::CsvTable baseline = table_of(job + with(InstructionSet::baseline));
  for (const InstructionSet set : available_instruction_sets())
    expect_same_table(baseline, table_of(job + with(set)), tolerance, job + with(set));
}

TEST(Instructions, EachSetGivesTheSameChart) {
  expect_same_on_every_set("stability --p -1000:200:37 --d -40:20:41", 0.0);
  expect_same_on_every_set(
      "stability --axis control.sampling_period=0.001:0.03:29 --axis "
      "control.differential_gain=-40:20:31",
      0.0);
  expect_same_on_every_set(
      "stability --axis control.differential_gain=-40:20:31 --axis "
      "control.sampling_period=0.001:0.03:29",
      0.0);
}

TEST(Instructions, EachSetGivesTheSameRadii) {
  expect_same_on_every_set("stability --radius --p -1000:200:37 --d -40:20:41", 1e-12);
  expect_same_on_every_set(
      "stability --radius --set control.processing_delay=0.0005 --axis "
      "control.sampling_period=0.001:0.03:29 --axis plant.absorber_mass=0.05:0.5:19",
      1e-12);
}

TEST(Instructions, EachSetGivesTheSameSweepOfRegularMotions) {
  expect_same_on_every_set(
      "sweep --duration 4 --axis control.differential_gain=-20:-5:11 --axis "
      "excitation.frequency=8:12:7 --set backlash.width=0 --metric first_peak --metric steady_peak "
      "--metric steady_rms --metric force_peak --metric absorber_stroke --metric outcome",
      1e-12);
}

TEST(Instructions, EachSetFindsTheSameBasins) {
  expect_same_on_every_set(
      "basins --axis initial.z1=-0.005:0.005:9 --axis initial.z2=-0.005:0.005:9", 0.0);
}

TEST(Instructions, EachSetGivesTheSameSweepAndBasinsWithExactSwitching) {
  expect_same_on_every_set(
      "sweep --duration 4 --switching exact --axis control.differential_gain=-20:-5:5 --axis "
      "backlash.width=0:0.002:5 --metric first_peak --metric steady_peak --metric steady_rms "
      "--metric force_peak --metric absorber_stroke --metric outcome",
      1e-12);
  expect_same_on_every_set(
      "basins --switching exact --axis initial.z1=-0.005:0.005:5 --axis initial.z2=-0.005:0.005:5",
      0.0);
}

TEST(Instructions, AnUnknownSetIsWrongInput) {
  const Outcome outcome = run_holdfast("stability --instructions sse9");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.error_lines(), 1U) << outcome.errors;
  EXPECT_NE(outcome.errors.find("sse9"), std::string::npos) << outcome.errors;
  EXPECT_NE(outcome.errors.find("avx512"), std::string::npos) << outcome.errors;
  EXPECT_THROW(program::chosen_instruction_set("sse9"), program::WrongInput);
}

TEST(Instructions, AnUnavailableSetIsWrongInputThatNamesTheAvailableOnes) {
  const auto available = available_instruction_sets();
  for (const InstructionSet set :
       {InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512}) {
    const bool has = std::count(available.begin(), available.end(), set) > 0;
    const Outcome outcome = run_holdfast("stability --p 0:1:2 --d 0:1:2" + with(set));
    EXPECT_EQ(outcome.exit_code, has ? 0 : 2) << name_of(set) << outcome.errors;
    if (!has) {
      EXPECT_NE(outcome.errors.find("it has baseline"), std::string::npos) << outcome.errors;
    }
  }
}

TEST(Instructions, WithoutTheOptionTheBestIsTaken) {
  EXPECT_EQ(program::chosen_instruction_set(""), available_instruction_sets().back());
  EXPECT_EQ(available_instruction_sets().front(), InstructionSet::baseline);
  EXPECT_NE(
      run_holdfast("--version")
          .output.find("instructions " + std::string(name_of(available_instruction_sets().back()))),
      std::string::npos);
}

nlohmann::json origin_of(const std::filesystem::path& table) {
  const auto json = nlohmann::json::parse(read_text(table.string() + "-metadata.json"));
  return json["notes"][0]["holdfast"];
}

TEST(Instructions, MetadataNameTheChoice) {
  const TemporaryFolder folder;
  const std::string job = "stability --p 0:1:2 --d 0:1:2 --output ";
  for (const InstructionSet set : available_instruction_sets()) {
    const auto file = folder / (std::string(name_of(set)) + ".csv");
    ASSERT_EQ(run_holdfast(job + file.string() + with(set)).exit_code, 0);
    EXPECT_EQ(origin_of(file)["instructions"], name_of(set));
    EXPECT_FALSE(origin_of(file)["options"].contains("--instructions"));
  }
  const auto other = folder / "modes.csv";
  ASSERT_EQ(run_holdfast("modes --output " + other.string()).exit_code, 0);
  EXPECT_FALSE(origin_of(other).contains("instructions"));
}

/// A sweep on the baseline that was stopped after some chunks.
class BaselineSweep {
 public:
  BaselineSweep() {
    RunningProgram program(sweep_words(output(), "--instructions baseline"));
    wait_for_chunks(program, output(), 4);
    program.send(SIGKILL);
    program.wait();
  }
  std::filesystem::path output() const { return folder_ / "sweep.csv"; }

 private:
  TemporaryFolder folder_;
};

TEST(Instructions, AResumedSweepKeepsThoseOfItsTiles) {
  const BaselineSweep stopped;
  const Ending resumed = swept(stopped.output(), "--resume");
  EXPECT_EQ(resumed.exit_code, 0) << resumed.errors;
  EXPECT_EQ(origin_of(stopped.output())["instructions"], "baseline");
}

TEST(Instructions, AResumedSweepIsRefusedOthersThanThoseOfItsTiles) {
  const InstructionSet best = available_instruction_sets().back();
  if (best == InstructionSet::baseline) GTEST_SKIP() << "this processor has the baseline alone";
  const BaselineSweep stopped;
  const Ending refused = swept(stopped.output(), "--resume" + with(best));
  EXPECT_EQ(refused.exit_code, 2) << refused.errors;
  EXPECT_NE(refused.errors.find("--instructions was baseline"), std::string::npos)
      << refused.errors;
}

}  // namespace
}  // namespace holdfast::tests
