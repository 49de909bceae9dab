#include "case/model/decay/cable_decay.hpp"
#include "cli/program.hpp"

namespace holdfast::tests {
namespace {

namespace fs = std::filesystem;

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++count;
  return count;
}

void expect_every_figure_as_table_and_picture(const fs::path& report) {
  const std::string page = read_text(report / "report.html");
  std::vector<std::string> figures = {
      "fig02a", "fig03",   "fig04a",           "fig04b",       "fig04c", "fig04d",    "fig05",
      "fig05b", "fig06a",  "fig06b",           "fig07a",       "fig07b", "fig08a",    "fig08b",
      "fig09a", "fig09b",  "fig09c",           "fig10a",       "fig10b", "fig11a",    "fig11b",
      "fig12a", "fig12b",  "fig12c",           "fig13a",       "fig13b", "table2a",   "table2b",
      "orbits", "section", "diagram-backlash", "diagram-gain", "basins", "amplitudes"};
  figures.insert(figures.end(), {"success-delay-backlash", "success-frequency-delay"});
  if (program::has_sundials()) figures.insert(figures.end(), {"fig02b", "fig02c", "fig02d"});
  for (const std::string& figure : figures) {
    const std::string picture = read_text(report / "pictures" / (figure + ".svg"));
    expect_holds(picture, {"<svg", "</svg>"});
    // No viewer has to bear a transformation without an inverse.
    EXPECT_EQ(picture.find("scale(0.00)"), std::string::npos) << figure;
    expect_holds(page, {"id=\"" + figure + "\""});
  }
  const std::size_t drawings = count_of(page, "src=\"data:image/svg+xml;charset=utf-8,");
  const std::size_t dots = count_of(page, "src=\"data:image/png;base64,");
  EXPECT_EQ(drawings + dots, figures.size());
  EXPECT_GE(drawings, 30U);
  EXPECT_GE(dots, 2U);
}

/// What of a page belongs to a figure.
std::string figure_named(const std::string& page, const std::string& name) {
  const std::size_t begin = page.find("<figure id=\"" + name + "\">");
  if (begin == std::string::npos) return "";
  return page.substr(begin, page.find("</figure>", begin) - begin);
}

/// Each figure tells where its panels lie and what their axes are called, and has its command at a
/// place of its own.
void expect_every_figure_with_its_panels_and_its_command(const fs::path& report) {
  const std::string page = read_text(report / "report.html");
  const std::size_t figures = count_of(page, "<figure id=\"");
  EXPECT_EQ(count_of(page, " data-panels=\"[{&quot;box&quot;:["), figures);
  EXPECT_EQ(count_of(page, "-command\"><div class=\"label\"><a href=\"#"), figures);
  EXPECT_EQ(count_of(page, "<pre>holdfast "), figures + count_of(page, "<div class=\"answer\">"));
  for (std::size_t at = page.find("<figure id=\""); at != std::string::npos;
       at = page.find("<figure id=\"", at + 1)) {
    const std::string name = page.substr(at + 12, page.find('"', at + 12) - at - 12);
    const std::string figure = figure_named(page, name);
    expect_holds(figure, {"&quot;x&quot;:{&quot;name&quot;:", "id=\"" + name + "-command\"",
                          "href=\"#" + name + "-command\"", "href=\"pictures/" + name + ".svg\""});
  }
  const std::string three = figure_named(page, "fig04c");
  EXPECT_EQ(count_of(three, "&quot;y&quot;:{&quot;name&quot;:&quot;D&quot;"), 3U) << three;
  EXPECT_EQ(count_of(three, "&quot;unit&quot;:&quot;N s/m&quot;"), 3U);
  EXPECT_NE(figure_named(page, "fig02b").find("&quot;right&quot;:{&quot;name&quot;:"),
            std::string::npos);
  // An axis that counts decades says what it shows.
  EXPECT_EQ(count_of(figure_named(page, "success-delay-backlash"), "&quot;log&quot;:true"), 2U);
}

void expect_no_partial_file_and_metadata_beside_every_table(const fs::path& report) {
  for (const auto& entry : fs::recursive_directory_iterator(report)) {
    EXPECT_EQ(entry.path().string().find("partial"), std::string::npos) << entry.path();
    if (entry.path().extension() == ".csv") {
      EXPECT_TRUE(fs::exists(entry.path().string() + "-metadata.json")) << entry.path();
      EXPECT_GE(program::read_csv(entry.path()).rows(), 2U) << entry.path();
    }
  }
}

void expect_nothing_loaded_from_elsewhere(const fs::path& report) {
  const std::string page = read_text(report / "report.html");
  for (const char* loading :
       {"src=\"http", "src=\"//", "href=\"http", "url(", "@import", "<link", "<script src",
        "<iframe", "<object", "fetch(", "XMLHttpRequest", "import("})
    EXPECT_EQ(count_of(page, loading), 0U) << loading;
  EXPECT_EQ(count_of(page, "<script"), 1U);
  EXPECT_EQ(count_of(page, " src=\""), count_of(page, " src=\"data:"));
  expect_holds(page, {"<html lang=\"en\">",
                      "http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'"});
}

/// The part of the page between a text and the next one after it; empty where the first is not.
std::string part_between(const std::string& page, const std::string& from, const std::string& to) {
  const std::size_t begin = page.find(from);
  if (begin == std::string::npos) return "";
  return page.substr(begin, page.find(to, begin + from.size()) - begin);
}

/// The two rows of a motion, from the cell that names it to the end of its command.
std::string motion_named(const std::string& page, const std::string& cell) {
  const std::string section = part_between(page, "<h2 id=\"motions\">", "<h2>Figures</h2>");
  return part_between(section, "<td>" + cell + "</td>", "</code>");
}

// The forcing has 10 Hz. A sample falls on its own phase again after 100 samples of 11 ms, 11
// forcing periods; the periods are those that the exact solution of the contacts has.
void expect_what_the_motions_are(const fs::path& report) {
  const std::string page = read_text(report / "report.html");
  EXPECT_EQ(count_of(page, "<tr class=\"motion\">"), 11U);
  EXPECT_EQ(count_of(page, "<td class=\"verdict\">periodic("), 11U);
  expect_holds(motion_named(page, "Figs. 6, 7a, 8, 9a"),
               {"periodic(100)", "0.1 s; 100 samples; 1 forcing period<",
                "holdfast orbit --certificate --set control.sampling_period=0.001 --set "
                "backlash.width=0.0005"});
  expect_holds(motion_named(page, "Fig. 7b"), {"periodic(30)", "3 forcing periods"});
  expect_holds(motion_named(page, "Figs. 9b, 10a, 11a, 13a, Table 2"),
               {"periodic(500)", "0.5 s; 500 samples; 5 forcing periods"});
  expect_holds(motion_named(page, "Figs. 9c, 10b, 11b, 12, 13b, Table 2"),
               {"periodic(2100)", "23.1 s; 2100 samples; 231 forcing periods", "Certified orbit"});
  expect_holds(motion_named(page, "Fig. 11b, the neighbour"),
               {"periodic(2100)", "--set initial.z1=1e-5"});
}

/// Whether each settled motion that is sampled clearly faster than the limit attenuates, and none
/// that is sampled clearly more slowly. The limit is one of frequency responses, of the best of all
/// stabilising gains; the map is one of motions, of gains that keep away from
/// the boundary of stability: near the limit they differ, the more the lower the frequency.
/// @return the number of cells compared: below the limit, above it
std::pair<int, int> expect_same_limit(const program::CsvTable& map,
                                      const program::CsvTable& limits) {
  int below = 0, above = 0;
  for (std::size_t row = 0, limit = 0; row < map.rows(); ++row) {
    const double frequency = map.number(row, "excitation.frequency");
    while (limits.number(limit, "frequency_Hz") < frequency - 1e-9) ++limit;
    const bool same_frequency = limits.number(limit, "frequency_Hz") < frequency + 1e-9;
    if (!same_frequency || map.text(row, "outcome") != "computed") continue;
    const double ratio =
        map.number(row, "control.sampling_period") / limits.number(limit, "max_sampling_period_s");
    if (ratio > 1.2) continue;  // far above, another range of periods may attenuate
    if (ratio > 0.65 && ratio < 1.05) continue;
    EXPECT_EQ(map.text(row, "attenuates"), ratio < 1.0 ? "1" : "0") << "row " << row;
    ++(ratio < 1.0 ? below : above);
  }
  return {below, above};
}

void expect_the_motions_without_backlash_keep_the_limit(const fs::path& report) {
  const auto [below, above] =
      expect_same_limit(program::read_csv(report / "data/success-frequency-delay-1.csv"),
                        program::read_csv(report / "data/success-frequency-delay-limit.csv"));
  EXPECT_GE(below, 400);
  EXPECT_GE(above, 5);
}

/// What a sweep found of a cell whose sampling period and frequency are these, and what the same
/// sweep found with backlash: half a forcing period from sample to sample shows no vibration, and a
/// D is sought without regard to the backlash.
void expect_reason_for_no_motion(double forcing_periods_per_sample, const std::string& outcome,
                                 const std::string& with_backlash) {
  EXPECT_NE(outcome, "invalid");
  EXPECT_NE(with_backlash, "invalid");
  EXPECT_EQ(outcome == "aliased", forcing_periods_per_sample >= 0.5);
  EXPECT_EQ(with_backlash == "aliased", forcing_periods_per_sample >= 0.5);
  EXPECT_EQ(outcome == "no_gain", with_backlash == "no_gain");
}

void expect_cells_without_motion_to_have_their_reasons(const fs::path& report) {
  const auto map = program::read_csv(report / "data/success-frequency-delay-1.csv");
  const auto backlash = program::read_csv(report / "data/success-frequency-delay-2.csv");
  ASSERT_EQ(map.rows(), backlash.rows());
  std::map<std::string, int> cells;
  for (std::size_t row = 0; row < map.rows(); ++row) {
    SCOPED_TRACE("row " + std::to_string(row));
    const std::string& outcome = map.text(row, "outcome");
    expect_reason_for_no_motion(
        map.number(row, "control.sampling_period") * map.number(row, "excitation.frequency"),
        outcome, backlash.text(row, "outcome"));
    ++cells[outcome];
  }
  for (const std::string kind : {"computed", "no_gain", "aliased"}) EXPECT_GE(cells[kind], 50);
}

/// The text of the pictures of the maps, and of what the page says of each.
void expect_maps_to_name_every_mark(const fs::path& report) {
  for (const std::string figure : {"success-delay-backlash", "success-frequency-delay"}) {
    const std::string picture = read_text(report / "pictures" / (figure + ".svg"));
    expect_holds(picture, {"control amplifies", "settles in time", "sampled too slowly"});
    EXPECT_EQ(count_of(picture, "no vibration"), 0U) << figure;
  }
  const std::string page = read_text(report / "report.html");
  expect_holds(page, {"grey with marks ×: no D lets the motion settle in time",
                      "light grey with marks ○: 2fτ ≥ 1"});
  EXPECT_EQ(count_of(page, "Nothing excites"), 0U);
}

// One report for all that is to be seen in it: it takes seconds.
TEST(PaperReport, OfTheBuiltInCaseIsWholeAndSelfContained) {
  const TemporaryFolder folder;
  const fs::path report = folder / "report";
  printed_by("report --output '" + report.string() + "'");
  expect_every_figure_as_table_and_picture(report);
  expect_every_figure_with_its_panels_and_its_command(report);
  EXPECT_LE(fs::file_size(report / "report.html"), 3000000U);
  expect_no_partial_file_and_metadata_beside_every_table(report);
  expect_nothing_loaded_from_elsewhere(report);
  expect_what_the_motions_are(report);
  expect_the_motions_without_backlash_keep_the_limit(report);
  expect_cells_without_motion_to_have_their_reasons(report);
  expect_maps_to_name_every_mark(report);
}

/// The report of a case, in a folder of its own.
class Report : public ::testing::Test {
 protected:
  const fs::path& place() const { return place_; }
  std::string options(const std::string& settings) const {
    return "report " + settings + " --output '" + place_.string() + "'";
  }
  std::string page_of(const std::string& settings) const {
    printed_by(options(settings));
    return read_text(place_ / "report.html");
  }
  std::string picture(const std::string& figure) const {
    return read_text(place_ / "pictures" / (figure + ".svg"));
  }

