// The conductor itself by its modes (plant.model = "string"): a string of one mode against the two
// masses that it is, longer ones against eigenvalues, and what is refused.

#include "cli/program.hpp"
#include "holdfast/cable/taut_string.hpp"

namespace holdfast::tests {
namespace {

using program::CsvTable;

const std::string one_mode = " --quiet --set plant.model=string --set plant.modes=1";

/// The first mode at the absorber's place is one mass on a spring.
std::string its_two_masses() {
  const PlaceMode<double> mode = string_modes(taut_string(kollar2022_conductor()), 0.64, 1).front();
  const double mass = mode.mass / (mode.shape * mode.shape), omega = mode.angular_frequency;
  return " --quiet --set plant.conductor_mass=" + program::format_number(mass) +
         " --set plant.conductor_stiffness=" + program::format_number(mass * omega * omega) +
         " --set plant.conductor_damping=" +
         program::format_number(2.0 * mode.damping_ratio * omega * mass);
}

TEST(String, OfOneModeIsTwoMasses) {
  const auto compare = [](const std::string& job, const std::vector<std::string>& columns,
                          double tolerance) {
    expect_same(table_of(job + one_mode), table_of(job + its_two_masses()), columns, tolerance);
  };
  for (const char* sampling : {"", " --set control.sampling_period=0.01",
                               " --set control.sampling_period=0.003"
                               " --set control.processing_delay=0.002"}) {
    compare(std::string("boundary --stable-interval --p -900,-557,0 --d -13,0") + sampling,
            {"other_gain", "lower", "upper"}, 1e-7);
    compare(std::string("stability --p -1000:200:25 --d -41.3:20:25 --radius") + sampling,
            {"stable", "spectral_radius"}, 1e-9);
    compare(
        "simulate --duration 2 --set backlash.width=0.002 --set initial.z1=0.001"
        " --set initial.v2=0.01" +
            std::string(sampling),
        {"z1_m", "v1_m_per_s", "z2_m", "v2_m_per_s", "control_force_N", "in_backlash"}, 1e-8);
  }
  for (const char* hold : {"sampled", "exact"})
    compare(std::string("response --p -900:0:7 --d -30:5:8 --set excitation.hold=") + hold,
            {"stable", "amplitude_m", "ratio_to_uncontrolled"}, 1e-8);
  for (const char* sampling : {"", " --set control.processing_delay=0.0005"}) {
    compare(std::string("design --largest-radius 0.9998") + sampling,
            {"least_amplitude_gain", "ratio_to_uncontrolled", "spectral_radius", "gain_margin_dB",
             "phase_margin_deg", "delay_margin_s"},
            1e-4);
    const std::string job = std::string("margins --quiet") + sampling;
    const CsvTable found = table_of(job + one_mode), expected = table_of(job + its_two_masses());
    ASSERT_EQ(found.rows(), expected.rows());
    for (std::size_t row = 0; row < found.rows(); ++row) {
      if (expected.text(row, "outcome") != "boundary") continue;
      // A hundred periods are walked.
      if (expected.text(row, "quantity") == "sampling_period" &&
          expected.number(row, "position") > 0.1)
        continue;
      EXPECT_EQ(found.text(row, "outcome"), "boundary") << row;
      EXPECT_EQ(found.text(row, "curve"), expected.text(row, "curve")) << row;
      EXPECT_NEAR(found.number(row, "position") / expected.number(row, "position"), 1.0, 1e-7);
    }
  }
  compare("simulate --duration 1 --kick 0.3:0.0005", {"z1_m", "z2_m", "control_force_N"}, 1e-8);
  compare("spectrum --duration 4", {"frequency_Hz", "amplitude_m"}, 1e-8);
  // Not from rest, where the round-off of Δż = 0 would decide whether the drive enters its gap.
  compare("deviation --duration 1 --set initial.v2=0.01", {"z1_deviation_m", "state_deviation"},
          1e-6);
  compare("coverage --durations 1,3", {"visited", "fraction"}, 1e-9);
  compare("simulate --duration 0.5 --no-control", {"z1_m", "z2_m"}, 1e-10);
  compare("simulate --duration 0.3 --switching exact --set backlash.width=0.002",
          {"z1_m", "v1_m_per_s", "z2_m", "in_backlash"}, 1e-8);
}

/// On each boundary point a root of modulus 1.
TEST(String, BoundaryHasARootOnTheCircle) {
  const std::string string = " --quiet --set plant.model=string --set plant.modes=6";
  const CsvTable boundary = table_of("boundary --p -600:-550" + string);
  ASSERT_GT(boundary.rows(), 20U);
  std::size_t on_edge = 0;
  for (std::size_t row = 0; row < boundary.rows(); row += 7) {
    const double p = boundary.number(row, "proportional_gain");
    const double d = boundary.number(row, "differential_gain");
    if (!std::isfinite(d)) continue;
    const CsvTable cell = cell_of("stability --radius", p, d, string);
    EXPECT_GT(cell.number(0, "spectral_radius"), 1.0 - 1e-8) << p << ' ' << d;
    on_edge += cell.number(0, "spectral_radius") < 1.0 + 1e-8 ? 1U : 0U;
  }
  EXPECT_GT(on_edge, 0U);
}

TEST(String, ModalDampingTellsWhichRootGrows) {
  const std::string string =
      "modal-damping --count 9 --set plant.model=string --set plant.modes=60"
      " --set control.sampling_period=0.003";
  const CsvTable table = table_of(string + " --quiet --no-control");
  ASSERT_EQ(table.rows(), 9U);
  for (std::size_t row = 0; row < table.rows(); ++row) {
    EXPECT_EQ(table.number(row, "mode"), static_cast<double>(row + 1));
    EXPECT_EQ(table.number(row, "damping_ratio_bare"), 0.02);
    EXPECT_GT(table.number(row, "damping_ratio"), 0.019);
  }
  expect_holds(run_holdfast(string).errors, {"only for light devices"});
  const std::string grows = run_holdfast(string + " --set control.differential_gain=-8").errors;
  expect_holds(grows, {"a faster mode or the absorber's clamp under control grows"});
  const std::string rests = run_holdfast(string + " --set control.differential_gain=-3").errors;
  EXPECT_EQ(rests.find("unstable"), std::string::npos) << rests;
}

TEST(String, JobsOfTwoMassesRefuseIt) {
  for (const std::string job : {"decay", "peaks", "fit"})
    expect_refused(job + " --set plant.model=string", {"plant.model", "two_masses", "boundary"});
  for (const std::string options :
       {"stability --continuous",
        "stability --axis control.sampling_period=0.001:0.01:2"
        " --axis control.differential_gain=-9:0:2",
        "boundary --regions", "boundary --continuous", "orbit --follow backlash.width=0:0.001",
        "orbit --map backlash.width=0.0001:0.001 --map control.differential_gain=-20:0",
        "basins --map backlash.width=0:0.001:2 --map control.differential_gain=-20:0:2",
        "lyapunov --tangent printed", "sweep --axis backlash.width=0:0.001:2 --best-gain"})
    expect_refused(options + " --quiet --set plant.model=string", {"two_masses"});
  for (const std::string options : {"lyapunov", "lyapunov --history"})
    expect_refused(options + " --switching exact --quiet --set plant.model=string",
                   {"the model of Kollár (2022)"});
  expect_refused("modal-damping", {"plant.model=cable"});
  expect_refused("simulate --switching exact --kick 0.1:0.001 --quiet --set plant.model=string",
                 {"--kick", "only for a conductor in the model of Kollár (2022)"});
}

TEST(String, WrongInputIsNamed) {
  expect_refused("boundary --set plant.model=strnig", {"plant.model", "string"});
  expect_refused("boundary --set plant.modes=0", {"plant.modes", "at least 1"});
  expect_refused("boundary --set plant.modes=2.5", {"plant.modes", "whole"});
  expect_refused("boundary --set conductor.tension=0", {"conductor.tension", "greater than 0"});
  expect_refused("boundary --set absorber.clamp_mass=-0.01", {"absorber.clamp_mass"});
  expect_refused("boundary --set conductor.tension=9 --set conductor.sag=0.29",
                 {"conductor.tension", "conductor.sag", "contradict"});
  expect_refused(
      "boundary --stable-interval --quiet --set plant.model=string"
      " --set plant.modes=3 --set absorber.position=1e-8",
      {"absorber.position", "does not move"});
  expect_refused("boundary --set absorber.clamp_mass=1e300", {"absorber.clamp_mass", "at most"});
  expect_refused("boundary --set conductor.bending_stiffness=1e300", {"bending_stiffness"});
  for (const std::string heavy : {"absorber.clamp_mass=10", "conductor.bending_stiffness=1"}) {
    const Outcome doubted =
        run_holdfast("boundary --set plant.model=string --set plant.modes=5 --set " + heavy);
    EXPECT_EQ(doubted.exit_code, 0) << heavy;
    EXPECT_NE(doubted.errors.find(heavy.substr(0, heavy.find('='))), std::string::npos)
        << doubted.errors;
  }
  expect_said("margins --set absorber.clamp_mass=0.01", {"absorber.clamp_mass"});
}

/// What is kept of the conductor is said where it decides, and all modes count unless told not to.
TEST(String, SaysWhatTheModesLeftOutWouldChange) {
  const std::string ask = "boundary --stable-interval --p -557 --set plant.model=string";
  expect_said(ask + " --set plant.modes=20",
              {"more mass at the clamp", "with all modes the interval is"});
  const std::string settled = " --set absorber.clamp_mass=0.01 --set control.sampling_period=0.01";
  const std::string errors = run_holdfast(ask + settled).errors;
  EXPECT_EQ(errors.find("warning"), std::string::npos) << errors;
  expect_said(ask + settled + " --set conductor.damping_ratio=0.0005",
              {"waves returning from the supports"});
  expect_said(ask + settled + " --set excitation.frequency=700", {"is faster than these"});
  // Without plant.modes the answer hardly moves with the computer's speed; 20 modes are 14 g.
  const CsvTable slow = table_of(ask + " --quiet --set control.sampling_period=2e-4");
  const CsvTable fast = table_of(ask + " --quiet --set control.sampling_period=2e-5");
  EXPECT_NEAR(fast.number(0, "lower") / slow.number(0, "lower"), 1.0, 0.1);
}

/// Waves of 24 Hz end the gains, far above 300 modes of 1200 m; the closed form ends at 305 N s/m.
TEST(String, KeepsTheModesThatEndTheGains) {
  const CsvTable table =
      table_of("boundary --stable-interval --p 0 --quiet --case '" HOLDFAST_SOURCE_DIR
               "/tests/cases/crossing-1200m.toml'");
  EXPECT_NEAR(table.number(0, "upper"), 305.0, 3.0);
}

/// Motions, sweeps, orbits and verdicts of one mode are those of two masses.
TEST(String, OrbitVerdictAndSweepOfOneModeAreThoseOfTwoMasses) {
  const std::string settings =
      " --set control.sampling_period=0.005 --set control.differential_gain=-4"
      " --set backlash.width=0.0005 --set excitation.amplitude=0.6";
  const auto compare = [&](const std::string& job, const std::vector<std::string>& columns,
                           double tolerance) {
    expect_same(table_of(job + settings + one_mode), table_of(job + settings + its_two_masses()),
                columns, tolerance);
  };
  compare("orbit", {"period_samples", "period_s", "forcing_periods", "largest_multiplier"}, 1e-8);
  compare("orbit --trace", {"z1_m", "v1_m_per_s", "z2_m", "control_force_N"}, 1e-7);
  compare("verdict", {"period_samples", "certified"}, 0.0);
  compare("lyapunov --duration 200 --discard 60", {"per_sample"}, 1e-2);
  compare("diagram --axis backlash.width=0.0004:0.0006:3 --transient 20 --strobes 6",
          {"z1_m", "v1_m_per_s", "z2_m", "v2_m_per_s"}, 1e-6);
  compare("section --duration 12 --from 11", {"time_s", "z1_m", "v1_m_per_s", "z2_m"}, 1e-7);
  compare(
      "sweep --axis backlash.width=0.0001:0.001:4 --metric steady_peak"
      " --metric ratio_to_uncontrolled --metric force_peak --metric engaged_fraction"
      " --metric absorber_stroke --duration 10",
      {"steady_peak", "ratio_to_uncontrolled", "force_peak", "engaged_fraction", "absorber_stroke"},
      1e-7);
  compare("max-delay --frequency 6:12:2", {"max_sampling_period_s"}, 1e-6);
}

TEST(String, HistoryOfExponentsEndsAtTheExponents) {
  const std::string settings = " --duration 2 --quiet --set plant.model=string";
  const CsvTable history = table_of("lyapunov --history" + settings),
                 exponents = table_of("lyapunov" + settings);
  ASSERT_EQ(exponents.rows(), 5U);
  for (std::size_t k = 0; k < 5; ++k)
    EXPECT_EQ(history.number(history.rows() - 1, "lambda" + std::to_string(k + 1)),
              exponents.number(k, "per_sample"));
}

/// The certificate tells how far from the orbit all motions come to it; and of the cable, with a
/// hundred modes and more, it takes no longer than of a few.
TEST(String, OrbitsOfManyModesAreCertified) {
  for (const std::string plant : {"string", "cable"}) {
    const CsvTable table =
        table_of("orbit --certificate --quiet --set plant.model=" + plant +
                 " --set control.sampling_period=0.005 --set control.differential_gain=-4"
                 " --set backlash.width=0.0001");
    const double smallest = value_of(table, "capture_radius_smallest");
    EXPECT_GT(smallest, 0.0) << plant;
    EXPECT_GE(value_of(table, "capture_radius_largest"), smallest) << plant;
    EXPECT_LT(value_of(table, "multiplier_1_modulus"), 1.0) << plant;
    EXPECT_LE(value_of(table, "closure_error"), 1e-12 * value_of(table, "amplitude")) << plant;
    row_of(table, "multiplier_10_modulus");
    for (std::size_t row = 0; row < table.rows(); ++row)
      EXPECT_NE(table.text(row, "quantity"), "multiplier_11_modulus") << plant;
  }
}

/// The roots of the modes at once make the radii, against the eigenvalues of the map.
TEST(String, RadiusOfTheCaseIsThatOfItsCell) {
  const std::string string =
      " --quiet --set plant.model=string --set control.sampling_period=0.02"
      " --set control.differential_gain=-3";
  const CsvTable told = table_of("case" + string);
  const double radius = told.number(row_of(told, "spectral_radius", "key"), "value");
  const CsvTable cell = cell_of("stability --radius", -557.0, -3.0, string);
  EXPECT_NEAR(cell.number(0, "spectral_radius"), radius, 1e-12);
  EXPECT_EQ(cell.number(0, "stable") == 1.0, radius < 1.0);
}

/// The absorber on another conductor is the same one: nothing is reduced to two masses, also where
/// none exist.
TEST(String, OfAnotherTensionNeedsNoTwoMasses) {
  const std::string ask =
      "boundary --stable-interval --p -557 --set plant.model=string --set plant.modes=8 --set ";
  const double own = taut_string(kollar2022_conductor()).tension;
  for (const double factor : {1.2, 120.0}) {
    const CsvTable by_tension =
        table_of(ask + "conductor.tension=" + program::format_number(factor * own) + " --quiet");
    const CsvTable by_sag =
        table_of(ask + "conductor.sag=" + program::format_number(0.29 / factor) + " --quiet");
    for (const char* end : {"lower", "upper"})
      EXPECT_NEAR(by_tension.number(0, end) / by_sag.number(0, end), 1.0, 1e-9) << factor;
  }
  const std::string errors = run_holdfast(ask + "conductor.tension=9").errors;
  expect_holds(errors, {"plant.absorber_stiffness, plant.absorber_damping not given"});
}

}  // namespace
}  // namespace holdfast::tests
