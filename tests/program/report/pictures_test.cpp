#include "process/errors.hpp"
#include "report/figures/figure.hpp"
#include "report/picture/picture_panels.hpp"
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
  draw({"line", "", "", {}, "plot [0:1] 0.25 * x notitle\n"}, folder);
}

TEST(Gnuplot, APictureThatIsCutOffIsNone) {
  // As gnuplot does on a full disk: its exit code is that of success.
  for (const std::string text : {"", "<svg>", "<svg><path/></svg", "<svg></svg><g>", "</svg>x"}) {
    const OtherGnuplot cut("printf '" + text + "'\n");
    const TemporaryFolder folder;
    const std::string words = message_of<OutputError>([&] { draw_line(folder.path()); });
    EXPECT_NE(words.find("line"), std::string::npos) << words;
    EXPECT_NE(words.find("incomplete"), std::string::npos) << words;
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
  const Figure figure{"line", "", "", {{"line", {}}}, "plot @@ using 1:2 notitle\n"};
  EXPECT_THROW(draw(figure, folder.path()), OutputError);
}

TEST(DataUrl, GoesAlongLongCurvesBySteps) {
  std::string places = "M1.00,2.00 L1.00,2.00 M60.45,278.47 L70.20,278.47 L69.00,270.02";
  for (int k = 0; k < 20; ++k) places += " L69.00,270.02";
  EXPECT_EQ(svg_url(" d='" + places + "'"), svg_url(" d='M1 2l0 0M60.5 278.5l9.7 0l-1.2-8.5'"));
}

TEST(DataUrl, HoldsADrawingThatNothingCutsShort) {
  EXPECT_EQ(svg_url("<svg a=\"50%\">\n<use href='#b'/></svg>"),
            "data:image/svg+xml;charset=utf-8,<svg a=%2250%25%22> <use href='%23b'/></svg>");
  EXPECT_EQ(png_url("\x89PNG"), "data:image/png;base64,iVBORw==");
}

namespace fs = std::filesystem;

TEST(PlainLabel, HasIndicesAndNoMarks) {
  const std::map<std::string, std::string> labels = {
      {"displacement {/:Italic z}_1 (mm)", "displacement z₁ (mm)"},
      {"|{/:Italic z}_{1,b} − {/:Italic z}_{1,a}| (m)", "|z₁,b − z₁,a| (m)"},
      {"sampling period τ (ms)", "sampling period τ (ms)"},
      {"", ""}};
  for (const auto& [label, plain] : labels) EXPECT_EQ(plain_label(label), plain);
}

std::vector<PicturePanel> panels_of_plot(const std::string& plot, const std::string& ending) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "pictures");
  Figure figure;
  figure.name = "line";
  figure.plot = plot;
  return draw(figure, folder.path(), ending).panels;
}

TEST(PicturePanels, AreWhereGnuplotHasDrawnThem) {
  if (!gnuplot_available()) GTEST_SKIP() << "without gnuplot";
  for (const char* ending : {".svg", ".png"}) {
    const auto panels = panels_of_plot(
        "set multiplot\nset lmargin at screen 0.2\nset rmargin at screen 0.9\n"
        "set bmargin at screen 0.5\nset tmargin at screen 0.9\n"
        "set ylabel \"strain (µm/m)\"\nset logscale y\nplot [0:4][0.01:100] x + 1, \\\n  x + 2\n"
        "set bmargin at screen 0.1\nset tmargin at screen 0.4\nunset logscale\n"
        "set xlabel \"time {/:Italic t} (s)\"\nset ylabel \"\"\nset y2label 'part (%)'\n"
        "set y2range [0:50]\nplot [0:4][-1:1] sin(x), x axes x1y2\nunset multiplot\n",
        ending);
    ASSERT_EQ(panels.size(), 2U);
    for (const PicturePanel& panel : panels) {
      EXPECT_NEAR(panel.left, 0.2, 2e-3);
      EXPECT_NEAR(panel.right, 0.9, 2e-3);
      EXPECT_EQ(panel.x.name, "time t");
      EXPECT_EQ(panel.x.unit, "s");
      EXPECT_EQ(panel.x.to, 4.0);
    }
    EXPECT_NEAR(panels[0].top, 0.1, 4e-3);
    EXPECT_NEAR(panels[0].bottom, 0.5, 4e-3);
    EXPECT_NEAR(panels[1].top, 0.6, 4e-3);
    EXPECT_NEAR(panels[1].bottom, 0.9, 4e-3);
    EXPECT_EQ(panels[0].y.name, "strain");
    EXPECT_TRUE(panels[0].y.logarithmic);
    EXPECT_EQ(panels[0].y.from, 0.01);
    EXPECT_EQ(panels[0].right_axis.name, "");
    EXPECT_EQ(panels[1].y.name, "");  // nothing says what it would be
    EXPECT_EQ(panels[1].right_axis.name, "part");
    EXPECT_EQ(panels[1].right_axis.to, 50.0);
  }
}

TEST(PicturePanels, KnowAxesThatCountDecades) {
  if (!gnuplot_available()) GTEST_SKIP() << "without gnuplot";
  const auto panels = panels_of_plot(
      "set xlabel \"period (ms)\"\nset ylabel \"y\"\nx_decades = 1\nplot [-1:2][0:1] x\n", ".svg");
  ASSERT_EQ(panels.size(), 1U);
  EXPECT_TRUE(panels[0].x.logarithmic);
  EXPECT_NEAR(panels[0].x.from, 0.1, 1e-12);
  EXPECT_NEAR(panels[0].x.to, 100.0, 1e-9);
  EXPECT_FALSE(panels[0].y.logarithmic);
}

TEST(PicturePanels, AreAskedBehindThePlotAndDoNotHideAComplaint) {
  const std::string asked = with_measured_panels("set key\nplot x, \\\n  y\nset grid");
  EXPECT_EQ(asked.find("set key\nplot x, \\\n  y\nif (exists('measure'))"), 0U) << asked;
  EXPECT_EQ(asked.substr(asked.size() - 9), "\nset grid");
  const std::string said =
      "panel 0 1 0 1 0 1 0 1 0 1 0 0\n\n\tlogscaling on none\n\n\n"
      "\txlabel is \"x\", offset at (character 0, 0, 0)\nline 3: no such thing\n";
  EXPECT_EQ(without_panels(said), "line 3: no such thing\n");
  EXPECT_EQ(measured_panels(said).size(), 1U);
  EXPECT_EQ(measured_panels("panel 0 1 of something else\n").size(), 0U);
}

TEST(PanelsJson, LeavesOutAxesThatSayNothing) {
  EXPECT_EQ(
      panels_json({{0.125, 0.25, 0.875, 0.75, {"time", "s", 0.0, 2.5, false}, {}, {}}}),
      R"([{"box":[0.125,0.25,0.875,0.75],"x":{"name":"time","from":0.0,"to":2.5,"unit":"s"}}])");
  EXPECT_EQ(panels_json({}), "[]");
}

}  // namespace
}  // namespace holdfast::program
