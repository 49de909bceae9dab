#include <cmath>

#include "case/case_keys.hpp"
#include "case/model/cable_of_case.hpp"
#include "case/model/modal/conductor_modes.hpp"
#include "case/needed.hpp"
#include "case/plausibility/doubts.hpp"
#include "case/units.hpp"
#include "program/case/case_text.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

/// A ground wire, of which a user of a taut string knows this.
const std::string ground_wire = "[conductor]\nmass_per_length = 0.4\nspan = 300\ntension = 6000\n";
const std::string whole_plant =
    "[plant]\nconductor_mass = 2\nconductor_stiffness = 19000\nconductor_damping = 0.1\n"
    "absorber_mass = 5\nabsorber_stiffness = 12000\nabsorber_damping = 30\n";

TEST(OwnCase, HasNothingOfTheBuiltInOne) {
  for (const std::string& text :
       {ground_wire, whole_plant, std::string("[conductor]\nname = \"Drake\"\n"),
        std::string("[conductor]\nsag = 2\n"), std::string("[conductor]\ntension = \"3 kN\"\n")}) {
    const Case own = from_text(text);
    EXPECT_TRUE(own.stands_alone) << text;
    EXPECT_EQ(own.control.proportional_gain, 0.0);
    EXPECT_EQ(own.control.differential_gain, 0.0);
    EXPECT_EQ(own.backlash.width, 0.0);
    EXPECT_EQ(own.excitation.amplitude, 0.0);
    EXPECT_EQ(own.conductor.gravity, 9.81);
    for (const char* key : {"conductor.damping_ratio", "absorber.position",
                            "control.sampling_period", "excitation.frequency"})
      EXPECT_TRUE(is_absent(own, *find_case_key(key))) << key << text;
  }
  EXPECT_FALSE(has_active_absorber(from_text(ground_wire + "[control]\nproportional_gain = -5\n")));
  EXPECT_FALSE(has_active_absorber(from_text(ground_wire)));
  EXPECT_TRUE(has_active_absorber(from_text(ground_wire + "[absorber]\nmass = 2\n")));
}

TEST(OwnCase, IsNoneWhereTheFileDescribesNeitherCableNorPlant) {
  for (const char* text :
       {"", "[absorber]\nmass = 0.1\n", "[plant]\nabsorber_damping = 5\n",
        "[conductor]\ndamping_ratio = 0.03\n", "[conductor]\nname = \"\"\ntension = \"sag\"\n"}) {
    const Case the_case = from_text(text, {"conductor.span=7"});
    EXPECT_FALSE(the_case.stands_alone) << text;
    EXPECT_EQ(the_case.control.proportional_gain, -557.0) << text;
    EXPECT_EQ(the_case.conductor.mass_per_length, 0.043) << text;
  }
}

TEST(OwnCase, IsTheSameWhenItIsWrittenAndRead) {
  for (const std::string& text :
       {ground_wire, whole_plant,
        ground_wire + "[absorber]\nmass = 2\n[control]\nsampling_period = 0.002\n"}) {
    const std::string written = case_to_toml(from_text(text));
    EXPECT_EQ(written.find("nan"), std::string::npos) << written;
    EXPECT_TRUE(from_text(written).stands_alone);
    EXPECT_EQ(case_to_toml(from_text(written)), written);
  }
}

TEST(OwnCase, OfATautStringIsRefusedByNoAreaThatNobodyGave) {
  const TautString<double> string = string_of(from_text(ground_wire));
  EXPECT_DOUBLE_EQ(string.wave_speed(), std::sqrt(6000 / 0.4));
  const std::string asked = message_of<MissingKeys>([] { conductor_of(from_text(ground_wire)); });
  EXPECT_TRUE(holds(asked, "conductor.area (m2), conductor.youngs_modulus (Pa)")) << asked;
  const std::string damping =
      message_of<MissingKeys>([] { bare_damping_of(from_text(ground_wire), 1.0); });
  EXPECT_TRUE(holds(damping, "conductor.damping_ratio (a number)")) << damping;
  const std::string sag =
      message_of<MissingKeys>([] { string_of(from_text("[conductor]\nspan = 300\n")); });
  EXPECT_TRUE(holds(sag, "conductor.sag (m) or conductor.tension (N)")) << sag;
}

