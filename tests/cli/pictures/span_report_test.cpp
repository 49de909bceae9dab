#include "cli/program.hpp"
#include "report/figures/figure.hpp"

namespace holdfast::tests {
namespace {

namespace fs = std::filesystem;

std::string data_file(const std::string& name) {
  return std::string(HOLDFAST_SOURCE_DIR) + "/data/" + name;
}

/// The Drake line with a damper at each end.
const std::string line = " --case '" + data_file("acsr-drake-300m-dampers.toml") + "'";
const std::string stay = " --case '" + data_file("stay-cable-300m.toml") + "'";

/// The page without what is drawn.
std::string page_of(const fs::path& report) {
  std::string page = read_text(report / "report.html");
  for (std::size_t at = 0; (at = page.find("src=\"data:", at)) != std::string::npos; ++at)
    page.erase(at, page.find('"', at + 5) - at);
  return page;
}

fs::path written_report(const std::string& of_case, const TemporaryFolder& folder) {
  fs::path report = folder / "report";
  printed_by("report --for span" + of_case + " --output '" + report.string() + "'");
  return report;
}

/// Each table of the report is what the command beside it writes.
void expect_tables_of_their_jobs(const fs::path& report,
                                 const std::vector<std::pair<std::string, std::string>>& tables) {
  const std::string page = page_of(report);
  for (const auto& [name, command] : tables) {
    const std::string written = read_text(report / "data" / (name + ".csv"));
    EXPECT_EQ(written, run_holdfast(command + " --quiet").output) << name;
    expect_holds(page, {"data/" + name + ".csv"});
  }
}

TEST(SpanReport, ShowsWhatTheJobsTellOfALine) {
  const TemporaryFolder folder;
  const fs::path report = written_report(line, folder);
  const std::string range = " --frequency 7.1:57", steps = range + ":200";
  expect_tables_of_their_jobs(
      report, {{"aeolian", "aeolian" + line + steps},
               {"absorption-left", "absorption" + line + steps + " --end left"},
               {"absorption-right", "absorption" + line + steps + " --end right"},
               {"modal-damping", "modal-damping --count 200 --set plant.model=string" + line},
               {"damage", "fatigue --by-speed" + line + range},
               {"damage-year", "fatigue" + line + range}});
  const std::string page = page_of(report);
  for (const std::string figure :
       {"aeolian", "absorption-left", "absorption-right", "modal-damping", "damage"}) {
    expect_holds(page, {"id=\"" + figure + "\""});
    if (!program::gnuplot_available()) continue;
    expect_holds(read_text(report / "pictures" / (figure + ".svg")), {"<svg", "</svg>"});
    expect_holds(page, {"href=\"pictures/" + figure + ".svg\"><img"});
  }
  // The wind's panels lie one above the other, over one frequency.
  if (program::gnuplot_available())
    expect_holds(page, {"amplitude y/d over frequency of vibration f; strain, zero to peak over "
                        "frequency of vibration f"});
  expect_holds(page, {"vibrate without devices?", "vibrate with the devices?", "150 peak to peak",
                      "winds of 1 to 8 m/s", "no computer acts on this span",
                      "(wind, self-damping) the conductor lives less"});
  EXPECT_EQ(page.find("Not computed"), std::string::npos);
  EXPECT_EQ(page.find("No picture"), std::string::npos);
}

TEST(SpanReport, IsTheSamePageForTheSameCase) {
  const TemporaryFolder first, second;
  EXPECT_EQ(read_text(written_report(line, first) / "report.html"),
            read_text(written_report(line, second) / "report.html"));
}

// The numbers of the words, by the tables.
TEST(SpanReport, ItsAnswersHaveTheNumbersOfItsTables) {
  const TemporaryFolder folder;
  const fs::path report = written_report(line, folder);
  const std::string page = page_of(report);
  const auto year = program::read_csv(report / "data/damage-year.csv");
  const auto years = [&](const std::string& quantity, const std::string& column) {
    const double value = value_of(year, quantity, column);
    return value > 1000.0 ? "more than 1000" : program::rounded(value, 2);
  };
  expect_holds(page, {years("life", "value") + " years, by the laws from " +
                          years("life", "lowest") + " to " + years("life", "highest"),
                      "the devices " + years("life_bare", "value") + " years, by the laws from " +
                          years("life_bare", "lowest") + " to " + years("life_bare", "highest")});
  const auto rows = program::read_csv(report / "data/aeolian.csv");
  const auto amplitudes = rows.numbers("amplitude_m");
  const double most = *std::max_element(amplitudes.begin(), amplitudes.end());
  expect_holds(page, {" to " + program::rounded(most / 0.028143, 2) + " diameters"});
  const auto left = program::read_csv(report / "data/absorption-left.csv");
  const auto taken = left.numbers("absorbed_fraction");
  expect_holds(
      page,
      {"At the left end the devices absorb from " +
           program::rounded(100 * *std::min_element(taken.begin(), taken.end()), 2),
       "to " + program::rounded(100 * *std::max_element(taken.begin(), taken.end()), 3) + " %"});
}

TEST(SpanReport, SaysWhatToGiveForWhatItLeavesOut) {
  const TemporaryFolder folder;
  const std::string of_stay = page_of(written_report(stay, folder));
  expect_holds(of_stay, {"Not computed: fatigue needs the outer wires of the conductor: give",
                         "No picture: fatigue needs the outer wires", "The strain is unknown: give",
                         "right end nothing is absorbed: no device is there", "mode 3, 1.21 Hz"});
  const TemporaryFolder second;
  const std::string bare = page_of(written_report(
      " --set conductor.name=Drake --set conductor.span=300 --set conductor.tension=28020",
      second));
  expect_holds(bare, {"No device is on the span: give [[device]]",
                      "No picture: no device is on the span: give [[device]]",
                      "the case does not describe the wind at its site: give [site]"});
}

TEST(SpanReport, TellsWhetherTheLoopOfAnAbsorberIsStable) {
  const std::string active =
      " --set conductor.name=Drake --set conductor.span=300 --set conductor.tension=28020 --set "
      "conductor.damping_ratio=0.0002 --set plant.model=string --set plant.absorber_mass=5 --set "
      "plant.absorber_stiffness=78957 --set plant.absorber_damping=126 --set absorber.position=1.5 "
      "--set control.proportional_gain=0 --set control.differential_gain=";
  const TemporaryFolder first, second;
  expect_holds(page_of(written_report(active + "-1", first)), {"no motion of the loop grows."});
  expect_holds(page_of(written_report(active + "-2000", second)),
               {"the loop of absorber and computer is unstable on this span"});
}

TEST(SpanReport, IsOfferedWhereTheOtherOneKnowsNoDevices) {
  const TemporaryFolder folder;
  expect_refused("report --quiet" + line + " --output '" + (folder / "a").string() + "'",
                 {"[[device]]", "--for span"});
  expect_refused("report --for bridge --output '" + (folder / "a").string() + "'", {"--for"});
}

TEST(Fatigue, OfEachWindSpeedAddsUpToTheYear) {
  const TemporaryFolder folder;
  const auto table = [&](const std::string& command) {
    const std::string file = (folder / "table.csv").string();
    printed_by(command + line + " --quiet --output '" + file + "'");
    return program::read_csv(file);
  };
  const auto year = table("fatigue"), speeds = table("fatigue --by-speed");
  const auto expect_sum = [&](const std::string& column, const std::string& quantity,
                              const std::string& of_year) {
    double sum = 0.0;
    for (const double part : speeds.numbers(column)) sum += part;
    const double whole = value_of(year, quantity, of_year);
    EXPECT_NEAR(sum, whole, 1e-9 * whole) << column;
  };
  expect_sum("damage_bare", "damage_per_year_bare", "value");
  expect_sum("damage", "damage_per_year", "value");
  expect_sum("damage_lowest", "damage_per_year", "lowest");
  expect_sum("damage_highest", "damage_per_year", "highest");
  EXPECT_GT(speeds.rows(), 100U);
}

}  // namespace
}  // namespace holdfast::tests
