#include "cli/program.hpp"

namespace holdfast::tests {
namespace {

using program::CsvTable;

const std::string exact_force = " --set excitation.hold=exact";
const std::vector<std::string> laws{"kollar", "immediate", "play", "dead_zone", "none"};

double steady_peak_of(const std::string& arguments) {
  return largest_in(table_of("simulate --duration 3 --from 1.5" + arguments), "z1_m");
}

TEST(ExactSwitching, AddsTheModeBehindTheFixedColumns) {
  const std::string fixed = header_of("simulate --duration 0.1");
  EXPECT_EQ(header_of("simulate --duration 0.1 --switching exact"), fixed + ",mode");
  EXPECT_EQ(header_of("orbit --trace --switching exact"), fixed + ",mode");
  const CsvTable table = table_of(
      "simulate --duration 3 --from 1 --switching exact --set control.sampling_period=1e-4");
  std::set<std::string> modes;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const std::string mode = table.text(row, "mode");
    modes.insert(mode);
    EXPECT_EQ(table.number(row, "in_backlash"), mode == "engaged" ? 0.0 : 1.0);
    if (mode == "gap") {
      EXPECT_EQ(table.number(row, "control_force_N"), 0.0);
    }
    if (mode == "stick") {
      EXPECT_NEAR(table.number(row, "v1_m_per_s"), table.number(row, "v2_m_per_s"), 1e-15);
    }
  }
  EXPECT_EQ(modes, (std::set<std::string>{"engaged", "gap", "stick"}));
}

TEST(ExactSwitching, IsUnderstoodWhereverAMotionIsComputed) {
  const std::vector<std::string> jobs{
      "spectrum --duration 10",
      "deviation --duration 1",
      "coverage --durations 1,2",
      "lyapunov --duration 2",
      "lyapunov --duration 0.1 --history",
      "orbit",
      "orbit --certificate",
      "verdict",
      "section --duration 2 --from 1",
      "diagram --axis backlash.width=0.0005:0.001:2 --transient 1 --strobes 3",
      "basins --axis initial.z1=-1e-4:1e-4:2 --axis initial.z2=0:1e-4:2 --fractions",
      "sweep --axis backlash.width=0.0005:0.001:2 --duration 2 --metric steady_peak --metric "
      "largest_exponent --metric period_samples --metric verdict --metric ratio_to_uncontrolled",
  };
  for (const std::string& job : jobs) {
    const Outcome outcome = run_holdfast(job + " --switching exact --quiet");
    EXPECT_EQ(outcome.exit_code, 0) << job << '\n' << outcome.errors;
    EXPECT_GE(lines_of(outcome.output).size(), 2U) << job;
    EXPECT_NE(outcome.output, run_holdfast(job + " --quiet").output) << job;
  }
}

TEST(ExactSwitching, TellsWhatGoesWithTheSampledRuleAlone) {
  expect_refused("orbit --follow backlash.width=0:0.003 --switching exact",
                 {"--follow", "--switching sampled"});
  expect_refused("lyapunov --tangent printed --switching exact",
                 {"--tangent printed", "--switching sampled"});
}

TEST(BacklashLaws, EachIsAMotionOfItsOwn) {
  std::set<double> peaks;
  for (const std::string& law : laws) peaks.insert(steady_peak_of(" --set backlash.law=" + law));
  EXPECT_EQ(peaks.size(), laws.size());
}

TEST(BacklashLaws, ThreeOfThemAreOneBetweenTheSamples) {
  const std::string job = "simulate --duration 1 --switching exact --set backlash.law=";
  const std::string kollar = run_holdfast(job + "kollar").output;
  EXPECT_EQ(run_holdfast(job + "immediate").output, kollar);
  EXPECT_EQ(run_holdfast(job + "play").output, kollar);
  EXPECT_NE(run_holdfast(job + "dead_zone").output, kollar);
}

TEST(ControllerLimits, OffIsByteIdenticalToNone) {
  const std::string job = "simulate --duration 2";
  const std::string none = run_holdfast(job).output;
  for (const std::string off :
       {"control.jitter=0", "control.displacement_quantum=0", "control.velocity_quantum=0",
        "control.largest_force=none", "control.velocity=measured", "excitation.noise_rms=0",
        "excitation.harmonics=[]", "backlash.law=kollar", "control.jitter_seed=7"})
    EXPECT_EQ(run_holdfast(job + " --set '" + off + "'").output, none) << off;
  for (const std::string on : {"control.jitter=1e-4", "control.displacement_quantum=1e-5",
                               "control.velocity_quantum=1e-5", "control.largest_force=0.1"})
    EXPECT_NE(run_holdfast(job + " --set " + on).output, none) << on;
}

TEST(ControllerLimits, BoundTheForce) {
  EXPECT_EQ(largest_in(table_of("simulate --duration 1 --set control.largest_force=0.1"),
                       "control_force_N"),
            0.1);
}

TEST(Excitations, ARecordOfTheHarmonicGivesItsMotion) {
  const TemporaryFolder folder;
  const std::string file = (folder / "force.csv").string();
  {
    std::ofstream record(file);
    record.precision(17);
    record << "time_s,force_N\n";
    for (int k = 0; k <= 20000; ++k) {
      const double time = k * 1e-4;
      record << time << ',' << 0.5 * std::cos(20.0 * std::acos(-1.0) * time) << '\n';
    }
  }
  const std::string job = "simulate --duration 1.9 --set backlash.width=0" + exact_force;
  const CsvTable harmonic = table_of(job);
  const CsvTable recorded =
      table_of(job + " --set excitation.amplitude=0 --set excitation.record=" + file);
  // A chord misses the cosine by at most (omega h)^2 / 8 of its amplitude.
  const double missed = std::pow(20.0 * std::acos(-1.0) * 1e-4, 2.0) / 8.0;
  for (std::size_t row = 0; row < harmonic.rows(); ++row) {
    EXPECT_NEAR(harmonic.number(row, "z1_m"), recorded.number(row, "z1_m"), 0.01 * missed);
  }
  expect_refused("simulate --duration 5 --set excitation.record=" + file,
                 {"excitation.record", "ends at"});
}

}  // namespace
}  // namespace holdfast::tests
