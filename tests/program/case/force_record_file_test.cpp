#include "io/text/record_file.hpp"

#include "case/case_file.hpp"
#include "case/case_source.hpp"
#include "holdfast/excitation/recorded_force.hpp"

#include "process/errors.hpp"
#include "support/message_of.hpp"
#include "support/temporary_folder.hpp"

namespace holdfast::program {
namespace {

using tests::message_of;
using tests::TemporaryFolder;
using tests::write_text;

std::string force_refusal(const std::string& text) {
  return message_of<WrongInput>([&] { read_force_text(text, "force.csv"); });
}

/// Three good rows below a header, then another one.
std::string force_rows_and(const std::string& last) {
  return "time_s,force_N\n-1,0.5\n0,-2e-3\n0.25,0\n" + last + "\n";
}

TEST(ForceRecordFile, IsRead) {
  const ForceRecord record = read_force_text(force_rows_and("1e3,+7"), "force.csv");
  EXPECT_EQ(record.times, (std::vector<double>{-1.0, 0.0, 0.25, 1000.0}));
  EXPECT_EQ(record.forces, (std::vector<double>{0.5, -2e-3, 0.0, 7.0}));
}

TEST(ForceRecordFile, TwoRowsAreEnoughAndNeedNotBeEquallyApartFromOthers) {
  EXPECT_EQ(read_force_text("time_s,force_N\n0,0\n1,0\n", "force.csv").times.size(), 2U);
  EXPECT_EQ(read_force_text(force_rows_and("1e9,0"), "force.csv").times.back(), 1e9);
}

TEST(ForceRecordFile, ColumnsMayStandInAnyOrderBesideOthersInQuotesAndWithCarriageReturns) {
  const ForceRecord record =
      read_force_text("\"force_N\",note,\"time_s\"\r\n1,x,2\r\n3,\"y,z\",4\r\n", "force.csv");
  EXPECT_EQ(record.times, (std::vector<double>{2.0, 4.0}));
  EXPECT_EQ(record.forces, (std::vector<double>{1.0, 3.0}));
}

TEST(ForceRecordFile, NamesFileAndLineOfAFault) {
  EXPECT_EQ(force_refusal(force_rows_and("1,strong")),
            "force.csv:5: force_N = \"strong\" is not a number");
  EXPECT_EQ(force_refusal(force_rows_and("soon,1")),
            "force.csv:5: time_s = \"soon\" is not a number");
  EXPECT_EQ(force_refusal(force_rows_and("1,inf")), "force.csv:5: force_N = inf: must be finite");
  EXPECT_EQ(force_refusal(force_rows_and("nan,1")), "force.csv:5: time_s = nan: must be finite");
  EXPECT_EQ(force_refusal(force_rows_and("1,")), "force.csv:5: force_N is missing");
  EXPECT_EQ(force_refusal(force_rows_and("1")), "force.csv:5: has 1 cells, the header has 2");
  for (const std::string time : {"0.25", "0.2"}) {
    EXPECT_EQ(force_refusal(force_rows_and(time + ",1")),
              "force.csv:5: time_s = " + time + " must exceed 0.25 of the row before");
  }
}

TEST(ForceRecordFile, RefusesWhatIsNoRecord) {
  EXPECT_EQ(force_refusal(""), "force.csv: has no header row; begin with a row of column names");
  EXPECT_EQ(force_refusal("time_s,force_N\n"),
            "force.csv: a force record needs at least 2 rows, but has 0");
  EXPECT_EQ(force_refusal("time_s,force_N\n0,1\n"),
            "force.csv: a force record needs at least 2 rows, but has 1");
  EXPECT_EQ(force_refusal("time_s,displacement_m\n0,1\n1,2\n"),
            "force.csv: has no column \"force_N\", columns found: 2");
  EXPECT_EQ(force_refusal("t,force_N\n0,1\n1,2\n"),
            "force.csv: has no column \"time_s\", columns found: 2");
}

/// What is doubted of a record of 100 rows, `step` s apart from `first` on, with one row later by
/// `gap` (s) and all after it.
std::string doubt_of(double first, double step, double gap) {
  std::vector<double> times;
  for (int k = 0; k < 100; ++k) times.push_back(first + step * k + (k > 40 ? gap : 0.0));
  Case the_case = load_case(std::nullopt, {});
  the_case.excitation.record = "force.csv";
  the_case.force_record = std::make_shared<const RecordedForce>(
      times, std::vector<double>(times.size(), 1.0), RecordInterpolation::linear);
  return record_doubt(the_case);
}

TEST(ForceRecord, IsDoubtedForAGapALateStartAndTimeInMilliseconds) {
  const auto expect = [](const std::string& doubt, const std::string& part) {
    EXPECT_EQ(doubt.rfind("force.csv: ", 0), 0U) << doubt;
    EXPECT_NE(doubt.find(part), std::string::npos) << doubt;
  };
  EXPECT_EQ(doubt_of(0.0, 0.01, 0.0), "");
  EXPECT_EQ(doubt_of(0.01, 0.01, 0.0), "");
  EXPECT_EQ(doubt_of(-3.0, 0.01, 0.005), "");
  expect(doubt_of(0.0, 0.01, 0.8), "a gap of 0.81 s after 0.4 s");
  expect(doubt_of(2.0, 0.01, 0.0), "its first row is at 2 s; before that the force is 0");
  expect(doubt_of(0.0, 10.0, 0.0), "(10000 sampling periods): is time_s in ms?");
  expect(doubt_of(1.7e9, 0.01, 0.8), "a gap of 0.81 s");
  expect(doubt_of(1.7e9, 0.01, 0.8), "its first row is at 1.7e+09 s");
}

TEST(ForceRecordFile, IsReadFromItsPlaceAndNamedWhereItCannotBe) {
  const TemporaryFolder folder;
  write_text(folder / "force.csv", force_rows_and("1,2"));
  EXPECT_EQ(read_force_record((folder / "force.csv").string()).forces.back(), 2.0);
  write_text(folder / "force.csv", force_rows_and("0,2"));
  const auto message = [&](const std::string& name) {
    return message_of<WrongInput>([&] { read_force_record((folder / name).string()); });
  };
  EXPECT_EQ(message("force.csv").rfind((folder / "force.csv").string() + ":5: ", 0), 0U);
  EXPECT_NE(message("absent.csv").find("absent.csv: No such file"), std::string::npos);
  EXPECT_NE(message("").find("directory"), std::string::npos) << message("");
}

}  // namespace
}  // namespace holdfast::program
