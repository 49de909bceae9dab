#include "cli/program.hpp"

namespace holdfast::tests {
namespace {

using program::CsvTable;
using program::parse_csv;

TEST(Jobs, ColumnsAreThoseOtherProgramsRead) {
  EXPECT_EQ(header_of("stability --p -600:0:3 --d -20:0:3"),
            "proportional_gain,differential_gain,stable");
  EXPECT_EQ(header_of("stability --radius --p -600:0:3 --d -20:0:3"),
            "proportional_gain,differential_gain,stable,spectral_radius");
  EXPECT_EQ(header_of("stability --radius --continuous --p -600:0:3 --d -20:0:3"),
            "proportional_gain,differential_gain,stable,spectral_abscissa");
  EXPECT_EQ(header_of("stability --prove --p -600:0:3 --d -20:0:3"),
            "proportional_gain_from,proportional_gain_to,differential_gain_from,"
            "differential_gain_to,proved,area_share");
  EXPECT_EQ(header_of("boundary"), "curve,angle_rad,proportional_gain,differential_gain");
  EXPECT_EQ(header_of("max-delay --frequency 10:10:1"),
            "frequency_Hz,proportional_gain,max_sampling_period_s,differential_gain");
  EXPECT_EQ(header_of("response --p -600:0:3 --d -20:0:3"),
            "proportional_gain,differential_gain,stable,amplitude_m,ratio_to_uncontrolled");
  EXPECT_EQ(header_of("design"),
            "frequency_Hz,proportional_gain,least_amplitude_gain,ratio_to_uncontrolled,"
            "attenuation_dB,least_radius_gain,least_radius,least_amplitude_at,"
            "spectral_radius,gain_margin_dB,phase_margin_deg,delay_margin_s");
  EXPECT_EQ(header_of("design --band 9:11"),
            "frequency_min_Hz,frequency_max_Hz,proportional_gain,differential_gain,worst_ratio,"
            "worst_frequency_Hz,attenuation_dB,lower_bound,"
            "spectral_radius,gain_margin_dB,phase_margin_deg,delay_margin_s");
  EXPECT_EQ(header_of("design --both-gains"), header_of("design"));
  EXPECT_EQ(header_of("margins"),
            "quantity,unit,value,side,outcome,position,distance,curve,frequency_Hz");
  EXPECT_EQ(header_of("sensitivity"),
            "answer,value,unit,parameter,parameter_unit,derivative,relative");
  EXPECT_EQ(header_of("stability --axis control.sampling_period=0.001:0.01:2 --axis "
                      "plant.absorber_mass=0.1:0.2:3"),
            "control.sampling_period,plant.absorber_mass,stable");
  EXPECT_EQ(header_of("margins --prove"),
            "quantity,unit,value,side,outcome,position,distance,curve,frequency_Hz,"
            "proved_stable_to,proved_unstable_at,proof");
  EXPECT_EQ(header_of("max-delay --frequency 10:10:1 --criterion stable --prove"),
            "frequency_Hz,proportional_gain,max_sampling_period_s,differential_gain,"
            "proved_from_s,proved_sampling_period_s");
  EXPECT_EQ(header_of("simulate --duration 0.1"),
            "time_s,z1_m,v1_m_per_s,z2_m,v2_m_per_s,control_force_N,in_backlash");
  EXPECT_EQ(header_of("spectrum --duration 2"), "frequency_Hz,amplitude_m");
  EXPECT_EQ(header_of("deviation --duration 0.1"), "time_s,z1_deviation_m,state_deviation");
  EXPECT_EQ(header_of("coverage --durations 1,2"), "duration_s,cells,visited,fraction");
  EXPECT_EQ(header_of("orbit"),
            "period_samples,period_s,forcing_periods,largest_multiplier,closure_error,"
            "border_distance_m,engaged_fraction");
  EXPECT_EQ(header_of("orbit --trace"),
            "time_s,z1_m,v1_m_per_s,z2_m,v2_m_per_s,control_force_N,in_backlash");
  EXPECT_EQ(header_of("orbit --certificate"), "quantity,value,unit");
  EXPECT_EQ(header_of("orbit --prove"), "quantity,value,unit");
  EXPECT_EQ(header_of("orbit --prove --follow backlash.width=0.00049:0.00051"),
            "from,to,outcome,decided_by,surface,sample,reason");
  EXPECT_EQ(header_of("orbit --follow backlash.width=0:0.001"),
            "side,outcome,position,distance,surface,sample,largest_multiplier,"
            "multiplier_angle_rad");
  EXPECT_EQ(header_of("orbit --map backlash.width=0.0004:0.0006 --map "
                      "control.differential_gain=-14:-12"),
            "piece,border,surface,sample,backlash.width,control.differential_gain,"
            "largest_multiplier,multiplier_angle_rad,meeting");
  const std::string cells =
      "basins --map backlash.width=0.001:0.002:2 --map control.sampling_period=0.01:0.011:2";
  EXPECT_EQ(header_of(cells),
            "backlash.width,control.sampling_period,outcome,forcing_periods,period_s,amplitude_m,"
            "border_share,motions,least_forcing_periods,most_forcing_periods,least_amplitude_m,"
            "most_amplitude_m");
  EXPECT_EQ(header_of("basins --axis initial.z1=0:0.001:2 --axis initial.v2=0:0.1:2"),
            "initial.z1,initial.v2,attractor,period_s");
  EXPECT_EQ(header_of("section --duration 1 --from 0.5"),
            "time_s,z1_m,v1_m_per_s,z2_m,rising,in_backlash");
  EXPECT_EQ(header_of("diagram --axis backlash.width=0:0.001:2 --transient 1 --strobes 2"),
            "backlash.width,upward,z1_m,v1_m_per_s,z2_m,v2_m_per_s");
  EXPECT_EQ(header_of("lyapunov --duration 1"), "exponent,per_sample,per_second,standard_error");
  EXPECT_EQ(header_of("lyapunov --duration 0.1 --history"),
            "time_s,lambda1,lambda2,lambda3,lambda4,lambda5");
}

/// Two masses, a string, and two masses whose force comes two samples late.
TEST(Stability, ItsProofAgreesWithTheVerdict) {
  const std::string range = " --p -600:100:15 --d -20:10:7 --set control.sampling_period=0.008";
  for (const std::string loop :
       {"", " --set plant.model=string", " --set control.processing_delay=0.013"}) {
    const CsvTable proved = table_of("stability --prove" + range + loop);
    const CsvTable chart = table_of("stability" + range + loop);
    double undecided = 0.0, area = 0.0;
    int asked = 0;
    for (std::size_t box = 0; box < proved.rows(); ++box) {
      const std::string& verdict = proved.text(box, "proved");
      const auto holds = [&](const std::string& gain, double value) {
        return proved.number(box, gain + "_from") <= value &&
               value <= proved.number(box, gain + "_to");
      };
      area += proved.number(box, "area_share");
      if (verdict == "undecided") undecided += proved.number(box, "area_share");
      for (std::size_t cell = 0; cell < chart.rows() && verdict != "undecided"; ++cell) {
        const double p = chart.number(cell, "proportional_gain");
        const double d = chart.number(cell, "differential_gain");
        if (!holds("proportional_gain", p) || !holds("differential_gain", d)) continue;
        EXPECT_EQ(chart.number(cell, "stable") == 1.0, verdict == "stable") << p << " " << d;
        ++asked;
      }
    }
    EXPECT_NEAR(area, 1.0, 1e-9);
    EXPECT_LE(undecided, 1e-3);
    EXPECT_GT(asked, 80);
  }
}

/// Of a string that hardly damps, of which steps along the period pass over a window: every
/// position is looked at without being asked.
TEST(Margins, PassOverNoWindow) {
  const std::string margins =
      "margins --set plant.model=string --set plant.modes=6 "
      "--set conductor.damping_ratio=0.001 --set absorber.clamp_mass=0.01 "
      "--set control.sampling_period=0.00205 --set control.proportional_gain=-117 "
      "--set control.differential_gain=0.264";
  const CsvTable found = table_of(margins + " --quiet"),
                 proved = table_of(margins + " --quiet --prove");
  for (std::size_t row = 0; row < proved.rows(); ++row) {
    EXPECT_EQ(found.text(row, "outcome"), proved.text(row, "outcome"));
    if (proved.text(row, "outcome") != "boundary") continue;
    const double value = proved.number(row, "value"), distance = proved.number(row, "distance");
    const double stable = std::abs(proved.number(row, "proved_stable_to") - value);
    const double unstable = std::abs(proved.number(row, "proved_unstable_at") - value);
    EXPECT_GE(distance, stable * (1.0 - 1e-9)) << row;
    EXPECT_LE(distance, unstable * (1.0 + 1e-9)) << row;
    EXPECT_NEAR(found.number(row, "distance"), distance, 1e-8 * std::abs(value)) << row;
  }
  EXPECT_EQ(run_holdfast(margins).errors.find("searched in steps"), std::string::npos);
  const Outcome unsure = run_holdfast(
      "margins --set plant.model=string --set plant.modes=4 "
      "--set control.velocity=difference");
  expect_holds(unsure.errors, {"searched in steps of 5 %"});
  EXPECT_EQ(unsure.errors.find("--prove"), std::string::npos);
}

/// Of a cable whose fastest waves hardly move the roots near the circle little is proved: it says
/// so, and tells no number that was not.
TEST(Margins, SayWhatIsNotProved) {
  const std::string job =
      "margins --prove --set plant.model=cable --set plant.modes=20 --set "
      "control.differential_gain=-5";
  const Outcome told = run_holdfast(job);
  ASSERT_EQ(told.exit_code, 0) << told.errors;
  const CsvTable table = parse_csv(told.output, job);
  bool is_whole = true;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const std::string proof = table.text(row, "proof");
    const double value = table.number(row, "value"), stable = table.number(row, "proved_stable_to");
    is_whole = is_whole && proof == "proved";
    const bool nothing = proof.rfind("not proved: ", 0) == 0;
    EXPECT_EQ(nothing, std::isnan(stable)) << row;
    if (proof.rfind("in part: ", 0) == 0) {
      EXPECT_NE(stable, value) << row;
    }
    EXPECT_TRUE(nothing || proof == "proved" || proof.rfind("in part: ", 0) == 0) << proof;
  }
  EXPECT_EQ(is_whole,
            told.errors.find("some ends of the stable ranges are not proved") == std::string::npos);
}

TEST(Margins, RefusesProofsOfWhatItCannotProve) {
  expect_refused("margins --prove --set control.velocity=difference",
                 {"--prove", "measured velocity"});
  expect_refused("margins --prove --set plant.model=infinite_string", {"can drift"});
  expect_refused("max-delay --prove", {"--criterion stable"});
  expect_refused("max-delay --prove --criterion attenuates", {"--criterion stable"});
}

TEST(Stability, RefusesProofsOfWhatItCannotProve) {
  expect_refused("stability --undecided 0.01", {"--prove"});
  expect_refused("stability --prove --p -557", {"--p", "two"});
  expect_refused("stability --prove --radius", {"--radius"});
  expect_refused("stability --prove --undecided 0", {"--undecided"});
  expect_refused("stability --prove --continuous --set plant.model=string", {"two_masses"});
  expect_refused("stability --prove --set plant.model=infinite_string", {"can drift"});
  expect_refused("stability --prove --output x.nc", {"x.nc", ".csv"});
  for (const std::string computer :
       {"velocity=difference", "displacement_quantum=1e-5", "largest_force=3", "jitter=1e-4"}) {
    expect_refused("stability --prove --set control." + computer, {"--prove", "measured velocity"});
    expect_refused("stability --prove --set plant.model=string --set control." + computer,
                   {"--prove", "measured velocity"});
  }
  expect_refused("stability --prove --p -557:-556.9999999999999:5", {"cell"});
}

TEST(Boundary, NamesItsCurves) {
  const CsvTable sampled = table_of("boundary --set control.sampling_period=0.01");
  bool flip = false, pair = false;
  for (std::size_t row = 0; row < sampled.rows(); ++row) {
    flip = flip || sampled.text(row, "curve") == "minus_one";
    pair = pair || sampled.text(row, "curve") == "complex_pair";
    EXPECT_NE(sampled.text(row, "curve"), "plus_one");
  }
  EXPECT_TRUE(flip && pair);
  const CsvTable continuous = table_of("boundary --continuous");
  EXPECT_EQ(continuous.text(0, "curve"), "imaginary_pair");
}

TEST(Simulate, FromDropsTheRowsBeforeAndNothingElse) {
  const CsvTable whole = table_of("simulate --duration 1");
  const CsvTable tail = table_of("simulate --duration 1 --from 0.5");
  ASSERT_EQ(tail.rows(), 501U);
  EXPECT_EQ(tail.text(0, "time_s"), "0.5");
  EXPECT_EQ(tail.text(500, "z1_m"), whole.text(1000, "z1_m"));
}

TEST(Simulate, FromKeepsTheSampleThatIsMeantInSpiteOfRounding) {
  const CsvTable table =
      table_of("simulate --duration 0.055 --from 0.055 --set control.sampling_period=0.011");
  EXPECT_EQ(table.rows(), 1U);
}

TEST(Coverage, OfAMotionAtRestHasNoAnswer) {
  expect_refused("coverage --set excitation.amplitude=0 --durations 1,2", {"stays at rest"}, 1);
}

TEST(Simulate, WithoutControlThereIsNoForceAndNoBacklash) {
  const CsvTable table = table_of("simulate --duration 0.5 --no-control");
  EXPECT_EQ(largest_in(table, "control_force_N"), 0.0);
  EXPECT_EQ(largest_in(table, "in_backlash"), 0.0);
}

TEST(Simulate, KickDisplacesTheConductorAtItsInstant) {
  const CsvTable plain = table_of("simulate --duration 1"),
                 kicked = table_of("simulate --duration 1 --kick 0.9:0.003");
  EXPECT_EQ(plain.text(899, "z1_m"), kicked.text(899, "z1_m"));
  EXPECT_NEAR(kicked.number(900, "z1_m") - plain.number(900, "z1_m"), 0.003, 1e-15);
}

TEST(Lyapunov, TheLargestAloneIsTheFirstOfAll) {
  const std::string job = "lyapunov --set backlash.width=0.002 --duration 1000 --discard 20";
  const CsvTable whole = table_of(job), largest = table_of(job + " --largest");
  ASSERT_EQ(largest.rows(), 1U);
  EXPECT_NEAR(largest.number(0, "per_sample"), whole.number(0, "per_sample"), 1e-4);
  EXPECT_EQ(run_holdfast(job + " --history").exit_code, 2);
}

TEST(Lyapunov, NullDirectionIsMinusInfinity) {
  const CsvTable table = table_of("lyapunov --duration 5 --quiet");
  ASSERT_EQ(table.rows(), 5U);
  EXPECT_EQ(table.text(4, "per_sample"), "-inf");
  EXPECT_EQ(table.text(4, "per_second"), "-inf");
  EXPECT_NEAR(table.number(0, "per_second"), table.number(0, "per_sample") / 0.001, 1e-12);
}

TEST(Coverage, GrowsWithTime) {
  const CsvTable table = table_of("coverage --durations 20,10 --cells 20");
  ASSERT_EQ(table.rows(), 2U);
  EXPECT_EQ(table.number(0, "duration_s"), 10.0);
  EXPECT_EQ(table.number(0, "cells"), 400.0);
  EXPECT_LE(table.number(0, "visited"), table.number(1, "visited"));
  EXPECT_DOUBLE_EQ(table.number(1, "fraction"), table.number(1, "visited") / 400.0);
}

const std::string deep_span =
    " --quiet --set conductor.name=Drake --set conductor.span=300 --set conductor.sag=";

/// An absorber next to none, where no slow mode has a node; Lanczos' process finds its modes.
TEST(Modes, OfADeepSpanAreAllThereAndThoseThatItsPlantHas) {
  const CsvTable modes = table_of("modes --count 6" + deep_span + "80");
  const CsvTable plant = table_of(
      "modal-damping --count 6 --no-control --set plant.model=cable --set absorber.position=100"
      " --set plant.absorber_mass=1e-4" +
      deep_span + "80");
  ASSERT_EQ(modes.rows(), 6U);
  ASSERT_EQ(plant.rows(), 6U);
  for (std::size_t row = 0; row < modes.rows(); ++row)
    EXPECT_NEAR(modes.number(row, "elements_Hz") / plant.number(row, "frequency_Hz"), 1.0, 1e-3);
  EXPECT_GT(modes.number(0, "along_share"), 0.5);
  // The n-th of its family, whichever way it moves: sin nπx/L of the taut string.
  EXPECT_NEAR(modes.number(2, "irvine_Hz") / modes.number(0, "irvine_Hz"), 2.0, 1e-9);
}

TEST(Modes, AlongTheConductorHaveItsStretchAndNoneOfIrvine) {
  const CsvTable modes = table_of("modes --count 40 --elements 400" + deep_span + "8");
  // √(EA/μ)/(2 S), S the length of the conductor, L + 8 d²/(3 L).
  const double modulus = 62e9, area = 468.6e-6, mass = 1.628, length = 300.57;
  int along = 0;
  double before = 0.0;
  for (std::size_t row = 0; row < modes.rows(); ++row) {
    const double frequency = modes.number(row, "elements_Hz");
    EXPECT_GE(frequency, before);
    before = frequency;
    const bool has_none = std::isnan(modes.number(row, "irvine_Hz"));
    EXPECT_EQ(has_none, modes.number(row, "along_share") > 0.5);
    if (!has_none) continue;
    ++along;
    EXPECT_NEAR(frequency / (std::sqrt(modulus * area / mass) / (2.0 * length)), 1.0, 0.15);
  }
  EXPECT_EQ(along, 1);
}

TEST(Charts, ShowTheGainsOfTheCaseWhereNoWindowIsAskedFor) {
  const std::string large =
      " --quiet --set plant.absorber_stiffness=180000 --set plant.absorber_mass=5 --set "
      "plant.conductor_stiffness=1e5 --set plant.conductor_mass=50"
      " --set control.differential_gain=-300 --set control.proportional_gain=";
  for (const double gain : {-136457.0, -0.5, 3e4})
    for (const char* job : {"stability", "response", "boundary"}) {
      const CsvTable table = table_of(job + large + std::to_string(gain));
      const auto p = table.numbers("proportional_gain");
      const auto [lowest, highest] = std::minmax_element(p.begin(), p.end());
      EXPECT_LT(*lowest, gain) << job;
      EXPECT_GT(*highest, gain) << job;
      EXPECT_GT(*highest - *lowest, 180000.0) << job;
    }
  const CsvTable given = table_of("stability --p -5:5:2 --d -1:1:2" + large + "-136457");
  EXPECT_EQ(given.numbers("proportional_gain").front(), -5.0);
  EXPECT_EQ(table_of("stability").numbers("proportional_gain").front(), -1000.0);
}

TEST(Threads, DoNotChangeAnyByte) {
  const std::string job = "stability --p -1000:200:31 --d -40:20:31 --threads ";
  EXPECT_EQ(run_holdfast(job + "1").output, run_holdfast(job + "2").output);
}

TEST(Wind, GivesFrequencyAndAmplitude) {
  const TextFile wind("[wind]\nspeed = 1.0\ndiameter = 0.02\neffective_length = 5.0\n");
  // f = 0.2 · 1 / 0.02 = 10 Hz, F = ½ · 1.225 · 1² · 0.02 · 5 · 1 = 0.06125 N.
  const CsvTable a = parse_csv(printed_by("simulate --duration 1" + wind.as_case()), "wind");
  const CsvTable b = table_of("simulate --duration 1 --set excitation.amplitude=0.06125");
  for (std::size_t row = 0; row < a.rows(); ++row) {
    EXPECT_NEAR(a.number(row, "z1_m"), b.number(row, "z1_m"), 1e-12);
  }
}

TEST(Jobs, ThatHaveNoNumberSaySo) {
  for (const auto& [job, reason] :
       {std::pair{"sensitivity --set control.measurement_filter=2.269e-86",
                  "derivative is nan in "},
        {"deviation --set initial.v2=3.5e58", "give a larger --offset"},
        {"deviation --offset 1e-30 --set initial.z1=0.001", "give a larger --offset"}}) {
    expect_refused(std::string(job) + " --quiet", {reason}, 1);
  }
}

TEST(Peaks, BeforeTheFirstOfThemAreNone) {
  const Outcome outcome = run_holdfast("peaks --duration 0.05 --force 0.1:0.2:2");
  EXPECT_EQ(outcome.exit_code, 1);
  if (outcome.errors.find("SUNDIALS") == std::string::npos) {
    expect_holds(outcome.errors, {"give a longer --duration"});
  }
}

TEST(Jobs, WriteNoSignedZero) {
  for (const char* job : {"simulate --duration 0", "simulate --duration 0.01 --no-control",
                          "response --p -600:0:3 --d -20:0:3", "sensitivity"}) {
    const Outcome outcome = run_holdfast(job);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
    for (const char* zero : {",-0,", ",-0\r"})
      EXPECT_EQ(outcome.output.find(zero), std::string::npos) << job;
  }
}

TEST(Simulate, SaysOnWhichSideThePlayBegins) {
  const TemporaryFolder folder;
  const std::string table = (folder / "motion.csv").string();
  const auto said_of = [&table](const std::string& options) {
    EXPECT_EQ(run_holdfast("simulate --duration 0.01 --output '" + table + "'" + options).exit_code,
              0);
    return read_text(table + "-metadata.json").find("\"play_at_start\"") != std::string::npos;
  };
  EXPECT_TRUE(said_of(" --set backlash.law=play"));
  EXPECT_TRUE(said_of(" --switching exact"));
  EXPECT_FALSE(said_of(" --set backlash.law=dead_zone"));
  EXPECT_FALSE(said_of(" --set backlash.width=0"));
}

TEST(Spectrum, OfAMotionThatHasNotSettledSaysSo) {
  const std::string settled = "the motion has not settled";
  EXPECT_EQ(run_holdfast("spectrum").errors.find(settled), std::string::npos);
  expect_said(
      "spectrum --duration 3 --discard 0 --set excitation.amplitude=0 --set initial.z1=0.001 "
      "--set backlash.width=0",
      {settled});
}

TEST(Jobs, RefuseAnOutputWhoseNamePromisesAnotherFormat) {
  const TemporaryFolder folder;
  for (const char* name : {"chart.png", "chart.svg", "chart.pdf", "table.xlsx", "table.txt"}) {
    const std::string file = (folder / name).string();
    expect_refused("margins --output '" + file + "'", {".csv"});
    EXPECT_FALSE(std::filesystem::exists(file)) << name;
  }
  expect_refused("simulate --duration 0.01 --output " + (folder / "a.jpg").string(),
                 {".csv", ".svg, .png or .pdf", ".jpg"});
  const std::string file = (folder / "motion").string();
  EXPECT_EQ(run_holdfast("simulate --duration 0.01 --output '" + file + "'").exit_code, 0);
  EXPECT_TRUE(std::filesystem::exists(file));
}

TEST(Jobs, DoNotWriteGigabytesOfTextUnasked) {
  for (const char* job : {"stability", "response", "stability --continuous"}) {
    expect_refused(std::string(job) + " --p -600:0:100001 --d -20:0:100000",
                   {"10000100000 cells", "--yes"});
  }
}

}  // namespace
}  // namespace holdfast::tests
