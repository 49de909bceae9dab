#include <nlohmann/json.hpp>

#include "cli/program.hpp"
#include "cli/sweep/stopped_sweep.hpp"
#include "kernels/instruction_set.hpp"
#include "process/errors.hpp"

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
  expect_refused("stability --instructions sse9", {"sse9", "avx512"});
  EXPECT_THROW(program::chosen_instruction_set("sse9"), program::WrongInput);
}

TEST(Instructions, AnUnavailableSetIsWrongInputThatNamesTheAvailableOnes) {
  const auto available = available_instruction_sets();
  for (const InstructionSet set :
       {InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512}) {
    const bool has = std::count(available.begin(), available.end(), set) > 0;
    const std::string job = "stability --p 0:1:2 --d 0:1:2" + with(set);
    if (has)
      printed_by(job);
    else
      expect_refused(job, {"it has baseline"});
  }
}

TEST(Instructions, WithoutTheOptionTheBestIsTaken) {
  EXPECT_EQ(program::chosen_instruction_set(""), available_instruction_sets().back());
  EXPECT_EQ(available_instruction_sets().front(), InstructionSet::baseline);
  expect_holds(printed_by("--version"),
               {"instructions " + std::string(name_of(available_instruction_sets().back()))});
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
    printed_by(job + file.string() + with(set));
    EXPECT_EQ(origin_of(file)["instructions"], name_of(set));
    EXPECT_FALSE(origin_of(file)["options"].contains("--instructions"));
  }
  const auto other = folder / "modes.csv";
  printed_by("modes --output " + other.string());
  EXPECT_FALSE(origin_of(other).contains("instructions"));
}

TEST(Instructions, AResumedSweepKeepsThoseOfItsTiles) {
  const StoppedSweep stopped(SIGKILL, "sweep.csv", "--instructions baseline");
  const Ending resumed = swept(stopped.output(), "--resume");
  EXPECT_EQ(resumed.exit_code, 0) << resumed.errors;
  EXPECT_EQ(origin_of(stopped.output())["instructions"], "baseline");
}

TEST(Instructions, AResumedSweepIsRefusedOthersThanThoseOfItsTiles) {
  const InstructionSet best = available_instruction_sets().back();
  if (best == InstructionSet::baseline) GTEST_SKIP() << "this processor has the baseline alone";
  const StoppedSweep stopped(SIGKILL, "sweep.csv", "--instructions baseline");
  const Ending refused = swept(stopped.output(), "--resume" + with(best));
  EXPECT_EQ(refused.exit_code, 2) << refused.errors;
  expect_holds(refused.errors, {"--instructions was baseline"});
}

}  // namespace
}  // namespace holdfast::tests
