// The loop as it is built (measurement filter, drive with a lag, delay of more than a sample, a
// velocity by difference) and
// the string without ends, through the program: against matrices of the whole loop and closed
// forms.

#include <complex>

#include "cli/program.hpp"
#include "holdfast/cable/taut_string.hpp"
#include "holdfast/control/loop_map.hpp"
#include "holdfast/math/linalg/spectral_radius.hpp"
#include "holdfast/plant/loop_hardware.hpp"
#include "holdfast/stability/margins/loop_form.hpp"
#include "support/lagging_plant.hpp"

namespace holdfast::tests {
namespace {

using program::CsvTable;

struct BuiltLoop {
  std::string settings;
  LoopHardware hardware;
  Sampling<double> sampling;
  bool has_tangents = true;

  LoopMap<double> map() const {
    const auto plant = with_hardware(test::through_ports(kollar2022_plant()), hardware);
    const auto measured = loop_map(plant, sampling);
    return hardware.has_velocity_sensor ? measured : with_velocity_by_difference(measured);
  }
};

const double ideal = LoopHardware::ideal;

std::vector<BuiltLoop> built_loops() {
  const std::string filter = " --set control.measurement_filter=80",
                    drive = " --set control.drive_bandwidth=60",
                    second = drive + " --set control.drive_damping=0.7",
                    late = " --set control.processing_delay=0.0033",
                    difference = " --set control.velocity=difference";
  return {{filter, {80.0, ideal, ideal}, {0.001}},
          {drive, {ideal, 60.0, ideal}, {0.001}},
          {second, {ideal, 60.0, 0.7}, {0.001}},
          {late, {}, {0.001, 0.0033}},
          {filter + second + late, {80.0, 60.0, 0.7}, {0.001, 0.0033}},
          {difference, {ideal, ideal, ideal, false}, {0.001}},
          {difference + " --set control.processing_delay=0.0006",
           {ideal, ideal, ideal, false},
           {0.001, 0.0006}},
          {difference + filter + second + late, {80.0, 60.0, 0.7, false}, {0.001, 0.0033}, false}};
}

TEST(BuiltLoop, ChartIsThatOfTheEigenvalues) {
  for (const BuiltLoop& loop : built_loops()) {
    const LoopMap<double> map = loop.map();
    const CsvTable chart =
        table_of("stability --radius --quiet --p -900:100:5 --d -50:10:9" + loop.settings);
    std::size_t stable = 0;
    for (std::size_t row = 0; row < chart.rows(); ++row) {
      const PdGains<double> gains{chart.number(row, "proportional_gain"),
                                  chart.number(row, "differential_gain")};
      const double radius = spectral_radius(map.closed_map(gains));
      EXPECT_NEAR(chart.number(row, "spectral_radius"), radius, 1e-9) << loop.settings;
      EXPECT_EQ(chart.number(row, "stable") == 1.0, radius < 1.0) << loop.settings;
      stable += radius < 1.0 ? 1 : 0;
    }
    EXPECT_GT(stable, 5U) << loop.settings;
    EXPECT_LT(stable, chart.rows() - 5) << loop.settings;
  }
}

/// Without force and play a motion is powers of the map.
TEST(BuiltLoop, MotionIsPowersOfItsMap) {
  for (const BuiltLoop& loop : built_loops()) {
    const auto map = loop.map().closed_map({-557.0, -4.0});
    Vector<double, Eigen::Dynamic> state = Vector<double, Eigen::Dynamic>::Zero(map.rows());
    state.head(4) << 0.001, -0.02, 0.003, 0.01;
    const bool filtered = std::isfinite(loop.hardware.measurement_filter);
    const Eigen::Index drive = !std::isfinite(loop.hardware.drive_bandwidth) ? 0
                               : std::isfinite(loop.hardware.drive_damping)  ? 2
                                                                             : 1;
    if (filtered) state[4 + drive] = 0.001;
    // The reading before the first one is the same.
    if (!loop.hardware.has_velocity_sensor) state[map.rows() - 1] = 0.001;
    const CsvTable motion = table_of(
        "simulate --quiet --duration 0.3 --set control.differential_gain=-4"
        " --set excitation.amplitude=0 --set backlash.law=none --set initial.z1=0.001"
        " --set initial.v1=-0.02 --set initial.z2=0.003 --set initial.v2=0.01" +
        loop.settings);
    ASSERT_EQ(motion.rows(), 301U);
    for (std::size_t row = 0; row < motion.rows(); ++row) {
      ASSERT_NEAR(motion.number(row, "z1_m"), state[0], 1e-12) << loop.settings << row;
      ASSERT_NEAR(motion.number(row, "v1_m_per_s"), state[1], 1e-10) << loop.settings << row;
      ASSERT_NEAR(motion.number(row, "z2_m"), state[2], 1e-12) << loop.settings << row;
      state = (map * state).eval();
    }
  }
}

/// Without play the orbit's largest multiplier is the map's radius to the power of its period, and
/// its amplitude that of the closed form, at the samples.
TEST(BuiltLoop, OrbitExponentAndSweepAreThoseOfTheLinearLoop) {
  for (const BuiltLoop& loop : built_loops()) {
    const std::string settings =
        " --quiet --set control.differential_gain=-4 --set backlash.law=none" + loop.settings;
    if (!loop.has_tangents) continue;
    const double radius = spectral_radius(loop.map().closed_map({-557.0, -4.0}));
    const CsvTable orbit = table_of("orbit" + settings);
    const double samples = orbit.number(0, "period_samples");
    EXPECT_EQ(samples, 100.0);
    EXPECT_NEAR(orbit.number(0, "largest_multiplier"), std::pow(radius, samples), 1e-6);
    EXPECT_EQ(table_of("verdict" + settings).text(0, "verdict"), "periodic(100)");
    EXPECT_NEAR(table_of("lyapunov --largest --duration 240 --discard 60" + settings)
                    .number(0, "per_sample"),
                std::log(radius), 2e-5);
    const CsvTable response = table_of("response --p -557 --d -4" + settings);
    const CsvTable sweep = table_of(
        "sweep --axis backlash.width=0:0.001:2 --duration 40 --metric steady_peak"
        " --metric ratio_to_uncontrolled" +
        settings);
    for (std::size_t row = 0; row < 2; ++row) {
      const double amplitude = response.number(0, "amplitude_m");
      EXPECT_NEAR(sweep.number(row, "steady_peak"), amplitude, 1e-3 * amplitude) << loop.settings;
      EXPECT_NEAR(sweep.number(row, "ratio_to_uncontrolled"),
                  response.number(0, "ratio_to_uncontrolled"), 2e-3);
    }
  }
}

TEST(BuiltLoop, ASweepOverTheFilterIsItsCases) {
  const std::string settings =
      " --quiet --set control.differential_gain=-4 --set control.sampling_period=0.005"
      " --set backlash.width=0.0005 --duration 10 --metric steady_peak --metric verdict";
  const CsvTable sweep = table_of("sweep --axis control.measurement_filter=20:200:3" + settings);
  for (std::size_t row = 0; row < sweep.rows(); ++row) {
    const CsvTable alone =
        table_of("sweep --axis backlash.width=0.0005 --set control.measurement_filter=" +
                 sweep.text(row, "control.measurement_filter") + settings);
    EXPECT_EQ(alone.text(0, "steady_peak"), sweep.text(row, "steady_peak")) << row;
    EXPECT_EQ(alone.text(0, "verdict"), sweep.text(row, "verdict")) << row;
  }
}

/// By the poles what the closed forms say of two masses.
TEST(BuiltLoop, SensitivitiesByPolesAreThoseOfTheClosedForms) {
  const std::string at = "sensitivity --quiet --set control.differential_gain=-4";
  // A filter of 10⁹ Hz is none.
  const CsvTable found = table_of(at + " --set control.measurement_filter=1e9");
  const CsvTable expected = table_of(at);
  std::size_t compared = 0;
  for (std::size_t row = 0; row < expected.rows(); ++row) {
    const std::string answer = expected.text(row, "answer");
    if (answer != "spectral_radius" && answer.rfind("stable_", 0) != 0) continue;
    for (std::size_t other = 0; other < found.rows(); ++other) {
      if (found.text(other, "answer") != answer ||
          found.text(other, "parameter") != expected.text(row, "parameter"))
        continue;
      const double derivative = expected.number(row, "derivative");
      const double scale = std::abs(derivative) + 1e-9 * std::abs(expected.number(row, "value"));
      EXPECT_NEAR(found.number(other, "derivative"), derivative, 1e-4 * scale)
          << answer << ' ' << expected.text(row, "parameter");
      ++compared;
    }
  }
  EXPECT_EQ(compared, 30U);
}

/// The least radius of the cells of a chart.
double smallest_radius(const std::string& chart) {
  const std::vector<double> radii =
      table_of("stability --radius --quiet" + chart).numbers("spectral_radius");
  return *std::min_element(radii.begin(), radii.end());
}

/// The D of least radius has no larger one than any other D, also where poles are equal or so many
/// commands are on their way that roots are not found one by one.
TEST(BuiltLoop, LeastRadiusIsLeastAndKnown) {
  for (const std::string settings :
       {" --set control.drive_bandwidth=30 --set control.measurement_filter=30"
        " --set control.drive_damping=0.999",
        " --set control.drive_bandwidth=30 --set control.measurement_filter=30"
        " --set control.drive_damping=1",
        " --set control.processing_delay=0.0305 --set control.proportional_gain=-20",
        " --set plant.model=infinite_string --set absorber.clamp_mass=0.02"}) {
    const CsvTable design = table_of("design --quiet" + settings);
    const double least = design.number(0, "least_radius");
    EXPECT_LT(design.number(0, "spectral_radius"), 1.0) << settings;
    const double smallest =
        smallest_radius(" --d -60:5:27" + settings + " --p " + design.text(0, "proportional_gain"));
    EXPECT_LE(least, smallest + 1e-9) << settings;
    EXPECT_LE(least, design.number(0, "spectral_radius") + 1e-9) << settings;
  }
}

/// Nor where no D stabilises, and D = 0, from which the search begins, lies on the circle of its
/// own radius.
TEST(BuiltLoop, LeastRadiusIsLeastWhereNoDStabilises) {
  for (const std::string settings :
       {" --set control.sampling_period=0.02 --set control.processing_delay=0.008"
        " --set control.velocity=difference",
        " --set control.sampling_period=0.02 --set control.processing_delay=0.046"
        " --set control.velocity=difference",
        " --set control.sampling_period=0.015 --set control.processing_delay=0.03"}) {
    const CsvTable design = table_of("design --quiet" + settings);
    const double smallest = smallest_radius(" --d -8:8:81 --p -557" + settings);
    EXPECT_GT(smallest, 1.0) << settings;
    EXPECT_LE(design.number(0, "least_radius"), smallest + 1e-6) << settings;
    EXPECT_NEAR(smallest_radius(" --p -557 --d " + design.text(0, "least_radius_gain") + settings),
                design.number(0, "least_radius"), 1e-5)
        << settings;
  }
}

/// Where natural motions coincide a design is no answer, and not the answer that nothing is stable.
TEST(BuiltLoop, CoincidingMotionsAreSaid) {
  for (const std::string settings :
       {" --set control.velocity=difference", " --set control.processing_delay=0.0013"})
    for (const std::string job : {"design", "design --both-gains", "sensitivity", "margins"})
      expect_refused(job + " --quiet --set plant.absorber_damping=4.4083842309856545" + settings,
                     {"coincide"}, 1);
}

TEST(BuiltLoop, MarginsOfManyCommandsHaveTheirFrequencies) {
  const CsvTable margins = table_of(
      "margins --quiet --set control.processing_delay=0.0305 --set control.proportional_gain=0"
      " --set control.differential_gain=-0.5");
  std::size_t boundaries = 0;
  for (std::size_t row = 0; row < margins.rows(); ++row) {
    if (margins.text(row, "outcome") != "boundary") continue;
    const double frequency = margins.number(row, "frequency_Hz");
    EXPECT_TRUE(frequency >= 0.0 && frequency <= 1e6) << row;
    ++boundaries;
  }
  EXPECT_GT(boundaries, 1U);
}

/// A filter whose pole is one of the plant's is no special case of the amplitude.
TEST(BuiltLoop, ResponseIsSmoothWhereAPoleIsShared) {
  const auto ratio = [](double filter) {
    return table_of(
               "response --quiet --p=-100 --d=-5 --set plant.absorber_damping=40"
               " --set control.measurement_filter=" +
               program::format_number(filter))
        .number(0, "ratio_to_uncontrolled");
  };
  constexpr double shared = 0.298239029070496;
  EXPECT_NEAR(ratio(shared), ratio(1.0001 * shared), 1e-4);
  EXPECT_NEAR(ratio(shared), ratio(0.9999 * shared), 1e-4);
}

TEST(BuiltLoop, WholeSamplesOfDelayAreAnswered) {
  for (const std::string delay : {"0.006", "0.012", "0.016", "0.02", "0.1"}) {
    const std::string late = " --quiet --set control.processing_delay=" + delay;
    EXPECT_EQ(table_of("simulate --duration 0.01" + late).rows(), 11U);
    EXPECT_GT(table_of("sweep --axis backlash.width=0 --duration 0.5 --metric first_peak" + late)
                  .number(0, "first_peak"),
              0.0);
  }
}

/// A delay that jitter leaves no room to grow has a slope to one side.
TEST(BuiltLoop, SensitivityKnowsTheEdgeOfWhatIsAdmissible) {
  const CsvTable found = table_of(
      "sensitivity --quiet --set control.differential_gain=-4"
      " --set control.processing_delay=0.00105 --set control.jitter=0.000475");
  std::size_t known = 0;
  for (std::size_t row = 0; row < found.rows(); ++row)
    if (found.text(row, "parameter") == "control.processing_delay")
      known += std::isfinite(found.number(row, "derivative")) ? 1U : 0U;
  EXPECT_GE(known, 4U);
}

TEST(BuiltLoop, ADiagramIsOfOneKindOfLoop) {
  for (const std::string axis :
       {"control.measurement_filter=5:100:3", "control.drive_bandwidth=5:100:3",
        "control.processing_delay=0.0005:0.004:3"})
    expect_refused("diagram --quiet --axis " + axis,
                   {"--axis " + axis, "a range where all or none have it"});
}

/// 1/(2 Z_c s + M_c s² + K_p) under the true force.
TEST(EndlessString, AnswersAsTwoWavesAndTheAbsorber) {
  const TautString<double> string = taut_string(kollar2022_conductor());
  for (const double clamp : {0.0, 0.01}) {
    const Absorber<double> absorber{0.16, 74.4, 4.0, clamp};
    for (const double frequency : {3.0, 10.0, 40.0}) {
      const std::complex<double> s(0.0, 2.0 * pi<double> * frequency);
      const double expected =
          0.5 *
          std::abs(place_response(1.0 / (2.0 * string.wave_impedance() * s), absorber, s).to_force);
      const CsvTable cell = table_of(
          "response --quiet --p 0 --d 0 --set excitation.hold=exact --set "
          "plant.model=infinite_string --set absorber.clamp_mass=" +
          program::format_number(clamp) +
          " --set excitation.frequency=" + program::format_number(frequency));
      EXPECT_NEAR(cell.number(0, "amplitude_m"), expected, 1e-9 * expected);
    }
  }
}

/// The motion settles to that amplitude about a mean that nothing brings back.
TEST(EndlessString, MotionSwingsAsTheClosedForm) {
  for (const std::string clamp : {"0", "0.01"}) {
    const std::string settings =
        " --quiet --set plant.model=infinite_string --set control.differential_gain=-3"
        " --set backlash.law=none --set excitation.hold=exact --set absorber.clamp_mass=" +
        clamp;
    const CsvTable motion = table_of("simulate --duration 5 --from 4.5" + settings);
    const std::vector<double> z1 = motion.numbers("z1_m");
    const auto [lowest, highest] = std::minmax_element(z1.begin(), z1.end());
    const double amplitude =
        table_of("response --p -557 --d -3" + settings).number(0, "amplitude_m");
    EXPECT_NEAR(0.5 * (*highest - *lowest), amplitude, 2e-3 * amplitude) << clamp;
  }
}

/// Without play, switching between the samples changes nothing: the same motions by natural motions
/// and by a dense plant whose contact is followed.
TEST(BuiltLoop, DiagramBasinsAndSweepOfModesAreTheSameByBothRoutes) {
  const std::string string =
      " --quiet --set plant.model=string --set plant.modes=6 --set absorber.clamp_mass=0.01"
      " --set control.differential_gain=-3 --set backlash.width=0";
  const auto expect_equal = [&](const std::string& job, const std::vector<std::string>& columns) {
    const CsvTable paper = table_of(job + string);
    const CsvTable built = table_of(job + string + " --switching exact");
    ASSERT_EQ(built.rows(), paper.rows()) << job;
    ASSERT_GT(paper.rows(), 0U) << job;
    for (std::size_t row = 0; row < paper.rows(); ++row)
      for (const std::string& column : columns)
        EXPECT_NEAR(built.number(row, column), paper.number(row, column),
                    1e-9 * std::max(1e-3, std::abs(paper.number(row, column))))
            << job << column << row;
  };
  expect_equal("diagram --axis control.differential_gain=-3:-2:2 --transient 3.033 --strobes 4",
               {"z1_m", "v1_m_per_s", "z2_m", "v2_m_per_s"});
  expect_equal("basins --fractions --axis initial.z1=-1e-3:1e-3:2 --axis initial.z2=-1e-3:1e-3:2",
               {"period_samples", "amplitude_m", "largest_multiplier", "fraction"});
  expect_equal("sweep --axis control.differential_gain=-3:-2:2 --duration 20",
               {"steady_peak", "ratio_to_uncontrolled"});
}

/// A loop as it is built has the attractors that its motions come to one by one.
TEST(BuiltLoop, BasinsOfModesWithAFilterAreTheOrbitsOfTheirStarts) {
  const std::string string =
      " --quiet --set plant.model=string --set plant.modes=3 --set absorber.clamp_mass=0.01"
      " --set control.measurement_filter=80 --set control.differential_gain=-3";
  const CsvTable states =
      table_of("basins --axis initial.z1=-2e-3:2e-3:2 --axis initial.z2=0:3e-3:2" + string);
  ASSERT_EQ(states.rows(), 4U);
  for (std::size_t row = 0; row < states.rows(); ++row) {
    const std::string start = " --set initial.z1=" + states.text(row, "initial.z1") +
                              " --set initial.z2=" + states.text(row, "initial.z2");
    const CsvTable orbit = table_of("orbit" + string + start);
    EXPECT_EQ(states.number(row, "period_s"), orbit.number(0, "period_s")) << row;
  }
}

TEST(BuiltLoop, WhatIsNotAnsweredIsSaid) {
  expect_refused("boundary --set control.measurement_filter=0", {"control.measurement_filter"});
  expect_refused("boundary --set control.drive_bandwidth=-1", {"control.drive_bandwidth"});
  expect_refused("boundary --set control.drive_damping=0", {"control.drive_damping"});
  expect_refused("boundary --set control.processing_delay=0.2",
                 {"control.processing_delay", "100 times", "control.sampling_period"});
  for (const std::string settings :
       {" --set control.measurement_filter=80", " --set control.drive_bandwidth=80",
        " --set control.processing_delay=0.0015"}) {
    const std::string key = settings.substr(7, settings.find('=') - 7);
    for (const std::string job :
         {"decay --duration 0.1", "boundary --regions",
          "sweep --axis backlash.width=0:0.001:2 --best-gain", "stability --continuous"})
      expect_refused(job + " --quiet" + settings, {key, "two_masses"});
  }
  expect_refused("modal-damping --quiet --set plant.model=infinite_string", {"plant.model=cable"});
  expect_refused("simulate --switching exact --quiet --set plant.model=infinite_string",
                 {"absorber.clamp_mass"});
  expect_said("margins --set control.drive_damping=0.7", {"control.drive_bandwidth"});
}

}  // namespace
}  // namespace holdfast::tests
