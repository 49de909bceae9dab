#include "cli/program.hpp"
#include "holdfast/core/types.hpp"

namespace holdfast::tests {
namespace {

using program::CsvTable;
using program::parse_csv;

/// ρ at one pair of gains, by the chart of one cell.
double radius_of_cell(double p, double d, const std::string& settings) {
  return cell_of("stability --radius", p, d, settings).number(0, "spectral_radius");
}

std::size_t row_where(const CsvTable& table, const std::string& column, const std::string& value,
                      const std::string& other_column, const std::string& other_value) {
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (table.text(row, column) == value && table.text(row, other_column) == other_value)
      return row;
  }
  ADD_FAILURE() << "no row of " << value << ", " << other_value;
  return 0;
}

TEST(DesignJob, KeepsTheRadiusThatIsAskedFor) {
  const std::string settings = "--set control.sampling_period=0.01 --set backlash.width=0";
  const CsvTable table = table_of("design --largest-radius 0.995 " + settings);
  ASSERT_EQ(table.rows(), 1U);
  EXPECT_EQ(table.text(0, "least_amplitude_at"), "edge");
  const double d = table.number(0, "least_amplitude_gain");
  EXPECT_NEAR(radius_of_cell(-557.0, d, settings), 0.995, 1e-5);
  EXPECT_GT(table.number(0, "attenuation_dB"), 0.0);
}

TEST(DesignJob, SaysWhatThePlayMakesOfTheGain) {
  for (const std::string settings :
       {" --set backlash.width=0.002 --set control.sampling_period=0.01",
        " --set backlash.width=0.001 --set backlash.law=play"}) {
    const Outcome design = run_holdfast("design" + settings);
    const CsvTable table = parse_csv(design.output, "design");
    // The same motion as a sweep has it.
    const CsvTable motion =
        table_of("sweep --axis control.differential_gain=" + table.text(0, "least_amplitude_gain") +
                 " --metric ratio_to_uncontrolled --duration 20" + settings);
    const double with_play = motion.number(0, "ratio_to_uncontrolled");
    EXPECT_GT(with_play, 1.1 * table.number(0, "ratio_to_uncontrolled"));
    const std::size_t at = design.errors.find("if there is no play, but ");
    ASSERT_NE(at, std::string::npos) << design.errors;
    EXPECT_NEAR(std::stod(design.errors.substr(at + 25)), with_play, 1e-4 * with_play);
  }
  for (const char* without : {"backlash.width=0", "backlash.law=none", "excitation.amplitude=0"})
    EXPECT_EQ(run_holdfast(std::string("design --set ") + without).errors.find("play"),
              std::string::npos)
        << without;
}

/// A gain that is recommended has the margins that are named, by eigenvalues at the gains moved.
void expect_margins(const CsvTable& table, const std::string& gain, const std::string& settings) {
  const double p = table.number(0, "proportional_gain"), d = table.number(0, gain);
  const double radius = radius_of_cell(p, d, settings);
  EXPECT_LT(radius, 1.0);
  EXPECT_NEAR(table.number(0, "spectral_radius"), radius, 1e-6);
  const double factor = std::pow(10.0, table.number(0, "gain_margin_dB") / 20.0);
  ASSERT_GT(factor, 1.3) << settings;
  EXPECT_GT(table.number(0, "phase_margin_deg"), 1.0);
  EXPECT_LT(radius_of_cell(0.999 * factor * p, 0.999 * factor * d, settings), 1.0);
  EXPECT_GT(radius_of_cell(1.001 * factor * p, 1.001 * factor * d, settings), 1.0);
  const double delay = table.number(0, "delay_margin_s");
  ASSERT_GT(delay, 0.0);
  const auto delayed = [&](double share) {
    return radius_of_cell(
        p, d, settings + " --set control.processing_delay=" + std::to_string(share * delay));
  };
  if (delay < 0.005) {  // within a sampling period
    EXPECT_LT(delayed(0.99), 1.0);
    EXPECT_GT(delayed(1.01), 1.0);
  }
}

TEST(DesignJob, RecommendsGainsWithTheMarginsThatItNames) {
  const std::string without_play = " --set backlash.width=0";
  const std::string slow = without_play + " --set control.sampling_period=0.01";
  const std::string delayed = slow + " --set control.proportional_gain=-1300";
  for (const std::string& settings : {slow, delayed, without_play}) {
    expect_margins(table_of("design" + settings), "least_amplitude_gain", settings);
    expect_margins(table_of("design --quiet --band 9:11" + settings), "differential_gain",
                   settings);
  }
  expect_margins(table_of("design --quiet --frequency 15:15:1" + slow), "least_amplitude_gain",
                 slow);
  EXPECT_EQ(run_holdfast("design" + slow).errors, "");
}

TEST(DesignJob, SaysThatAGainOnTheBoundaryIsALimit) {
  for (const std::string question : {"design", "design --band 9:11", "design --frequency 9:11:3"}) {
    expect_said(question + " --largest-radius 1", {"on the boundary of stability"});
  }
  expect_said("max-delay --frequency 10:10:1 --criterion stable", {"on the boundary of stability"});
}

/// What is left is compared with the plant that no computer holds the force of.
TEST(DesignJob, RatiosAreToThePlantUnderTheTrueForce) {
  const auto free_amplitude = [](const std::string& settings) {
    const CsvTable cell = table_of("response --quiet --p -20:-20:1 --d -1:-1:1" + settings);
    return cell.number(0, "amplitude_m") / cell.number(0, "ratio_to_uncontrolled");
  };
  const double plant = free_amplitude(" --set control.sampling_period=1e-5");
  for (const std::string period : {"0.001", "0.01", "0.03"}) {
    const std::string settings = " --set control.sampling_period=" + period;
    EXPECT_NEAR(free_amplitude(settings), plant, 1e-6 * plant) << period;
    const Outcome held = run_holdfast("response --p -20:-20:1 --d -1:-1:1" + settings);
    EXPECT_EQ(held.errors.find("held over ") != std::string::npos, period == "0.03") << held.errors;
    cell_of("response", -20.0, -1.0, "--set excitation.hold=exact" + settings);
  }
  const std::string fast = " --set excitation.frequency=10000";
  EXPECT_LT(free_amplitude(fast), 1e-8) << "10 kHz hardly move the cable";
  for (const std::string job :
       {"response --p -20:-20:1 --d -1:-1:1", "sweep --axis backlash.width=0:0.001:2 --duration 2"})
    expect_said(job + fast, {"held over "});
}

TEST(DesignJob, OneGainServesABand) {
  const std::string settings = "--quiet --set control.sampling_period=0.01 --largest-radius 0.995";
  const CsvTable band = table_of("design --band 9:11 " + settings);
  ASSERT_EQ(band.rows(), 1U);
  EXPECT_GE(band.number(0, "worst_frequency_Hz"), 9.0);
  EXPECT_LE(band.number(0, "worst_frequency_Hz"), 11.0);
  EXPECT_NEAR(band.number(0, "lower_bound"), band.number(0, "worst_ratio"),
              1e-7 * band.number(0, "worst_ratio"));
  const CsvTable single = table_of("design " + settings);
  EXPECT_GE(band.number(0, "worst_ratio"), single.number(0, "ratio_to_uncontrolled"));
}

TEST(DesignJob, BothGainsAreBetterThanDAlone) {
  const std::string settings = " --set control.sampling_period=0.01 --set backlash.width=0";
  const CsvTable alone = table_of("design" + settings);
  // Of the modulus margin that D alone has, |det(λI − S)/det(λI − S of no gains)| on the circle.
  const auto loop = sampled_loop(kollar2022_plant(), Sampling<double>{0.01});
  const auto map = loop.engaged_map({-557.0, alone.number(0, "least_amplitude_gain")});
  double margin = 2.0;
  for (int k = 0; k <= 20000; ++k) {
    const Matrix<std::complex<double>, 5> circle =
        std::polar(1.0, pi<double> * k / 20000) * Matrix<std::complex<double>, 5>::Identity();
    margin = std::min(margin, std::abs((circle - map).eval().determinant() /
                                       (circle - loop.backlash_map()).eval().determinant()));
  }
  const CsvTable quiet =
      table_of("design --quiet --both-gains --margin " + program::format_number(margin) + settings);
  EXPECT_LT(quiet.number(0, "ratio_to_uncontrolled"), alone.number(0, "ratio_to_uncontrolled"));
}

/// On a conductor both gains keep a modulus margin: of 0.5, 6 dB and 29 degrees. Less of it leaves
/// less vibration.
TEST(DesignJob, BothGainsOfAConductorKeepAMargin) {
  const std::string question =
      "design --both-gains --quiet --set plant.model=string --set plant.modes=20"
      " --set absorber.clamp_mass=0.01 --frequency 8:12:3";
  const CsvTable usual = table_of(question), near = table_of(question + " --margin 0.2");
  ASSERT_EQ(usual.rows(), 3U);
  for (std::size_t row = 0; row < 3; ++row) {
    EXPECT_GE(usual.number(row, "gain_margin_dB"), 6.0) << row;
    EXPECT_GE(usual.number(row, "phase_margin_deg"), 28.9) << row;
    EXPECT_LT(usual.number(row, "ratio_to_uncontrolled"), 1.0) << row;
    EXPECT_LT(near.number(row, "ratio_to_uncontrolled"), usual.number(row, "ratio_to_uncontrolled"))
        << row;
  }
}

TEST(DesignJob, NoAdmissibleGainIsNoAnswer) {
  expect_refused("design --band 5:9 --set control.sampling_period=0.05",
                 {"no D keeps the spectral radius below 1"}, 1);
}

TEST(DesignJob, ARowWithoutABestGainSaysWhy) {
  for (const auto& [settings, outcome_name, words] :
       {std::tuple{"--set control.sampling_period=0.049", "none", "no D keeps the spectral radius"},
        {"--set control.sampling_period=0.06", "aliased", "half the sampling rate"}}) {
    const Outcome outcome = run_holdfast(std::string("design ") + settings);
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.error_lines(), 1U) << outcome.errors;
    expect_holds(outcome.errors, {words});
    const CsvTable table = parse_csv(outcome.output, settings);
    EXPECT_EQ(table.text(0, "least_amplitude_at"), outcome_name);
    EXPECT_TRUE(std::isnan(table.number(0, "least_amplitude_gain")));
    EXPECT_TRUE(std::isfinite(table.number(0, "least_radius")));
  }
}

