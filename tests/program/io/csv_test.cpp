#include "io/text/csv.hpp"

#include "process/errors.hpp"
#include "support/message_of.hpp"
#include "support/temporary_folder.hpp"

namespace holdfast::program {
namespace {

using tests::message_of;
using tests::read_text;
using tests::TemporaryFolder;

const double infinity = std::numeric_limits<double>::infinity();

/// What the work writes through a CsvWriter with the named columns.
template <typename Work>
std::string written(const std::vector<std::string>& names, const Work& work) {
  const TemporaryFolder folder;
  OutputFile output(folder / "out.csv");
  std::vector<Column> columns;
  for (const std::string& name : names) columns.push_back({name, "", ""});
  CsvWriter writer(output, columns);
  work(writer);
  writer.flush();
  output.commit();
  return read_text(folder / "out.csv");
}

TEST(CsvWriter, HasAHeaderAndEndsEveryRowAsTheStandardSays) {
  const std::string text = written({"time_s", "count", "name"}, [](CsvWriter& writer) {
    writer.row(0.5, 12, "spring");
    writer.row(-infinity, -3L, std::string("rigid"));
    writer.row(std::nan(""), std::size_t{7}, std::string_view(""));
    writer.row(infinity, true, "x");
    EXPECT_EQ(writer.rows(), 4u);
  });
  EXPECT_EQ(text, "time_s,count,name\r\n0.5,12,spring\r\n-inf,-3,rigid\r\nnan,7,\r\ninf,1,x\r\n");
}

TEST(CsvWriter, TextComesBackThroughTheReader) {
  const std::vector<std::string> texts = {"",   "plain",   "a,b",        "say \"so\"",
                                          "\"", "\"\"",    "two\nlines", "cr\r\nlf",
                                          "\r", " blank ", ",\",\n"};
  for (const bool alone : {false, true}) {
    const std::vector<std::string> names =
        alone ? std::vector<std::string>{"te,xt"} : std::vector<std::string>{"te,xt", "other"};
    const std::string text = written(names, [&](CsvWriter& writer) {
      for (const std::string& cell : texts) {
        writer.cell(cell);
        if (!alone) writer.cell(1);
        writer.end_row();
      }
    });
    const CsvTable table = parse_csv(text, "out.csv");
    ASSERT_EQ(table.rows(), texts.size());
    for (std::size_t i = 0; i < texts.size(); ++i) EXPECT_EQ(table.text(i, "te,xt"), texts[i]);
  }
}

TEST(CsvWriter, NumbersComeBackIdentical) {
  std::mt19937_64 random(11);
  std::vector<double> values = {0.0, infinity, -infinity, std::numeric_limits<double>::denorm_min(),
                                std::numeric_limits<double>::max()};
  while (values.size() < 20000) {
    const std::uint64_t bits = random();
    double value = 0.0;
    std::memcpy(&value, &bits, sizeof(value));
    if (!std::isnan(value)) values.push_back(value);
  }
  const std::string text = written({"x"}, [&](CsvWriter& writer) {
    for (const double value : values) writer.row(value);
  });
  const std::vector<double> read = parse_csv(text, "out.csv").numbers("x");
  ASSERT_EQ(read.size(), values.size());
  EXPECT_EQ(std::memcmp(read.data(), values.data(), values.size() * sizeof(double)), 0);
  EXPECT_EQ(written({"x"}, [](CsvWriter& writer) { writer.row(-0.0); }), "x\r\n0\r\n");
}

TEST(CsvWriter, IntegersHaveAllTheirDigits) {
  const std::string text = written({"a", "b"}, [](CsvWriter& writer) {
    writer.row(std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::uint64_t>::max());
  });
  EXPECT_EQ(text, "a,b\r\n-9223372036854775808,18446744073709551615\r\n");
}

TEST(CsvWriter, ARowOfAnotherWidthIsADefect) {
  const auto write = [](const auto&... cells) {
    written({"a", "b"}, [&](CsvWriter& writer) { writer.row(cells...); });
  };
  EXPECT_THROW(write(1.0, 2.0, 3.0), std::logic_error);
  EXPECT_THROW(write(1.0), std::logic_error);
}

TEST(CsvReader, TakesEitherLineEndBlankLinesAndAByteOrderMark) {
  const CsvTable table =
      parse_csv("\xEF\xBB\xBFtime_s,displacement_m\n0,1\r\n\n 0.5 ,+2e-3\r\n1,inf", "data.csv");
  EXPECT_EQ(table.names(), (std::vector<std::string>{"time_s", "displacement_m"}));
  EXPECT_EQ(table.numbers("time_s"), (std::vector<double>{0.0, 0.5, 1.0}));
  EXPECT_EQ(table.numbers("displacement_m"), (std::vector<double>{1.0, 0.002, infinity}));
  EXPECT_EQ(table.fault(1, "x").what(), std::string("data.csv:4: x"));
}

/// Rows of time and force as other programs write them.
const std::vector<std::string> dialects = {
    "time_s,force_N\n0.5,-1.25\n1.5,2000\n",
    "time_s;force_N\n0.5;-1.25\n1.5;2000\n",
    "time_s;force_N\r\n0,5;-1,25\r\n1,5;2000\r\n",
    "time_s;force_N\n0,500;-1,250\n1,500;2e3\n",
    "time_s\tforce_N\n0.5\t-1.25\n1.5\t2000\n",
    "time_s\tforce_N\r0,5\t-1,25\r1,5\t2000\r",
    "time_s, force_N\n0.5, -1.25\n1.5, 2000\n",
    " \"time_s\" , \"force_N\" \n\"0.5\", \"-1.25\"\n 1.5 , 2000 \n",
    "\"time_s\";\"force_N\"\n\"0,5\";\"-1,25\"\n\"1,5\";2000\n",
    "time_s,force_N,\n0.5,-1.25,\n1.5,2000,\n,,\n",
    "time_s,force_N\n0.5,-1.25,,\n1.5,2000\n",
    "\xEF\xBB\xBFtime_s;force_N;\n0,5;-1,25;\n1,5;2000;\n",
    "# a shaker, Monday\ntime_s,force_N\n# a pause\n0.5,-1.25\n1.5,2000\n",
    "# a shaker, Monday\n# time_s,force_N\n0.5,-1.25\n1.5,2000\n",
    "#time_s;force_N\n0,5;-1,25\n1,5;2000\n",
    "note;time_s;force_N\n1,2 and 3.4;0,5;-1,25\n\"a;b\";1,5;2000\n",
};

TEST(CsvReader, TakesWhatOtherProgramsWriteForTheSameTable) {
  for (const std::string& text : dialects) {
    CsvTable table = parse_csv(text, "data.csv");
    table.require({"time_s", "force_N"});
    EXPECT_EQ(table.numbers("time_s"), (std::vector<double>{0.5, 1.5})) << text;
    EXPECT_EQ(table.numbers("force_N"), (std::vector<double>{-1.25, 2000.0})) << text;
  }
}

TEST(CsvReader, WhereItCannotKnowItNamesTheRemedy) {
  const auto refused = [](const std::string& text) {
    return message_of<WrongInput>([&] {
      CsvTable table = parse_csv(text, "data.csv");
      table.require({"time_s", "force_N"});
      table.numbers("force_N");
    });
  };
  const auto expect = [&](const std::string& text, const std::string& remedy) {
    const std::string message = refused(text);
    EXPECT_NE(message.find(remedy), std::string::npos) << text << '\n' << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  };
  expect("time_s,force_N\n0,5,1,25\n", "separate columns by semicolons");
  expect("time_s force_N\n0.5 1.25\n", "separate columns by commas, semicolons or tabs");
  expect("time_s;force_N\n0,5;1.25\n", "write a decimal point");
  expect("time_s;force_N\n0.5;1,25\n", "write a decimal point");
  expect("time_s\tforce_N\n1\t1,250\n2\t12,500\n", "may separate thousands");
  expect("time_s,force_N\n1,\"1,250\"\n", "write a decimal point");
  expect("time_s;force_N\n1;1.234,5\n", "is not a number");
  expect(std::string("\xFF\xFEt\0", 4), "save it as UTF-8");
}

TEST(CsvWriter, ATextThatLooksLikeACommentIsNone) {
  const std::string text =
      written({"#a", "b"}, [](CsvWriter& writer) { writer.row("# no comment", 1); });
  const CsvTable table = parse_csv(text, "out.csv");
  ASSERT_EQ(table.rows(), 1U);
  EXPECT_EQ(table.text(0, "#a"), "# no comment");
}

TEST(CsvReader, MalformedTablesAreRefusedWithFileAndLine) {
  const auto refused = [](const std::string& text) {
    return message_of<WrongInput>([&] { parse_csv(text, "data.csv"); });
  };
  const std::vector<std::pair<const char*, const char*>> faults = {
      {"a,b\n1,2\n3\n", "data.csv:3: "},
      {"a,b\n1,2,3\n", "data.csv:2: "},
      {"a\n1\n\"open\n\n", "data.csv:3: "},
      {"a\n\"x\"y\n", "data.csv:2: "},
      {"a\nx\"y\n", "data.csv:2: "},
      {"a,a\n1,2\n", "data.csv:1: "},
      {"", "data.csv: "},
      {"\n\n", "data.csv: "}};
  for (const auto& [text, place] : faults) EXPECT_EQ(refused(text).rfind(place, 0), 0U) << text;
}

TEST(CsvReader, AbsentColumnsAndWordsForNumbersAreRefused) {
  CsvTable table = parse_csv("a,b\n1,2\n\"x\ny\",3\n\nz,\n", "data.csv");
  EXPECT_EQ(message_of<WrongInput>([&] { table.numbers("c"); }),
            "data.csv: has no column \"c\", columns found: 2");
  EXPECT_EQ(message_of<WrongInput>([&] {
              table.require({"a", "c"});
            }),
            "data.csv: has no column \"c\", columns found: 2");
  // Not yet known to be what it was taken for, it is not quoted.
  EXPECT_EQ(message_of<WrongInput>([&] { table.numbers("a"); }),
            "data.csv:3: column 1 is not a number");
  table.require({"b", "a"});
  EXPECT_EQ(message_of<WrongInput>([&] { table.numbers("a"); }).rfind("data.csv:3: a = ", 0), 0u);
  // A cell that is quoted over two lines counts both.
  EXPECT_EQ(message_of<WrongInput>([&] { table.numbers("b"); }),
            "data.csv:6: b = \"\" is not a number");
}

TEST(CsvReader, AbsentFilesAreNamed) {
  const auto message = message_of<WrongInput>([] { read_csv("/nowhere/data.csv"); });
  EXPECT_NE(message.find("/nowhere/data.csv: No such file"), std::string::npos) << message;
}

}  // namespace
}  // namespace holdfast::program
