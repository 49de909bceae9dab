#include "io/text/record_file.hpp"

#include "process/errors.hpp"
#include "support/message_of.hpp"
#include "support/testing.hpp"

namespace holdfast::program {
namespace {

using holdfast::tests::message_of;

/// Ten good rows below a header, with one of them replaced.
std::string record_with(int row, const std::string& replacement) {
  std::string text = "time_s,displacement_m\n";
  for (int k = 0; k < 10; ++k) {
    const std::string good = "0." + std::to_string(k) + ",0.00" + std::to_string(9 - k);
    text += (k == row ? replacement : good) + "\n";
  }
  return text;
}

std::string refusal(const std::string& text) {
  return message_of<WrongInput>([&] { read_decay_text(text, "decay.csv"); });
}

TEST(DecayFile, IsRead) {
  const DecayRecord record = read_decay_text(record_with(-1, ""), "decay.csv");
  ASSERT_EQ(record.times.size(), 10U);
  EXPECT_EQ(record.times[3], 0.3);
  EXPECT_EQ(record.displacements[0], 0.009);
}

TEST(DecayFile, ColumnsMayStandInAnyOrderBesideOthersInQuotesAndWithCarriageReturns) {
  std::string text = "\"displacement_m\",note,\"time_s\"\r\n";
  for (int k = 0; k < 9; ++k) text += "1e-3,x," + std::to_string(k) + "\r\n";
  const DecayRecord record = read_decay_text(text, "decay.csv");
  EXPECT_EQ(record.times.back(), 8.0);
  EXPECT_EQ(record.displacements.back(), 1e-3);
}

TEST(DecayFile, NamesFileAndLineOfAFault) {
  const std::vector<std::tuple<int, const char*, const char*>> faults = {
      {4, "0.4,fast", "6: displacement_m = \"fast\" is not a number"},
      {4, "0.4,nan", "6: displacement_m = nan: must be finite"},
      {4, "0.4,", "6: displacement_m is missing"},
      {4, "0.4", "6: has 1 cells, the header has 2"},
      {4, ",0.001", "6: time_s is missing"},
      {4, "0.3,0.001", "6: time_s = 0.3 must exceed 0.3 of the row before"},
      {0, "0.0,0", "2: displacement_m = 0: a decay must start with a displacement other than 0"}};
  for (const auto& [row, text, said] : faults)
    EXPECT_EQ(refusal(record_with(row, text)), std::string("decay.csv:") + said);
}

/// 200 instants that are 10 ms apart, each off by 4 ms at most.
std::vector<double> jittering_times() {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> jitter(-0.004, 0.004);
  std::vector<double> times;
  for (int k = 0; k < 200; ++k) times.push_back(0.01 * k + jitter(random));
  return times;
}

TEST(Gaps, OfStampsThatJitterThereIsNone) {
  std::vector<double> times = jittering_times();
  EXPECT_EQ(gap_text(times), "");
  for (std::size_t k = 120; k < times.size(); ++k) times[k] += 0.8;
  EXPECT_EQ(gap_text(times).rfind("a gap of 0.8", 0), 0U) << gap_text(times);
}

TEST(Gaps, AreNoneWhereFewRowsSayAllOfAForce) {
  EXPECT_EQ(gap_text({0.0, 1e-3}), "");
  EXPECT_EQ(gap_text({0.0, 1.0, 1.001, 50.0}), "");
}

TEST(DecayFile, StampsAreData) {
  const DecayRecord record = read_decay_text(record_with(4, ""), "decay.csv");
  EXPECT_EQ(record.times.size(), 9U);
  EXPECT_EQ(record.times[4], 0.5);
}

TEST(DecayFile, RefusesWhatIsNoRecord) {
  std::string other = record_with(-1, "");
  other.replace(0, 6, "second");
  EXPECT_NE(refusal(other).find("time_s"), std::string::npos) << refusal(other);
  EXPECT_NE(refusal("").find("no header row"), std::string::npos);
  EXPECT_NE(refusal("time_s,displacement_m\n0,1\n1,0.5\n").find("8 rows"), std::string::npos);
  EXPECT_THROW(read_decay_file("/nowhere/decay.csv"), WrongInput);
}

}  // namespace
}  // namespace holdfast::program