TEST(DesignJob, EndsForEnormousGains) {
  for (const std::string gain : {"-1e12", "-1e60", "-1e155", "1e300"}) {
    const Outcome outcome = run_holdfast("design --set control.proportional_gain=" + gain);
    EXPECT_TRUE(outcome.exit_code == 0 || outcome.exit_code == 1) << gain;
  }
}

TEST(DesignJob, RefusesWhatDoesNotGoTogether) {
  for (const std::string arguments :
       {"--band 9:11 --frequency 9:11:2", "--both-gains --band 9:11", "--band 0:5", "--band 11:9",
        "--band 9", "--largest-radius 0", "--largest-radius nan", "--largest-radius 1.1",
        "--margin 1", "--margin -0.1", "--band 10:5000"}) {
    expect_refused("design " + arguments, {});
  }
}

TEST(MarginsJob, EndsAreThoseOfTheStableInterval) {
  const std::string settings = " --set control.sampling_period=0.01";
  const CsvTable margins = table_of("margins" + settings);
  ASSERT_EQ(margins.rows(), 8U);
  const CsvTable intervals = table_of("boundary --stable-interval" + settings);
  const std::size_t below = row_where(margins, "quantity", "differential_gain", "side", "below");
  EXPECT_NEAR(margins.number(below, "position"), intervals.number(0, "lower"), 1e-9);
  EXPECT_EQ(margins.number(below, "value"), -13.0);
  EXPECT_NEAR(margins.number(below, "distance"), -13.0 - margins.number(below, "position"), 1e-12);
  const std::size_t slower = row_where(margins, "quantity", "sampling_period", "side", "above");
  EXPECT_EQ(margins.text(slower, "outcome"), "boundary");
  EXPECT_EQ(margins.text(slower, "unit"), "s");
  const double period = margins.number(slower, "position");
  const auto at = [](double tau) { return "--set control.sampling_period=" + std::to_string(tau); };
  EXPECT_LT(radius_of_cell(-557.0, -13.0, at(period - 1e-5)), 1.0);
  EXPECT_GT(radius_of_cell(-557.0, -13.0, at(period + 1e-5)), 1.0);
}

