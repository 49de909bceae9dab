#include "io/text/record_file.hpp"

#include "process/errors.hpp"
#include "support/message_of.hpp"
#include "support/temporary_folder.hpp"
#include "support/testing.hpp"

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
              "force.csv:5: time_s = " + time + " does not come after 0.25 of the row before");
  }
}

TEST(ForceRecordFile, RefusesWhatIsNoRecord) {
  EXPECT_EQ(force_refusal(""), "force.csv: has no header row");
  EXPECT_EQ(force_refusal("time_s,force_N\n"),
            "force.csv: a force record needs 2 rows at least, here are 0");
  EXPECT_EQ(force_refusal("time_s,force_N\n0,1\n"),
            "force.csv: a force record needs 2 rows at least, here are 1");
  EXPECT_EQ(force_refusal("time_s,displacement_m\n0,1\n1,2\n"),
            "force.csv: has no column \"force_N\" among its 2");
  EXPECT_EQ(force_refusal("t,force_N\n0,1\n1,2\n"),
            "force.csv: has no column \"time_s\" among its 2");
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
