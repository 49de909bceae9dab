#include "report/picture/picture_panels.hpp"

#include "report/figures/gnuplot.hpp"
#include "support/temporary_folder.hpp"
#include "support/testing.hpp"

namespace holdfast::program {
namespace {

namespace fs = std::filesystem;
using tests::TemporaryFolder;

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