 private:
  TemporaryFolder folder_;
  fs::path place_ = folder_ / "mine";
};

TEST_F(Report, OfAnotherCaseShowsItsOwnFigures) {
  EXPECT_EQ(printed_by(options("--set control.sampling_period=0.005")),
            "Report: " + (place() / "report.html").string() + "\n");
  const std::string page = read_text(place() / "report.html");
  expect_holds(page, {"<title>A controlled cable: 10 Hz, τ = 5 ms, r₀ = 0.5 mm</title>",
                      "id=\"stability\""});
  EXPECT_EQ(count_of(page, "<tr class=\"motion\">"), 1U);
  expect_holds(motion_named(page, "this case"),
               {"τ = 5 ms, r₀ = 0.5 mm", "Certified orbit", "forcing period",
                "holdfast orbit --set control.sampling_period=0.005 --certificate"});
}

TEST_F(Report, BeginsSweepsAnewThatAnInterruptedOneHasLeft) {
  const fs::path left = place() / "data/success-delay-backlash-1.csv.zarr";
  printed_by("sweep --axis backlash.width=0,1 --output '" + left.string() + "'");
  write_text(left / "lock", "");
  const std::string page = page_of("--set control.processing_delay=0.001");
  EXPECT_FALSE(fs::exists(left));
  for (const std::string figure : {"success-delay-backlash", "success-frequency-delay"}) {
    expect_holds(page, {"id=\"" + figure + "\""});
    EXPECT_NE(picture(figure), "") << figure;
  }
}

TEST_F(Report, OfACableThatNothingExcitesSaysThatItDoesNotVibrate) {
  expect_holds(page_of("--set excitation.amplitude=0"), {"Nothing excites this cable"});
  for (const std::string figure : {"success-delay-backlash", "success-frequency-delay"})
    EXPECT_EQ(count_of(picture(figure), "no vibration"), 2U) << figure;
}

TEST_F(Report, OfADivergingCaseSaysSoInThePage) {
  const std::string page =
      page_of("--set control.sampling_period=0.011 --set control.processing_delay=0.011");
  expect_holds(page, {"No picture: the motion diverges"});
  expect_holds(motion_named(page, "this case"), {"<td class=\"verdict\">diverges</td>",
                                                 "exceeded all bounds", "holdfast verdict --set"});
}

TEST_F(Report, OnTheConductorShowsItsModes) {
  const std::string string =
      "--set plant.model=string --set plant.modes=3 --set control.differential_gain=-2";
  const std::string page = page_of(string);
  expect_holds(page, {"Damping of the conductor&#39;s modes", "two masses and the cable",
                      "Are these results valid on the cable?"});
  EXPECT_EQ(page.find("No picture"), std::string::npos);
  EXPECT_EQ(read_text(place() / "data/modal-damping-control.csv"),
            run_holdfast("modal-damping --count 40 --quiet " + string).output);
}

TEST_F(Report, OfALoopWithAFilterShowsItsOwnFigures) {
  expect_holds(page_of("--set control.measurement_filter=100"),
               {"Stable gains", "Largest sampling period", "No picture: deviation"});
  for (const char* figure : {"stability", "delay", "contact", "spectrum"})
    EXPECT_NE(picture(figure), "") << figure;
}

}  // namespace
}  // namespace holdfast::tests
