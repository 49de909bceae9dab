#include <sys/stat.h>

#include "cli/program.hpp"

namespace holdfast::tests {
namespace {

using program::CsvTable;
using MetricValues = std::map<std::string, double>;

const std::string every_metric =
    " --metric first_peak --metric steady_peak --metric steady_rms --metric ratio_to_uncontrolled"
    " --metric attenuates --metric engaged_fraction --metric force_peak --metric force_rms"
    " --metric reversals_per_s --metric absorber_stroke --metric largest_exponent"
    " --metric period_samples --metric verdict --metric differential_gain --metric outcome";

/// A motion as `simulate` writes it.
struct SimulatedMotion {
  std::vector<double> time, z1, relative_displacement, relative_velocity, force, inside;
  std::size_t steady = 0;  // the first sample of the second half
};

SimulatedMotion simulated(const std::string& settings, double duration) {
  const CsvTable table =
      table_of("simulate --quiet --duration " + std::to_string(duration) + " " + settings);
  SimulatedMotion motion;
  motion.time = table.numbers("time_s");
  motion.z1 = table.numbers("z1_m");
  motion.force = table.numbers("control_force_N");
  motion.inside = table.numbers("in_backlash");
  for (std::size_t j = 0; j < table.rows(); ++j) {
    motion.relative_displacement.push_back(table.number(j, "z2_m") - motion.z1[j]);
    motion.relative_velocity.push_back(table.number(j, "v2_m_per_s") -
                                       table.number(j, "v1_m_per_s"));
    // A sample meant to lie at the middle may miss it by rounding.
    if (motion.time[j] < 0.5 * duration * (1.0 - 1e-12)) motion.steady = j + 1;
  }
  return motion;
}

double first_peak_of(const std::vector<double>& z) {
  for (std::size_t j = 1; j + 1 < z.size(); ++j) {
    const bool top = z[j] > z[j - 1] && z[j] > z[j + 1];
    const bool bottom = z[j] < z[j - 1] && z[j] < z[j + 1];
    if (top || bottom) return std::abs(z[j]);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

double largest_magnitude(const std::vector<double>& values, std::size_t from) {
  double largest = 0.0;
  for (std::size_t j = from; j < values.size(); ++j)
    largest = std::max(largest, std::abs(values[j]));
  return largest;
}

double root_mean_square(const std::vector<double>& values, std::size_t from) {
  double sum = 0.0;
  for (std::size_t j = from; j < values.size(); ++j) sum += values[j] * values[j];
  return std::sqrt(sum / static_cast<double>(values.size() - from));
}

double reversals_per_second(const SimulatedMotion& motion) {
  double reversals = 0.0;
  for (std::size_t j = motion.steady + 1; j < motion.time.size(); ++j) {
    const double before = motion.relative_velocity[j - 1], now = motion.relative_velocity[j];
    if (before != 0.0 && before * now <= 0.0) reversals += 1.0;
  }
  return reversals / (motion.time.back() - motion.time[motion.steady]);
}

/// Settings of the plant without a computer: the true force, in samples of its own that show peaks.
std::string as_the_plant_alone(const std::string& settings, double duration) {
  const std::string key = "excitation.frequency=";
  const std::size_t at = settings.rfind(key);
  const double frequency =
      at == std::string::npos ? 10.0 : std::stod(settings.substr(at + key.size()));
  return " --set excitation.hold=exact --set control.processing_delay=0 --set "
         "control.sampling_period=" +
         program::format_number(std::min(duration / 20000.0, 1.0 / (200.0 * frequency)));
}

/// What `simulate` says of the metrics, after their definitions.
MetricValues metrics_of_motion(const std::string& settings, double duration) {
  const SimulatedMotion motion = simulated(settings, duration);
  const SimulatedMotion uncontrolled =
      simulated("--no-control " + settings + as_the_plant_alone(settings, duration), duration);
  const std::size_t steady = motion.steady;
  const auto stroke =
      std::minmax_element(motion.relative_displacement.begin(), motion.relative_displacement.end());
  const auto first_steady = motion.inside.begin() + static_cast<std::ptrdiff_t>(steady);
  const auto engaged = static_cast<double>(std::count(first_steady, motion.inside.end(), 0.0));
  MetricValues values;
  values["first_peak"] = first_peak_of(motion.z1);
  values["steady_peak"] = largest_magnitude(motion.z1, steady);
  values["steady_rms"] = root_mean_square(motion.z1, steady);
  values["ratio_to_uncontrolled"] =
      values["steady_peak"] / largest_magnitude(uncontrolled.z1, uncontrolled.steady);
  values["attenuates"] = values["ratio_to_uncontrolled"] < 1.0 ? 1.0 : 0.0;
  values["engaged_fraction"] = engaged / static_cast<double>(motion.inside.size() - steady);
  values["force_peak"] = largest_magnitude(motion.force, 0);
  values["force_rms"] = root_mean_square(motion.force, steady);
  values["reversals_per_s"] = reversals_per_second(motion);
  values["absorber_stroke"] = *stroke.second - *stroke.first;
  return values;
}

/// 0 where the job `orbit` finds none.
double certified_period(const std::string& settings) {
  const Outcome orbit = run_holdfast("orbit --quiet " + settings);
  if (orbit.exit_code == 1) return 0.0;
  return program::parse_csv(orbit.output, "orbit").number(0, "period_samples");
}

/// The verdict's first word, without its period and explanations.
std::string kind_word(const std::string& settings) {
  const std::string text = table_of("verdict --quiet " + settings).text(0, "verdict");
  return text.substr(0, text.find_first_of("(,"));
}

/// The settings that make the case of a cell.
std::string settings_of(const CsvTable& sweep, std::size_t row) {
  std::string settings;
  for (const std::string& name : sweep.names()) {
    if (name.find('.') == std::string::npos) continue;
    settings += " --set " + name + "=" + sweep.text(row, name);
  }
  return settings;
}

void expect_motion_metrics(const CsvTable& sweep, std::size_t row, const std::string& settings,
                           double duration, double tolerance = 1e-12) {
  for (const auto& [name, expected] : metrics_of_motion(settings, duration)) {
    EXPECT_NEAR(sweep.number(row, name), expected, tolerance * std::abs(expected))
        << name << settings;
  }
}

void expect_cell_is_what_the_jobs_say(const CsvTable& sweep, std::size_t row,
                                      const std::string& common, double duration) {
  const std::string settings = common + settings_of(sweep, row);
  expect_motion_metrics(sweep, row, settings, duration);
  const CsvTable exponent = table_of("lyapunov --quiet --largest --duration " +
                                     std::to_string(duration) + " " + settings);
  EXPECT_NEAR(sweep.number(row, "largest_exponent"), exponent.number(0, "per_sample"), 1e-12)
      << settings;
  EXPECT_EQ(sweep.number(row, "period_samples"), certified_period(settings)) << settings;
  EXPECT_EQ(sweep.text(row, "verdict"), kind_word(settings)) << settings;
  EXPECT_EQ(sweep.text(row, "outcome"), "computed") << settings;
}

void expect_every_cell_is_what_the_jobs_say(const std::string& axes, const std::string& common,
                                            std::size_t cells, double duration) {
  const CsvTable sweep = table_of("sweep " + axes + " " + common + every_metric + " --duration " +
                                  std::to_string(duration));
  ASSERT_EQ(sweep.rows(), cells);
  for (std::size_t row = 0; row < cells; ++row)
    expect_cell_is_what_the_jobs_say(sweep, row, common, duration);
}

TEST(SweepMetrics, AreWhatTheOtherJobsSayForSamplingDelayAndBacklash) {
  expect_every_cell_is_what_the_jobs_say(
      "--axis control.sampling_period=0.001,0.003 --axis control.processing_delay=0,0.0007"
      " --axis backlash.width=0:0.002:2",
      "", 8, 20.0);
}

TEST(SweepMetrics, AreWhatTheOtherJobsSayForATunedGainAnExactHoldAndOtherInitialStates) {
  expect_every_cell_is_what_the_jobs_say(
      "--axis excitation.frequency=9.5,11.25 --axis initial.z1=-0.003:0.002:2",
      "--set control.proportional_gain=tuned --set excitation.hold=exact"
      " --set backlash.width=0.001",
      4, 7.0);
}

TEST(SweepMetrics, AreWhatTheOtherJobsSayWhereForcingAndSamplingNeverCoincide) {
  expect_every_cell_is_what_the_jobs_say(
      "--axis backlash.width=0.002 --axis excitation.frequency=9.8765432101", "", 1, 7.0);
}

const std::string reduced_cable =
    "[conductor]\nmass_per_length = 0.043\nspan = 6.4\nsag = 0.29\narea = 5.5e-6\n"
    "youngs_modulus = 18e9\ndamping_ratio = 0.02\n[absorber]\nmass = 0.16\nposition = 0.64\n"
    "[reduction]\nfirst_frequency = 1.999\nsecond_frequency = 6.998\n"
    "[control]\ndifferential_gain = -13\nsampling_period = 0.001\n"
    "[backlash]\nwidth = 0.0005\n";

TEST(SweepMetrics, FollowTheWindAndTheConductorThatThePlantIsMadeFrom) {
  const TextFile cable(reduced_cable +
                       "[wind]\nspeed = 1.0\ndiameter = 0.02\n"
                       "effective_length = 5.0\n");
  const std::string common = cable.as_case() + " --set control.proportional_gain=tuned";
  const CsvTable sweep =
      table_of("sweep --axis wind.speed=0.9,1.1 --axis absorber.mass=0.15,0.16 " + common +
               every_metric + " --duration 4");
  ASSERT_EQ(sweep.rows(), 4U);
  for (std::size_t row = 0; row < 4; ++row)
    expect_motion_metrics(sweep, row, common + settings_of(sweep, row), 4.0);
}

TEST(SweepMetrics, OfAReducedPlantAreThoseOfTheCaseWithOneValueSet) {
  const TextFile line(reduced_cable + "[excitation]\namplitude = 0.5\nfrequency = 10\n");
  const std::string common = line.as_case() + " --set control.proportional_gain=-557";
  const CsvTable sweep = table_of("sweep --axis plant.absorber_damping=3,4 " + common +
                                  every_metric + " --duration 2");
  for (std::size_t row = 0; row < 2; ++row)
    expect_motion_metrics(sweep, row, common + settings_of(sweep, row), 2.0);
}

TEST(SweepMetrics, OfAConductorBesideAGivenPlantAreThoseOfTheCaseWithBothSet) {
  const std::string axes = "sweep --axis conductor.sag=0.29 --axis plant.absorber_mass=0.16,0.2";
  const CsvTable sweep = table_of(axes + every_metric + " --duration 2");
  for (std::size_t row = 0; row < 2; ++row)
    expect_motion_metrics(sweep, row, settings_of(sweep, row), 2.0);
}

TEST(SweepMetrics, OfACaseThatCanBeReadOnlyOnceAreThoseOfThatCase) {
  const TemporaryFolder folder;
  const std::string text = "[backlash]\nwidth = 0\n";
  const std::string file = (folder / "case.toml").string(), pipe = (folder / "pipe").string();
  write_text(file, text);
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  std::thread writer([&] { write_text(pipe, text); });
  const std::string sweep = "sweep --axis conductor.sag=0.29 --duration 1 --case ";
  const Outcome piped = run_holdfast(sweep + pipe);
  writer.join();
  EXPECT_EQ(piped.output, run_holdfast(sweep + file).output);
}

TEST(SweepMetrics, WithTheBestGainSayWhereTheSamplesDoNotShowTheVibration) {
  const CsvTable sweep = table_of(
      "sweep --best-gain --axis control.sampling_period=0.04,0.06 --metric outcome --quiet");
  EXPECT_NE(sweep.text(0, "outcome"), "aliased");  // 10 Hz
  EXPECT_EQ(sweep.text(1, "outcome"), "aliased");
}

TEST(SweepMetrics, WithTheBestGainAreThoseOfTheGainThatDesignGives) {
  const double duration = 20.0, sampling_period = 0.001;
  const std::string radius = program::format_number(std::exp(-10.0 * sampling_period / duration));
  const CsvTable sweep =
      table_of("sweep --best-gain --axis excitation.frequency=8,10,12 --set backlash.width=0" +
               every_metric);
  ASSERT_EQ(sweep.rows(), 3U);
  for (std::size_t row = 0; row < 3; ++row) {
    const std::string settings = " --set backlash.width=0" + settings_of(sweep, row);
    const CsvTable design = table_of("design --margin 0.5 --largest-radius " + radius + settings);
    const std::string gain = design.text(0, "least_amplitude_gain");
    EXPECT_NEAR(sweep.number(row, "differential_gain"), std::stod(gain),
                1e-9 * std::abs(std::stod(gain)));
    // Both gains are found by iteration, and may end some rounding errors apart.
    expect_motion_metrics(sweep, row, settings + " --set control.differential_gain=" + gain,
                          duration, 1e-9);
  }
}

TEST(SweepMetrics, WithTheBestGainSayThatItsGainKnowsNoPlay) {
  const std::string sweep =
      "sweep --best-gain --axis excitation.frequency=10 --duration 1 --metric steady_peak";
  const auto tells = [&](const std::string& settings) {
    return run_holdfast(sweep + settings).errors.find("without play") != std::string::npos;
  };
  EXPECT_TRUE(tells(""));
  EXPECT_FALSE(tells(" --set backlash.width=0"));
  EXPECT_FALSE(tells(" --set backlash.law=none"));
  EXPECT_TRUE(tells(" --set backlash.width=0 --axis backlash.width=0,0.001"));
}

TEST(SweepMetrics, WithTheBestGainSayThatNoGainSettlesInTheDuration) {
  const Outcome outcome = run_holdfast(
      "sweep --best-gain --axis excitation.frequency=10 --duration 0.01 --metric steady_peak"
      " --metric outcome");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_EQ(program::parse_csv(outcome.output, "sweep").text(0, "outcome"), "no_gain");
  expect_holds(outcome.errors, {"settle"});
}

}  // namespace
}  // namespace holdfast::tests