TEST(MarginsJob, AnUnstableLoopIsNoAnswer) {
  expect_refused("margins --set control.sampling_period=0.05", {"the loop is not stable"}, 1);
}

TEST(SensitivityJob, IsTheSlopeOfTheDesign) {
  const CsvTable slopes = table_of("sensitivity");
  const std::size_t row =
      row_where(slopes, "answer", "least_radius", "parameter", "plant.absorber_mass");
  EXPECT_EQ(slopes.text(row, "parameter_unit"), "kg");
  const auto radius = [](const std::string& mass) {
    return table_of("design --quiet --set plant.absorber_mass=" + mass).number(0, "least_radius");
  };
  const double slope = (radius("0.1601") - radius("0.1599")) / 0.0002;
  EXPECT_NEAR(slopes.number(row, "derivative"), slope, 1e-3 * std::abs(slope));
  EXPECT_NEAR(slopes.number(row, "relative"), slope * 0.16 / slopes.number(row, "value"),
              1e-3 * std::abs(slopes.number(row, "relative")));
}

/// The answer keeps δ/τ of the case, so that it moves with both.
TEST(SensitivityJob, OfTheLargestPeriodIsThatOfTheCasesDelay) {
  const std::string at =
      "sensitivity --set control.sampling_period=0.01 --set "
      "control.processing_delay=";
  const CsvTable slopes = table_of(at + "0.004");
  const std::size_t row =
      row_where(slopes, "answer", "max_stable_period", "parameter", "control.processing_delay");
  const auto period = [&](const std::string& delay) {
    const CsvTable table = table_of(at + delay);
    return table.number(
        row_where(table, "answer", "max_stable_period", "parameter", "control.processing_delay"),
        "value");
  };
  const double slope = (period("0.00401") - period("0.00399")) / 0.00002;
  EXPECT_NEAR(slopes.number(row, "derivative"), slope, 1e-3 * std::abs(slope));
}