TEST(OwnCase, ByOptionsAloneIsNotRefusedByWhatNobodyGave) {
  const std::vector<std::string> stay = {"conductor.mass_per_length=60", "conductor.span=180",
                                         "conductor.tension=3e6"};
  const Case the_case = load_case(std::nullopt, stay);
  EXPECT_EQ(the_case.conductor.tension, 3e6);
  EXPECT_EQ(doubts_about(the_case, quantities_of_case()), std::vector<std::string>{});
  EXPECT_THROW(load_case(std::nullopt, {"conductor.mass_per_length=60", "conductor.span=180",
                                        "conductor.tension=3e6", "conductor.area=20",
                                        "conductor.youngs_modulus=2e11"}),
               WrongInput)
      << "3 kg/m3, of given values";
}

// The factors by definition: 1 lb = 0.45359237 kg, 1 ft = 0.3048 m, 1 in = 0.0254 m, g = 9.80665
// m/s2, 1 kcmil = pi/4 (0.0254 m)^2 / 1000.
TEST(Units, AreReadOfEveryQuantity) {
  const double kcmil = 3.14159265358979323846 / 4.0 * 0.0254 * 0.0254 * 1e-3;
  const double pound_force = 0.45359237 * 9.80665;
  struct Written {
    const char *text, *own;
    double value;
  };
  for (const Written& one :
       std::vector<Written>{{"28.2 kN", "N", 28200.0},
                            {"1.23 lb/ft", "kg/m", 1.23 * 0.45359237 / 0.3048},
                            {"795 kcmil", "m2", 795 * kcmil},
                            {"-20 degF", "degC", -260.0 / 9.0},
                            {"-20 °F", "degC", -260.0 / 9.0},
                            {"5.5 mm²", "m2", 5.5e-6},
                            {"5.5mm^2", "m2", 5.5e-6},
                            {"10.1 Mpsi", "Pa", 10.1e6 * pound_force / 6.4516e-4},
                            {"31500 lbf", "N", 31500 * pound_force},
                            {"1.108 in", "m", 1.108 * 0.0254},
                            {"984 ft", "m", 984 * 0.3048},
                            {"2 %", "", 0.02},
                            {"5 µs", "s", 5e-6},
                            {"36 km/h", "m/s", 10.0},
                            {"3 N·s/m", "N s/m", 3.0},
                            {"1.2e3 N/m", "N/m", 1200.0},
                            {"180 deg", "rad", 3.14159265358979323846}}) {
    const auto written = written_quantity(one.text);
    ASSERT_TRUE(written) << one.text;
    const auto value = in_own_unit(*written, one.own);
    ASSERT_TRUE(value) << one.text << " as " << written->unit;
    EXPECT_NEAR(*value, one.value, 1e-14 * std::abs(one.value)) << one.text;
  }
  EXPECT_EQ(in_own_unit(*written_quantity("5.5 mm2"), "m2"), 5.5e-6) << "to the last digit";
  for (const char* text : {"", "kN", "28.2", "fast", "1e999999 ergs of it and more and yet more"})
    EXPECT_FALSE(written_quantity(text) && in_own_unit(*written_quantity(text), "N")) << text;
}

TEST(Units, AreThoseOfEveryKeyOfANumber) {
  const Case builtin = load_case(std::nullopt, {});
  int keys = 0;
  for (const CaseKey& key : case_keys()) {
    if (!key.is_number() || key.unit.empty() || key.table() == "wind") continue;
    const double value = case_value(builtin, key.name);
    if (!std::isfinite(value)) continue;
    ++keys;
    const std::string given = key.name + "=" + format_number(value) + " ";
    EXPECT_EQ(case_value(load_case(std::nullopt, {given + key.unit}), key.name), value) << given;
    const std::string said =
        message_of<WrongInput>([&] { load_case(std::nullopt, {given + "furlong"}); });
    EXPECT_TRUE(holds(said, "furlong is not a unit of this key: use " + units_in_words(key.unit)))
        << said;
  }
  EXPECT_GE(keys, 40);
}

