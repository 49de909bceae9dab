// Spans of lines and stays from the command line: devices, the wind, life, and what is refused.

#include <cmath>
#include <fstream>
#include <map>
#include <regex>

#include "cli/program.hpp"

namespace holdfast::tests {
namespace {

using program::CsvTable;

const std::string drake =
    " --quiet --set conductor.name=Drake --set conductor.span=300 --set conductor.tension=28020"
    " --set conductor.damping_ratio=0.0002";
const std::string damper =
    " --set device.1.kind=stockbridge --set device.1.position=1.5 --set device.1.mass=4"
    " --set device.1.frequencies=[9.0,24.0] --set device.1.damping_ratios=[0.15,0.2]"
    " --set device.1.clamp_mass=0.4";
const std::string absorber =
    " --set absorber.position=1.5 --set plant.model=string --set plant.absorber_mass=5"
    " --set plant.absorber_stiffness=78956.8 --set plant.absorber_damping=125.66"
    " --set control.proportional_gain=0";
const std::string bare_stay =
    " --quiet --set conductor.mass_per_length=60 --set conductor.span=300 --set "
    "conductor.tension=3.5e6"
    " --set conductor.area=0.008 --set conductor.youngs_modulus=195e9 --set conductor.diameter=0.16"
    " --set conductor.damping_ratio=0.001 --set device.1.kind=dashpot --set device.1.position=6";

TEST(Span, AbsorptionOfTheBestDashpotIsTheTangent) {
  // Drake at 21.3 Hz, 1.5 m: Z_c/sin ka.
  const double impedance = std::sqrt(28020.0 * 1.628), phase = 1.5302;
  const CsvTable table =
      table_of("absorption --frequency 21.3:21.3:1" + drake +
               " --set device.1.kind=dashpot --set device.1.position=1.5 --set device.1.damping=" +
               std::to_string(impedance / std::sin(phase)));
  const double ratio = table.number(0, "inverse_standing_wave_ratio");
  EXPECT_NEAR(ratio, std::tan(phase / 2.0), 1e-3);
  const double reflection = table.number(0, "reflection");
  EXPECT_NEAR(table.number(0, "absorbed_fraction"), 1.0 - reflection * reflection, 1e-12);
  EXPECT_NEAR(table.number(0, "impedance_real_N_s_per_m"), impedance / std::sin(phase), 0.1);
}

TEST(Span, ADampersAmplitudesAreSmaller) {
  const CsvTable table = table_of("aeolian --frequency 8:40:9" + drake + damper);
  ASSERT_EQ(table.rows(), 9U * 6U);
  double bare = 0.0, damped = 0.0;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    EXPECT_NEAR(table.number(row, "wind_speed_m_per_s"),
                table.number(row, "frequency_Hz") * 0.02814 / 0.2, 1e-3);
    bare += table.number(row, "amplitude_bare_m");
    damped += table.number(row, "amplitude_m");
    EXPECT_LE(table.number(row, "amplitude_m"), table.number(row, "amplitude_bare_m"));
  }
  EXPECT_LT(damped, 0.3 * bare);
}

// SPAN: balance y/d of bare Drake at 20 Hz, Diana–Falco with Kraus–Hagedorn.
TEST(Span, BareAmplitudesAreThoseOfTheBalance) {
  const CsvTable table = table_of("aeolian --frequency 20:20:1" + drake);
  std::map<std::string, double> found;
  for (std::size_t row = 0; row < table.rows(); ++row)
    found[table.text(row, "wind_law") + "+" + table.text(row, "damping_law")] =
        table.number(row, "amplitude_bare_m") / 0.02814;
  EXPECT_NEAR(found["diana_falco+kraus_hagedorn"], 0.152, 2e-3);
  EXPECT_NEAR(found["diana_falco+noiseux"], 0.054, 1e-3);
  EXPECT_NEAR(found["brika_laneville+seppa"], 0.029, 1e-3);
}

const std::string ground_wire =
    " --set 'conductor.name=OPGW 24B1-105' --set conductor.span=300 --set conductor.tension=12000"
    " --set conductor.damping_ratio=0.0003 --set plant.model=string --set plant.absorber_mass=0"
    " --set control.proportional_gain=0 --set control.differential_gain=0";

TEST(Span, LawsOfOtherConductorsAreSaidToBe) {
  const auto said = [](const std::string& arguments) {
    return run_holdfast(arguments).errors.find("measured only on steel-cored aluminium (ACSR)") !=
           std::string::npos;
  };
  const std::string unnamed =
      " --set conductor.mass_per_length=0.44 --set conductor.diameter=0.0142 --set "
      "conductor.rated_strength=63600 --set conductor.tension=12000 --set conductor.span=300"
      " --set conductor.area=1.035e-4 --set conductor.youngs_modulus=1e11";
  const std::string site = " --set site.weibull_scale=4";
  const std::string line =
      " --set conductor.name=Drake --set conductor.span=300 --set conductor.tension=28020";
  EXPECT_TRUE(said("aeolian --frequency 20:20:1" + ground_wire));
  EXPECT_TRUE(said("fatigue" + ground_wire + site));
  EXPECT_TRUE(said("aeolian --frequency 20:20:1" + unnamed));
  EXPECT_FALSE(said("aeolian --frequency 20:20:1" + line));
  EXPECT_FALSE(said("fatigue" + line + site));
}

/// A wire whose laws agree, with a dashpot that does next to nothing: nothing has two ends.
TEST(Span, ARangeOfOneNumberIsToldAsOne) {
  const TemporaryFolder folder;
  const std::string page = (folder / "page").string();
  printed_by(
      "report --quiet --for span --output '" + page + "'" + ground_wire +
      " --set site.weibull_scale=4 --set device.1.kind=dashpot --set device.1.position=0.02 --set "
      "device.1.damping=1");
  const std::string text = read_text(page + "/report.html");
  const std::string answers = text.substr(0, text.find("Is the absorber"));
  expect_holds(answers,
               {"by every law", "first 20 modes have a damping ratio of 0.03 % each", "ACSR"});
  const std::regex twice(R"(([0-9][0-9.]*)( [%A-Za-z/]+)?( \([^)]*\))? (to|and) \1\b)");
  std::smatch found;
  EXPECT_FALSE(std::regex_search(answers, found, twice)) << found.str();
}

TEST(Span, TurbulenceAndDampersGiveYears) {
  const std::string site = " --set site.weibull_scale=5";
  const CsvTable laminar = table_of("fatigue" + drake + damper + site);
  const CsvTable turbulent =
      table_of("fatigue" + drake + damper + site + " --set site.turbulence_intensity=0.1");
  for (const char* column : {"value", "lowest", "highest"}) {
    EXPECT_LT(value_of(laminar, "life_bare", column), value_of(laminar, "life", column));
    EXPECT_LT(value_of(laminar, "life", column), value_of(turbulent, "life", column));
  }
  EXPECT_NEAR(value_of(laminar, "life", "lowest") * value_of(laminar, "damage_per_year", "highest"),
              1.0, 1e-9);
}

// Rows of a site's table at the ends of what counts.
TEST(Span, WindsOfOneAndEightMetresCount) {
  const std::string hawk =
      "fatigue --quiet --set conductor.name=Hawk --set conductor.span=300"
      " --set conductor.tension=17000 --set conductor.damping_ratio=0.001"
      " --set site.speeds=[1,4,8] --set site.hours=[500,500,500]";
  EXPECT_NEAR(value_of(table_of(hawk), "cycles_per_year"), 3600.0 * 500.0 * 13.0 * 0.2 / 0.0217932,
              1e-3 * 3600.0 * 500.0 * 13.0 * 9.0);
}

TEST(Span, ASpringThatPushesAwayIsNamed) {
  expect_said(
      "aeolian --frequency 20:20:1 --set conductor.name=Drake --set conductor.span=300"
      " --set conductor.tension=28020 --set device.1.kind=stiffness --set device.1.position=1.5"
      " --set device.1.stiffness=-30000",
      {"pushes the conductor away"});
}

TEST(Span, AStayWithADashpotIsDampedAsKrenkSays) {
  // κ = 1 for mode 1: c = Z_c L/(π a).
  const double impedance = std::sqrt(3.5e6 * 60.0);
  const double best = impedance * 300.0 / (3.14159265358979 * 6.0);
  const CsvTable table = table_of("modal-damping --count 4" + bare_stay +
                                  " --set device.1.damping=" + std::to_string(best));
  EXPECT_NEAR(table.number(0, "damping_ratio") - 0.001, 0.0102114686718, 3e-5);
  EXPECT_NEAR(table.number(0, "damping_ratio_asymptotic") - 0.001, 0.01, 1e-6);
}

// The spillover of the computer's drive into low modes is what a damper elsewhere takes.
TEST(Span, ADamperWidensTheStableGains) {
  const std::string loop = "boundary --stable-interval" + drake + absorber;
  const std::string other_end = damper + " --set device.1.position=298.5";
  const double alone = table_of(loop).number(0, "lower");
  EXPECT_LT(table_of(loop + other_end).number(0, "lower"), 3.0 * alone);
  // As it becomes lighter it is the absorber alone again.
  const std::string nothing = other_end + " --set device.1.mass=1e-6 --set device.1.clamp_mass=0";
  EXPECT_NEAR(table_of(loop + nothing).number(0, "lower") / alone, 1.0, 1e-5);
}

TEST(Span, WhatIsMissingIsNamed) {
  expect_refused("aeolian", {"conductor.diameter", "conductor.name"});
  expect_refused("fatigue" + drake, {"[site]", "weibull_scale"});
  expect_refused("absorption" + drake, {"no device"});
  expect_refused("absorption --end right" + drake + damper, {"--end right"});
  expect_refused("aeolian --frequency 0:10:3" + drake, {"--frequency", "greater than 0"});
}

TEST(Span, MotionsWithoutDevicesRefuseThem) {
  for (const std::string job : {"simulate", "orbit"})
    expect_refused(job + drake + absorber + damper, {"[[device]]", "absorption"});
  expect_refused("answers" + drake + absorber + damper, {"[[device]]", "report --for span"});
  expect_refused("boundary" + drake + damper + " --set absorber.position=1.5",
                 {"two_masses", "plant.model=string"});
  expect_refused(
      "boundary --stable-interval" + drake + absorber + damper + " --set plant.model=cable",
      {"plant.model", "string"});
}

TEST(Span, AMeasuredDeviceIsAskedOnlyWhereItWasMeasured) {
  const TemporaryFolder folder;
  const auto file = folder / "z.csv";
  std::ofstream(file)
      << "frequency_Hz,magnitude_N_s_per_m,phase_deg\n5,100,80\n20,300,10\n50,90,-60\n";
  const std::string measured = drake +
                               " --set device.1.kind=measured --set device.1.position=1.5"
                               " --set device.1.file=" +
                               file.string();
  const CsvTable table = table_of("absorption --frequency 5:50:10" + measured);
  EXPECT_NEAR(table.number(0, "impedance_real_N_s_per_m"), 100.0 * std::cos(80.0 * 0.0174532925199),
              1e-6);
  expect_refused("absorption --frequency 3:50:10" + measured, {"z.csv", "5 to 50 Hz"});
  expect_refused("aeolian --frequency 5:60:10" + measured, {"z.csv", "5 to 50 Hz"});
  expect_refused("boundary --stable-interval" + measured + absorber, {"measured", "stockbridge"});
}

}  // namespace
}  // namespace holdfast::tests
