// The hanging cable under the computer's control (plant.model = "cable"): against finite elements
// of others, against the string where the sag is small, against itself with other modes, and what
// is refused.

#include <array>

#include "holdfast/control/gains.hpp"
#include "holdfast/core/types.hpp"

#include "cli/program.hpp"

namespace holdfast::tests {
namespace {

using program::CsvTable;

const std::string on_cable = " --quiet --set plant.model=cable";

double lowest_stable_gain(const std::string& settings) {
  return table_of("boundary --stable-interval --p -557" + on_cable + settings).number(0, "lower");
}

/// Lowest stable D of the paper's cable. Each number is from one of two other finite element
/// programs, lumped with 600 elements or graded towards the clamp, which agree to 4 %; at 1 ms and
/// from 20 g on the second alone.
TEST(Cable, LowestStableGainIsThatOfOtherElements) {
  struct Known {
    double period, clamp, gain;
  };
  for (const Known& known :
       {Known{1e-3, 0.0, -6.55}, Known{1e-3, 0.005, -12.6}, Known{1e-3, 0.01, -22.4},
        Known{1e-3, 0.02, -34.6}, Known{3e-3, 0.0, -6.56}, Known{3e-3, 0.005, -6.96},
        Known{3e-3, 0.01, -9.16}, Known{3e-3, 0.02, -15.2}, Known{3e-3, 0.04, -28.5},
        Known{1e-2, 0.0, -5.10}, Known{1e-2, 0.01, -4.58}, Known{1e-2, 0.02, -5.6},
        Known{1e-2, 0.0767, -16.5}}) {
    const double found =
        lowest_stable_gain(" --set control.sampling_period=" + std::to_string(known.period) +
                           " --set absorber.clamp_mass=" + std::to_string(known.clamp));
    EXPECT_NEAR(found, known.gain, 0.03 * std::abs(known.gain))
        << known.period << ' ' << known.clamp;
  }
}

/// The same of an absorber whose mass goes sideways with the cable.
TEST(Cable, AnAbsorberThatGoesSidewaysHasOtherLimits) {
  const auto limit = [](double period, double clamp) {
    return lowest_stable_gain(
        " --set absorber.motion=plane --set control.sampling_period=" + std::to_string(period) +
        " --set absorber.clamp_mass=" + std::to_string(clamp));
  };
  EXPECT_NEAR(limit(1e-3, 0.005), -15.3, 0.03 * 15.3);
  EXPECT_NEAR(limit(1e-3, 0.01), -24.0, 0.03 * 24.0);
  EXPECT_NEAR(limit(1e-2, 0.0), -4.3, 0.03 * 4.3);
  EXPECT_NEAR(limit(1e-2, 0.01), -5.3, 0.03 * 5.3);
}

/// Steady amplitude (mm) under 0.5 N, 10 g moving with the clamp: without control and at three D;
/// at 5 Hz the last two are unstable, which those elements say too.
TEST(Cable, AmplitudesAreThoseOfOtherElements) {
  struct Known {
    double frequency;
    std::array<double, 4> amplitude;
  };
  for (const Known& known :
       {Known{5.0, {1.782, 1.186, 0.907, 0.699}}, Known{10.0, {0.273, 0.204, 0.198, 0.188}},
        Known{16.0, {0.780, 0.227, 0.209, 0.185}}, Known{30.0, {0.500, 0.085, 0.081, 0.075}}}) {
    const std::string f = std::to_string(known.frequency);
    const double tuned = 74.4 - 0.16 * std::pow(2.0 * pi<double> * known.frequency, 2);
    const std::array<PdGains<double>, 4> gains = {
        PdGains<double>{0.0, 0.0}, {tuned, -4.0}, {tuned, -8.0}, {tuned, -13.0}};
    for (std::size_t k = 0; k < (known.frequency < 6.0 ? 2 : gains.size()); ++k) {
      const auto once = [](double gain) {
        const std::string text = std::to_string(gain);
        return text + ":" + text + ":1";
      };
      const CsvTable cell = table_of(
          "response --p " + once(gains[k].proportional) + " --d " + once(gains[k].differential) +
          on_cable + " --set absorber.clamp_mass=0.01 --set excitation.frequency=" + f);
      EXPECT_NEAR(1e3 * cell.number(0, "amplitude_m"), known.amplitude[k],
                  0.03 * known.amplitude[k])
          << f << " Hz, D " << gains[k].differential;
    }
  }
}

/// A tight, nearly inextensible conductor hangs as a string, damped alike.
TEST(Cable, OfNextToNoSagIsAString) {
  const std::string settings =
      " --quiet --set conductor.sag=0.002 --set conductor.youngs_modulus=1e11"
      " --set absorber.mass=1e-3 --set plant.absorber_mass=1e-3 --set plant.absorber_stiffness=2"
      " --set plant.absorber_damping=0.3 --set control.sampling_period=0.002"
      " --set conductor.damping=ratio --set plant.model=";
  const auto interval = [&](const char* model) {
    return table_of("boundary --stable-interval --p 0" + settings + model);
  };
  const CsvTable cable = interval("cable"), string = interval("string");
  // The last one holds D = 0; below it others are as narrow as an echo of the nearer end.
  for (const char* end : {"lower", "upper"}) {
    const double expected = string.number(string.rows() - 1, end);
    EXPECT_NEAR(cable.number(cable.rows() - 1, end), expected, 0.02 * std::abs(expected)) << end;
  }
}

TEST(Cable, AnswersAlikeByHalfItsModes) {
  const auto asked = run_holdfast("boundary --stable-interval --p -557 --set plant.model=cable");
  EXPECT_EQ(asked.errors.find("warning"), std::string::npos) << asked.errors;
  expect_said("boundary --stable-interval --p -557 --set plant.model=cable --set plant.modes=20",
              {"with all modes the interval is"});
}

TEST(Cable, WrongInputIsNamed) {
  const std::string ask = "boundary --stable-interval --set plant.model=cable --set ";
  expect_refused(ask + "plant.modes=301", {"plant.modes", "at most 300"});
  expect_refused(ask + "conductor.rayleigh_frequencies=7", {"rayleigh_frequencies", "[lower"});
  expect_refused(ask + "'conductor.rayleigh_frequencies=[7,2]'", {"[lower, higher]"});
  expect_refused(ask + "'conductor.rayleigh_frequencies=[0,2]'", {"greater than 0"});
  expect_refused(ask + "conductor.damping=rayleihg", {"rayleigh"});
  expect_refused(ask + "absorber.motion=sideways", {"vertical", "plane"});
  const auto warned = [](const std::string& settings, const std::string& words) {
    expect_said("margins " + settings, {words});
  };
  warned("--set absorber.motion=plane", "absorber.motion: not used by the two masses");
  warned("--set conductor.damping=rayleigh", "conductor.damping: not used by the two masses");
  expect_said(ask + "conductor.bending_stiffness=1e-4 --p -557", {"not used by the cable"});
}

TEST(Conductors, AreListedWithTheirColumns) {
  EXPECT_EQ(header_of("conductors"),
            "name,kind,mass_per_length_kg_per_m,diameter_m,area_m2,rated_strength_N,"
            "youngs_modulus_Pa,source");
  const auto all = table_of("conductors"), drake = table_of("conductors --find drake");
  EXPECT_GE(all.rows(), 60U);
  ASSERT_EQ(drake.rows(), 1U);
  EXPECT_EQ(drake.text(0, "name"), "Drake");
  EXPECT_NEAR(drake.number(0, "mass_per_length_kg_per_m"), 1.628, 0.002);
}

TEST(Conductors, AreFoundByEveryWord) {
  const auto found = table_of("conductors --find 'acsr eskom'");
  EXPECT_GT(found.rows(), 3U);
  for (std::size_t row = 0; row < found.rows(); ++row) EXPECT_EQ(found.text(row, "kind"), "ACSR");
  expect_refused("conductors --find 'drake hawk'", {"drake hawk"}, 1);
  expect_refused("conductors --find " + std::string(3000, 'x'), {"xxx...: no conductor"}, 1);
  expect_refused("conductors drake", {"did you mean --find drake?"});
}

TEST(Conductors, ANameInACaseShowsWhereItsValuesComeFrom) {
  const std::string drake =
      "--set conductor.name=drake --set conductor.span=300 --set conductor.tension=28000 "
      "--set plant.model=string ";
  const Outcome outcome = run_holdfast("case --quiet " + drake +
                                       "--set conductor.area=4.7e-4 --set wind.speed=3 "
                                       "--set wind.effective_length=3");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  expect_holds(
      outcome.output,
      {"conductor.name,\"\"\"Drake\"\"\"", "conductor.mass_per_length,1.628,kg/m,conductor library",
       "conductor.area,0.00047,m2,--set", "conductor.diameter,0.028143,m,conductor library",
       "wind.diameter,0.028143,m,computed from the conductor"});
}

TEST(Conductors, ANamedOneIsNotSaidToHaveABendingStiffnessInVain) {
  const Outcome outcome = run_holdfast("margins --set conductor.name=Drake");
  EXPECT_EQ(outcome.errors.find("bending_stiffness"), std::string::npos) << outcome.errors;
  expect_said("margins --set conductor.bending_stiffness=1e-4", {"bending_stiffness"});
}

TEST(Conductors, AnUnknownNameNamesTheNearestAndTheJob) {
  expect_refused("margins --set conductor.name=Drak", {"\"Drake\"", "holdfast conductors"});
  expect_refused("margins --set conductor.name=", {"conductor.name"});
  expect_refused("sweep --axis conductor.name=0:1:2", {"conductor.name"});
}

}  // namespace
}  // namespace holdfast::tests