TEST(SensitivityJob, ATunedGainIsCarriedAlong) {
  const CsvTable carried = table_of("sensitivity --set control.proportional_gain=tuned"),
                 held = table_of("sensitivity");
  const std::size_t row =
      row_where(carried, "answer", "least_radius", "parameter", "plant.absorber_stiffness");
  EXPECT_GT(std::abs(carried.number(row, "derivative") / held.number(row, "derivative") - 1.0),
            0.1);
  const std::size_t gain =
      row_where(carried, "answer", "least_radius", "parameter", "control.proportional_gain");
  EXPECT_EQ(carried.number(gain, "derivative"), 0.0);
}

/// The largest period that still helps is where `response` and `design` say that nothing is left of
/// the help: all by the amplitude without control under the true force.
TEST(MaxDelayJob, HelpsByTheReferenceOfResponseAndDesign) {
  const std::string free = " --set backlash.width=0 --quiet";
  // At 10 Hz no loss of stability comes first.
  const CsvTable longest = table_of("max-delay --quiet --frequency 10:10:1");
  const double period = longest.number(0, "max_sampling_period_s");
  const CsvTable left = cell_of("response", longest.number(0, "proportional_gain"),
                                longest.number(0, "differential_gain"),
                                "--set excitation.frequency=10 --set control.sampling_period=" +
                                    program::format_number(0.999 * period) + free);
  EXPECT_NEAR(left.number(0, "ratio_to_uncontrolled"), 1.0, 0.01);
  EXPECT_LT(left.number(0, "ratio_to_uncontrolled"), 1.0);
}

}  // namespace
}  // namespace holdfast::tests
