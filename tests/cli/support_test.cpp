// Every cell of texts/support.toml through the program: it answers or refuses as the table says,
// and jobs that answer the same question agree.

#include "jobs/support.hpp"

#include <cstdlib>
#include <fstream>

#include "cli/program.hpp"

namespace holdfast::tests {
namespace {

using program::SupportCell;

std::string command_of(const SupportCell& cell) {
  std::string command = cell.question;
  for (const std::string& setting : cell.settings) command += " --set '" + setting + "'";
  return command;
}

/// Some jobs need packages.
bool can_be_tried(const SupportCell& cell) {
  const bool needs_packages =
      cell.question.rfind("decay", 0) == 0 || cell.question.find("elements") != std::string::npos;
  return cell.can_be_asked && (both_packages || !needs_packages);
}

/// Tries one in so many cells, neighbours being of one question; all of them with
/// HOLDFAST_SUPPORT_SHARE=1.
void expect_answers_as_told(const std::vector<SupportCell>& cells, std::size_t usual_share) {
  const char* told = std::getenv("HOLDFAST_SUPPORT_SHARE");
  const std::size_t share = told != nullptr ? std::strtoul(told, nullptr, 10) : usual_share;
  std::size_t tried = 0;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const SupportCell& cell = cells[k];
    if (!can_be_tried(cell) || k % share != 0) continue;
    const std::string command = command_of(cell);
    const Outcome outcome = run_holdfast(command);
    ++tried;
    if (!cell.support.refusal.empty()) {
      EXPECT_EQ(outcome.exit_code, 2) << command << '\n' << outcome.errors;
      expect_holds(outcome.errors, {cell.support.refusal});
      continue;
    }
    // Nothing of it is refused; a motion may diverge, or have no period.
    EXPECT_TRUE(outcome.exit_code == 0 || outcome.exit_code == 1) << command << '\n'
                                                                  << outcome.errors;
    if (outcome.exit_code == 0 && !cell.support.idealised.empty())
      expect_holds(outcome.errors, {cell.support.idealised});
  }
  testing::Test::RecordProperty("cells", static_cast<int>(tried));
  EXPECT_GT(tried, cells.size() / share / 2);
}

TEST(Support, EveryCellDoesWhatTheTableSays) {
  expect_answers_as_told(program::support_cells(), 31);
}

/// What no rule says of two features together is answered with both.
TEST(Support, EveryPairDoesWhatTheTableSays) {
  expect_answers_as_told(program::support_pairs(), 151);
}

/// docs/support.md is made of the table: HOLDFAST_WRITE_SUPPORT=1 writes it.
TEST(Support, ThePageIsTheTable) {
  const std::string page = std::string(HOLDFAST_SOURCE_DIR) + "/docs/support.md";
  if (std::getenv("HOLDFAST_WRITE_SUPPORT") != nullptr)
    std::ofstream(page) << program::support_page();
  EXPECT_EQ(read_text(page), program::support_page());
}

/// A loop that is built otherwise than the paper's, with gains at which it is stable and some at
/// which it is not.
struct Agreement {
  std::string settings;
  std::string stable, unstable;  // D
};

/// Charts, boundaries, margins, radius, exponent and motion are about one loop.
TEST(Support, JobsAgreeWhetherALoopIsStable) {
  const std::string slow = " --set control.sampling_period=0.01 --set backlash.width=0";
  const std::string string =
      " --set plant.model=string --set plant.modes=4 --set absorber.clamp_mass=0.02";
  const std::string difference = " --set control.velocity=difference";
  // Of an ideal computer two masses are stable from -15.5, this string from -17.9.
  const std::vector<Agreement> loops = {
      {slow, "-15", "-16"},
      {slow + difference, "-19", "-21"},
      {slow + " --set control.measurement_filter=30", "-36", "-37"},
      {slow + " --set control.processing_delay=0.013", "-10", "-11"},
      {slow + string, "-17", "-19"},
      {slow + string + difference, "-22", "-23"}};
  for (const auto& [settings, stable, unstable] : loops) {
    const std::string p = settings.find("delay") != std::string::npos ? "-150" : "-557";
    for (const bool is_stable : {true, false}) {
      const std::string& d = is_stable ? stable : unstable;
      const std::string of = " --quiet --set control.proportional_gain=" + p +
                             " --set control.differential_gain=" + d + settings;
      const auto chart = table_of("stability --radius --p " + p + " --d " + d + of);
      EXPECT_EQ(chart.number(0, "stable") == 1.0, is_stable) << of;
      EXPECT_EQ(chart.number(0, "spectral_radius") < 1.0, is_stable) << of;
      const Outcome margins = run_holdfast("margins" + of);
      EXPECT_EQ(margins.exit_code, is_stable ? 0 : 1) << of << margins.errors;
      bool is_inside = false;
      const Outcome boundary = run_holdfast("boundary --stable-interval --p " + p + of);
      if (boundary.exit_code == 0) {
        const auto intervals = program::parse_csv(boundary.output, "boundary");
        for (std::size_t row = 0; row < intervals.rows(); ++row)
          is_inside = is_inside || (intervals.number(row, "lower") < std::stod(d) &&
                                    std::stod(d) < intervals.number(row, "upper"));
      }
      EXPECT_EQ(is_inside, is_stable) << of << boundary.output;
      const Outcome motion = run_holdfast(
          "simulate --duration 40 --set excitation.amplitude=0 --set initial.z1=0.0001" + of);
      bool decays = false;
      if (motion.exit_code == 0) {
        const auto rows = program::parse_csv(motion.output, "simulate");
        decays = std::abs(rows.number(rows.rows() - 1, "z1_m")) < 1e-4;
      }
      EXPECT_EQ(decays, is_stable) << of << motion.errors;
    }
  }
}

/// Of a linear loop the answers say of its motion what the verdict says.
TEST(Support, AnswersAndVerdictAgree) {
  for (const std::string settings :
       {" --set control.velocity=difference --set control.sampling_period=0.01"
        " --set control.differential_gain=-8 --set backlash.width=0",
        " --set control.velocity=difference --set control.differential_gain=-10"
        " --set control.proportional_gain=-3000 --set control.sampling_period=0.01"
        " --set backlash.width=0",
        ""}) {
    const auto verdict = run_holdfast("verdict --quiet" + settings);
    const auto answers = run_holdfast("answers --quiet" + settings);
    const bool diverges = verdict.output.find("diverges") != std::string::npos;
    EXPECT_EQ(answers.output.find("diverges") != std::string::npos, diverges)
        << settings << verdict.output << answers.output;
  }
}

/// The D that `design` prints is the one whose slopes `sensitivity` tells, on two masses and on a
/// conductor.
TEST(Support, DesignAndSensitivityAreOfOneOptimum) {
  for (const std::string settings :
       {"", " --set control.velocity=difference",
        " --set plant.model=string --set plant.modes=4 --set absorber.clamp_mass=0.02"}) {
    const auto design = table_of("design --quiet" + settings);
    const auto slopes = table_of("sensitivity --quiet" + settings);
    for (const auto& [answer, column] : {std::pair{"least_amplitude_gain", "least_amplitude_gain"},
                                         {"least_amplitude_ratio", "ratio_to_uncontrolled"}})
      EXPECT_DOUBLE_EQ(slopes.number(row_of(slopes, answer, "answer"), "value"),
                       design.number(0, column))
          << settings;
  }
}

/// One word is one question: the gains of least amplitude, on whatever plant.
TEST(Support, BothGainsAreThoseOfLeastAmplitudeEverywhere) {
  const std::string header = header_of("design --both-gains --quiet");
  for (const std::string settings :
       {" --set control.measurement_filter=1e9",
        " --set plant.model=string --set plant.modes=4 --set absorber.clamp_mass=0.02"})
    EXPECT_EQ(header_of("design --both-gains --quiet" + settings), header) << settings;
  const auto ideal = table_of("design --both-gains --quiet");
  const auto filtered =
      table_of("design --both-gains --quiet --set control.measurement_filter=1e9");
  for (const std::string column : {"proportional_gain", "least_amplitude_gain"})
    EXPECT_NEAR(filtered.number(0, column), ideal.number(0, column),
                1e-3 * std::abs(ideal.number(0, column)))
        << column;
}

/// The closed form of the amplitude is that of the samples of a long motion.
TEST(Support, ResponseIsThatOfAMotion) {
  for (const std::string settings :
       {"", " --set control.velocity=difference",
        " --set control.velocity=difference --set plant.model=string --set plant.modes=4"
        " --set absorber.clamp_mass=0.02"}) {
    const std::string of =
        " --quiet --set backlash.width=0 --set control.differential_gain=-4" + settings;
    const double amplitude = table_of("response --p -557 --d -4" + of).number(0, "amplitude_m");
    const double largest = largest_in(table_of("simulate --duration 60 --from 59" + of), "z1_m");
    EXPECT_NEAR(largest, amplitude, 5e-3 * amplitude) << settings;
  }
}

}  // namespace
}  // namespace holdfast::tests
