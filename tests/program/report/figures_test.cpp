#include "case/case_source.hpp"
#include "case/model/decay/cable_decay.hpp"
#include "case/model/plant_of_case.hpp"
#include "case/model/resolved_plant.hpp"
#include "holdfast/math/signal/decay_measures.hpp"
#include "report/figures/figure.hpp"
#include "report/page/html.hpp"
#include "support/testing.hpp"

namespace holdfast::program {
namespace {

Case case_of(const std::string& text) {
  CaseSource source;
  source.text = text;
  source.name = "mine.toml";
  Case the_case = source.load();
  settle_plant(the_case);
  return the_case;
}

/// A stay of a bridge, whose plant is far from its own motion, and the paper's conductor.
constexpr const char* stay =
    "[conductor]\nmass_per_length = 60\nspan = 100\nsag = 0.184\narea = 0.006\n"
    "youngs_modulus = 1.95e11\ndamping_ratio = 0.001\n[absorber]\nmass = 30\nposition = 3\n"
    "[control]\nproportional_gain = \"tuned\"\ndifferential_gain = -1000\n"
    "sampling_period = 0.001\n[excitation]\namplitude = 0.5\nfrequency = 10\n";
constexpr const char* span =
    "[conductor]\nmass_per_length = 0.0654\nspan = 6.4\nsag = 0.29\narea = 5.5e-6\n"
    "youngs_modulus = 18e9\ndamping_ratio = 0.02\n[absorber]\nmass = 0.16\nposition = 0.64\n"
    "[control]\nproportional_gain = -557\ndifferential_gain = -13\nsampling_period = 0.001\n"
    "[excitation]\namplitude = 0.5\nfrequency = 10\n";

std::string decay_caption(const Case& the_case) {
  for (const Figure& figure : figures_of(the_case, false))
    if (figure.name == "decay") return figure.caption;
  return "";
}

TEST(Figures, JudgeInWordsHowWellThePlantStandsForItsCable) {
  if (!has_sundials()) GTEST_SKIP() << "without SUNDIALS";
  for (const char* text : {stay, span}) {
    const Case the_case = case_of(text);
    const std::string caption = decay_caption(the_case);
    const CableDecayOptions options = usual_decay(the_case);
    const CableDecay cable = cable_decay(the_case, options);
    const DecayRecord plant = plant_decay(plant_of(the_case), options.force, true, cable);
    const double of_plant = 1.0 / decay_measures(plant).period;
    const double of_cable = 1.0 / decay_measures(cable.record).period;
    for (const double frequency : {of_plant, of_cable})
      EXPECT_NE(caption.find(rounded(frequency, 4) + " Hz for the"), std::string::npos)
          << caption << frequency;
    const bool apart = std::abs(of_plant / of_cable - 1.0) > 0.05;
    EXPECT_EQ(caption.find("They differ") != std::string::npos, apart) << caption;
    EXPECT_EQ(caption.find('@'), std::string::npos) << caption;
  }
}

TEST(Page, ShowsPicturesOnATelephoneAtASizeThatCanBeRead) {
  Page page;
  page.figures.push_back({{"a", "title", "caption", {}, "plot x", 300.0}, {}, {}, ""});
  const std::string html = html_of(page);
  EXPECT_NE(html.find("name=\"viewport\" content=\"width=device-width"), std::string::npos);
  EXPECT_NE(html.find("<div class=\"scroll\"><a class=\"view\" href=\"pictures/a.svg\"><img"),
            std::string::npos);
  const std::size_t narrow = html.find("@media screen and (max-width");
  ASSERT_NE(narrow, std::string::npos);
  // Its letters have 13 px where the picture, 640 px wide in itself, is not made narrower.
  const std::size_t width = html.find("width: ", html.find("figure img", narrow)) + 7;
  EXPECT_GE(std::strtod(html.c_str() + width, nullptr) * 16.0, 640.0);
}

TEST(Page, ShowsAndLinksTheCommandsOfAFigure) {
  Page page;
  page.figures.push_back(
      {{"a", "title", "caption", {}, "plot x", 300.0}, {"holdfast one", "holdfast two"}, {}, ""});
  page.figures.push_back(
      {{"b", "other", "caption", {}, "plot x", 300.0}, {"holdfast three"}, {}, "no such thing"});
  const std::string html = html_of(page);
  for (const char* part :
       {"<figure id=\"a\">", "<a class=\"anchor\" href=\"#a\"", "<li><a href=\"#b\">other</a></li>",
        "id=\"a-command\"><div class=\"label\"><a href=\"#a-command\">The commands that make "
        "it</a>",
        "<pre>holdfast one\nholdfast two\n</pre>", "The command that makes it",
        "<p class=\"none\">No picture: no such thing</p>"})
    EXPECT_NE(html.find(part), std::string::npos) << part;
  EXPECT_EQ(html.find("pictures/b.svg"), std::string::npos);
}

TEST(Page, SaysWhatItsPicturesShowAndWhereTheirAxesAre) {
  Page page;
  PagePicture picture{"data:image/svg+xml;charset=utf-8,<svg>&amp;</svg>", {}};
  picture.panels.push_back({0.1, 0.2, 0.9, 0.8, {"time t", "s", 0, 1}, {"a < b", "", 0, 2}, {}});
  page.figures.push_back({{"a", "title", "caption", {}, "plot x", 300.0}, {}, picture, ""});
  const std::string html = html_of(page);
  for (const char* part :
       {"alt=\"title: a &lt; b over time t\"", "height=\"300\"",
        "data-panels=\"[{&quot;box&quot;:[0.1,0.2,0.9,0.8]", "<svg>&amp;amp;</svg>\""})
    EXPECT_NE(html.find(part), std::string::npos) << part;
}

}  // namespace
}  // namespace holdfast::program
