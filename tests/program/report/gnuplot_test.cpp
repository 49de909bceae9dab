#include "report/figures/gnuplot.hpp"

#include "process/errors.hpp"
#include "support/message_of.hpp"
#include "support/other_gnuplot.hpp"
#include "support/temporary_folder.hpp"
#include "support/testing.hpp"

namespace holdfast::program {
namespace {

namespace fs = std::filesystem;
using tests::message_of;
using tests::OtherGnuplot;
using tests::read_text;
using tests::TemporaryFolder;
using tests::Variable;
using tests::write_text;

void draw_line(const fs::path& folder) {
  fs::create_directory(folder / "pictures");
  Figure figure;
  figure.name = "line";
  figure.plot = "plot [0:1] 0.25 * x notitle\n";
  draw(figure, folder);
}

TEST(Gnuplot, APictureThatIsCutOffIsNone) {
  // As gnuplot does on a full disk: its exit code is that of success.
  for (const std::string text : {"", "<svg>", "<svg><path/></svg", "<svg></svg><g>", "</svg>x"}) {
    const OtherGnuplot cut("printf '" + text + "'\n");
    const TemporaryFolder folder;
    const std::string words = message_of<OutputError>([&] { draw_line(folder.path()); });
    EXPECT_NE(words.find("line"), std::string::npos) << words;
    EXPECT_NE(words.find("cut off"), std::string::npos) << words;
    EXPECT_FALSE(fs::exists(folder / "pictures/line.svg"));
    EXPECT_EQ(std::distance(fs::directory_iterator(folder / "pictures"), {}), 1) << "its script";
  }
}

TEST(Gnuplot, APictureThatIsNotDrawnTellsWhy) {
  const OtherGnuplot failing("printf '<svg></svg>'; echo 'no such function' >&2; exit 3\n");
  const TemporaryFolder folder;
  const std::string words = message_of<OutputError>([&] { draw_line(folder.path()); });
  EXPECT_NE(words.find("no such function"), std::string::npos) << words;
  EXPECT_FALSE(fs::exists(folder / "pictures/line.svg"));
}

TEST(Gnuplot, DoesNotReadWhatTheUserWroteForIt) {
  if (!gnuplot_available()) GTEST_SKIP() << "without gnuplot";
  const TemporaryFolder plain, altered, home;
  draw_line(plain.path());
  for (const char* name : {".gnuplot", "gnuplotrc"})
    write_text(home / name,
               "system \"touch " + (home / "evil").string() + "\"\nset title 'mine'\n");
  const Variable at_home("HOME", home.path().string()),
      library("GNUPLOT_LIB", home.path().string()), terminal("GNUTERM", "png");
  draw_line(altered.path());
  EXPECT_FALSE(fs::exists(home / "evil"));
  EXPECT_EQ(read_text(altered / "pictures/line.svg"), read_text(plain / "pictures/line.svg"));
}

TEST(Gnuplot, FindsItsTablesInTheReportAlone) {
  if (!gnuplot_available()) GTEST_SKIP() << "without gnuplot";
  const TemporaryFolder folder, library;
  fs::create_directories(library / "data");
  write_text(library / "data/line.csv", "x,y\n0,0\n1,1\n");
  fs::create_directory(folder / "pictures");
  const Variable path("GNUPLOT_LIB", library.path().string());
  Figure figure;
  figure.name = "line";
  figure.tables = {{"line", {}}};
  figure.plot = "plot @@ using 1:2 notitle\n";
  EXPECT_THROW(draw(figure, folder.path()), OutputError);
}

}  // namespace
}  // namespace holdfast::program