TEST(Units, StandInFilesListsAndDevices) {
  const Case the_case = from_text(
      ground_wire + "diameter = \"12.7 mm\"\nrayleigh_frequencies = [\"120 1/min\", 7]\n" +
      "[site]\nspeeds = [\"18 km/h\", 7]\nhours = [\"10 d\", 20]\n" +
      "[excitation]\nharmonics = [[\"2 kN\", 3, \"90 deg\"]]\n" +
      "[[device]]\nkind = \"dashpot\"\nposition = \"10 ft\"\ndamping = \"1.2 kN s/m\"\n");
  EXPECT_EQ(the_case.conductor.diameter, 0.0127);
  EXPECT_EQ(the_case.conductor.rayleigh_frequencies[0], 2.0);
  EXPECT_DOUBLE_EQ(the_case.site.speeds[0], 5.0);
  EXPECT_EQ(the_case.site.hours[0], 240.0);
  EXPECT_EQ(the_case.excitation.harmonics[0][0], 2000.0);
  EXPECT_DOUBLE_EQ(the_case.devices[0].position, 3.048);
  EXPECT_EQ(the_case.devices[0].damping, 1200.0);
  EXPECT_TRUE(holds(refusal("[conductor]\nspan = \"300 kg\"\n"),
                    "kg is not a unit of this key: use m, mm"));
  EXPECT_TRUE(holds(refusal("[backlash]\nwidth = \"-2 mm\"\n"), "at least 0 m"));
}

TEST(Contradictions, OfANamedConductorAreSaidWithBothValuesTheirRatioAndTheUnit) {
  const std::string drake = "[conductor]\nname = \"Drake\"\nspan = 300\ntension = 28020\n";
  const auto said = [&](const std::string& more) {
    return contradicted_name_text(from_text(drake + more));
  };
  EXPECT_EQ(said(""), "");
  EXPECT_EQ(said("mass_per_length = 1.6\ndiameter = \"1.108 in\"\n"), "");
  struct Mistake {
    const char *line, *unit;
  };
  // Of Drake: 1.094 lb/ft, 1.108 in, 0.7264 in2, 31 500 lbf, 10.1e6 psi.
  for (const Mistake& one :
       std::vector<Mistake>{{"mass_per_length = 1.094", "lb/ft, that is 1.628"},

                            {"rated_strength = 31500", "lbf, that is 1.401"},
                            {"diameter = 0.0281\nrated_strength = 31500", "lbf"}}) {
    const std::string text = said(std::string(one.line) + "\n");
    EXPECT_EQ(text.rfind("case.toml:2: ", 0), 0u) << text;
    EXPECT_TRUE(holds(text, std::string("did you mean ") + one.unit)) << text;
  }
  const std::string twice = said("mass_per_length = 3.256\n");
  EXPECT_TRUE(holds(twice, "conductor.mass_per_length 3.256 instead of 1.628 kg/m, ratio 2"))
      << twice;
  EXPECT_FALSE(holds(twice, "did you mean")) << twice;
}

/// The suggestion of a unit, and none other, makes the values consistent.
TEST(Contradictions, SuggestTheUnitThatTheOtherValuesSupport) {
  const std::string drake =
      "[conductor]\nmass_per_length = 1.628\nspan = 300\ntension = 28020\ndiameter = 0.028143\n";
  const auto said = [&](const std::string& more) { return refusal(drake + more); };
  EXPECT_TRUE(holds(said("area = 468.6e-6\nyoungs_modulus = 10.1e3\n"), "did you mean ksi, ") ||
              holds(said("area = 468.6e-6\nyoungs_modulus = 10.1e3\n"), "did you mean MPa"));
  const std::string modulus = said("area = 468.6e-6\nyoungs_modulus = 11.2e6\n");
  const std::string kcmil = said("area = 795\nyoungs_modulus = 69.6e9\n");
  EXPECT_TRUE(holds(kcmil, "did you mean kcmil, that is 0.00040283 m2?")) << kcmil;
  EXPECT_TRUE(holds(said("area = 468.6\nyoungs_modulus = 69.6e9\n"),
                    "did you mean mm2, that is 0.0004686 m2?"));
  EXPECT_TRUE(modulus.empty() || holds(modulus, "did you mean psi, that is 7.722")) << modulus;
}

}  // namespace
}  // namespace holdfast::program
