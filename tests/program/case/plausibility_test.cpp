#include "case/case_file.hpp"
#include "case/model/resolved_plant.hpp"
#include "case/plausibility/doubts.hpp"
#include "io/file/whole_file.hpp"
#include "process/errors.hpp"
#include "program/case/case_text.hpp"

namespace holdfast::program {
namespace {

using Words = std::vector<std::string>;

/// ACSR Cardinal on 400 m.
constexpr const char* cardinal =
    "[conductor]\nmass_per_length = 1.829\nspan = 400\nsag = 11.92\narea = 546e-6\n"
    "youngs_modulus = 65e9\ndamping_ratio = 3e-4\n[absorber]\nmass = 5\nposition = 1.6\n"
    "[wind]\nspeed = 3\ndiameter = 0.03038\neffective_length = 3.2\n"
    "[reduction]\nfirst_frequency = 6\nsecond_frequency = 19.75\n[plant]\nabsorber_damping = 30\n"
    "[control]\nproportional_gain = \"tuned\"\ndifferential_gain = -60\nsampling_period = 0.001\n"
    "processing_delay = 0.0002\n[backlash]\nwidth = 2e-5\n";

/// A stay of 100 m, grouted in a tube of 160 mm.
constexpr const char* stay =
    "[conductor]\nmass_per_length = 60\nspan = 100\nsag = 0.184\narea = 6000e-6\n"
    "youngs_modulus = 195e9\ndamping_ratio = 0.001\n[absorber]\nmass = 30\nposition = 3\n"
    "[wind]\nspeed = 2\ndiameter = 0.16\neffective_length = 50\n[plant]\nabsorber_damping = 500\n"
    "[control]\nproportional_gain = \"tuned\"\ndifferential_gain = -1000\n"
    "sampling_period = 0.002\n[backlash]\nwidth = 1e-4\n";

/// A crossing of a river on 2000 m.
constexpr const char* crossing =
    "[conductor]\nmass_per_length = 2.5\nspan = 2000\nsag = 150\narea = 700e-6\n"
    "youngs_modulus = 100e9\ndamping_ratio = 2e-4\n[absorber]\nmass = 6\nposition = 2\n"
    "[wind]\nspeed = 4\ndiameter = 0.035\neffective_length = 4\n[plant]\nabsorber_damping = 50\n"
    "[reduction]\nfirst_frequency = 8\nsecond_frequency = 24\n"
    "[control]\nproportional_gain = \"tuned\"\ndifferential_gain = -60\n";

/// A steel wire of 1 mm on 1 m in a laboratory, under 20 N.
constexpr const char* wire =
    "[conductor]\nmass_per_length = 0.00617\nspan = 1\nsag = 3.78e-4\narea = 7.85e-7\n"
    "youngs_modulus = 2e11\ndamping_ratio = 0.001\n[absorber]\nmass = 0.0005\nposition = 0.1\n"
    "[plant]\nabsorber_damping = 0.1\n[reduction]\nstiffness_reading = \"tangent\"\n"
    "[excitation]\namplitude = 0.05\nfrequency = 90\n"
    "[control]\nproportional_gain = \"tuned\"\ndifferential_gain = -0.5\n";

/// A guy wire of a mast, seven wires of steel on 60 m.
constexpr const char* guy =
    "[conductor]\nmass_per_length = 0.407\nspan = 60\nsag = 0.3\narea = 51e-6\n"
    "youngs_modulus = 165e9\ndamping_ratio = 0.001\n[absorber]\nmass = 0.5\nposition = 0.8\n"
    "[wind]\nspeed = 5\ndiameter = 0.0095\neffective_length = 1\n[plant]\nabsorber_damping = 5\n"
    "[control]\nproportional_gain = \"tuned\"\ndifferential_gain = -5\n";

/// All that is doubted, the plant being reduced where it can be.
Words doubts_of(Case the_case) {
  Words doubts = doubts_about(the_case, quantities_of_case());
  try {
    settle_plant(the_case);
  } catch (const NoAnswer&) {
    return doubts;
  }
  for (const std::string& text : doubts_about(the_case, quantities_of_plant()))
    doubts.push_back(text);
  doubts.push_back(contradicted_conductor_text(the_case));
  if (doubts.back().empty()) doubts.pop_back();
  return doubts;
}

/// What is said of a case: why it is refused, or every doubt about it.
std::string said_of(const std::string& text, const Words& overrides) {
  try {
    std::string all;
    for (const std::string& doubt : doubts_of(load_case_text(text, "case.toml", overrides)))
      all += doubt + "\n";
    return all;
  } catch (const WrongInput& refusal) {
    return refusal.what();
  }
}

TEST(Plausibility, DoubtsNoCableThatThereIs) {
  for (const char* text : {"", cardinal, stay, crossing, wire, guy})
    EXPECT_EQ(said_of(text, {}), "") << text;
  for (const char* name : {"acsr-drake-300m", "stay-cable-sutong", "kollar2022", "chaotic-play"}) {
    const std::string file = std::string(HOLDFAST_SOURCE_DIR) + "/data/" + name + ".toml";
    EXPECT_EQ(said_of(read_input(file), {}), "") << name;
  }
}

TEST(Plausibility, DoubtsNothingThatThePaperDoes) {
  for (const char* setting :
       {"control.sampling_period=0.05", "control.sampling_period=0.0001", "backlash.width=0.008",
        "control.differential_gain=-100", "control.proportional_gain=0", "initial.z1=0.05",
        "excitation.amplitude=0", "excitation.frequency=20", "excitation.frequency=0.5"})
    EXPECT_EQ(said_of("", {setting}), "") << setting;
}

struct Mistake {
  const char* setting;
  const char* key;
  const char* unit;
};

TEST(Plausibility, NamesTheKeyAndTheUnitThatWasMistaken) {
  for (const Mistake& mistake : std::vector<Mistake>{
           {"conductor.area=546", "conductor.area", "mm2"},
           {"conductor.area=5.46", "conductor.area", "cm2"},
           {"conductor.mass_per_length=1829", "conductor.mass_per_length", "g/m"},
           {"conductor.youngs_modulus=65", "conductor.youngs_modulus", "GPa"},
           {"conductor.youngs_modulus=65000", "conductor.youngs_modulus", "MPa"},
           {"conductor.sag=11920", "conductor.sag", "mm"},
           {"conductor.sag=0.01192", "conductor.sag", "km"},
           {"conductor.span=0.4", "conductor.span", "km"},
           {"conductor.span=400000", "conductor.span", "mm"},
           {"conductor.damping_ratio=0.5", "conductor.damping_ratio", "%"},
           {"conductor.gravity=981", "conductor.gravity", "cm/s2"},
           {"absorber.mass=5000", "absorber.mass", "g"},
           {"absorber.mass=0.005", "absorber.mass", "t"},
           {"absorber.position=0.0016", "absorber.position", "km"},
           {"absorber.position=1600", "absorber.position", "mm"},
           {"wind.speed=300", "wind.speed", "km/h"},
           {"wind.diameter=30.38", "wind.diameter", "mm"},
           {"wind.effective_length=3200", "wind.effective_length", "mm"},
           {"wind.strouhal=20", "wind.strouhal", "%"},
           {"wind.air_density=0.0012", "wind.air_density", "g/cm3"},
           {"initial.z1=-100", "initial.z1", "mm"},
           {"initial.z2=1000", "initial.z2", "mm"},
           {"initial.v1=500", "initial.v1", "mm/s"},
           {"control.sampling_period=1", "control.sampling_period", "ms"},
           {"control.sampling_period=1000", "control.sampling_period", "us"},
           {"control.processing_delay=0.2", "control.processing_delay", "ms"},
           {"control.differential_gain=-0.06", "control.differential_gain", "kN s/m"},
           {"control.proportional_gain=-60", "control.proportional_gain", "kN/m"},
           {"control.displacement_quantum=0.1", "control.displacement_quantum", "mm"},
           {"control.velocity_quantum=2", "control.velocity_quantum", "mm/s"},
           {"backlash.width=0.02", "backlash.width", "mm"},
           {"reduction.first_frequency=37.7", "reduction.first_frequency", "rad/s"}}) {
    const std::string said = said_of(cardinal, {mistake.setting});
    EXPECT_TRUE(holds(said, std::string("--set ") + mistake.key + "=")) << said;
    EXPECT_TRUE(holds(said, std::string("did you mean ") + mistake.unit) ||
                holds(said, std::string(" or ") + mistake.unit))
        << mistake.setting << "\n"
        << said;
  }
}

TEST(Plausibility, OfAPlantNamesTheKeyAndTheUnitThatWasMistaken) {
  for (const Mistake& mistake :
       std::vector<Mistake>{{"plant.conductor_stiffness=0.0503", "conductor_stiffness", "kN/m"},
                            {"plant.absorber_mass=160", "absorber_mass", "g"},
                            {"plant.conductor_mass=76.7", "conductor_mass", "g"},
                            {"plant.absorber_damping=4000", "absorber_damping", "mN s/m"},
                            {"excitation.frequency=62.8", "excitation.frequency", "rad/s"},
                            {"excitation.amplitude=500", "excitation.amplitude", "mN"}}) {
    const std::string said = said_of("", {mistake.setting});
    EXPECT_TRUE(holds(said, mistake.key)) << said;
    EXPECT_TRUE(holds(said, std::string("did you mean ") + mistake.unit)) << said;
  }
  const std::string both = said_of("", {"plant.conductor_mass=76.7", "plant.absorber_mass=160"});
  EXPECT_TRUE(holds(both, "are plant.conductor_mass, plant.absorber_mass in g?")) << both;
}

TEST(Plausibility, OneMistakenUnitIsSaidOnce) {
  const Words doubts = doubts_about(
      load_case_text(cardinal, "case.toml", {"control.sampling_period=1"}), quantities_of_case());
  EXPECT_EQ(doubts.size(), 1U);
}

TEST(Plausibility, APlaceAtTheSupportIsNamedBeforeTheReadingThatItSpoils) {
  const Words doubts =
      doubts_about(load_case(std::nullopt, {"absorber.position=0.0016"}), quantities_of_case());
  ASSERT_EQ(doubts.size(), 1U);
  EXPECT_TRUE(holds(doubts[0], "--set absorber.position=0.0016: ")) << doubts[0];
  EXPECT_TRUE(holds(doubts[0], "did you mean km, that is 1.6 m?")) << doubts[0];
  const std::string refusal = said_of("", {"absorber.position=0.0016"});
  EXPECT_EQ(refusal.rfind("absorber.position = 0.0016 m", 0), 0U) << refusal;
}

TEST(Plausibility, WhatNoCableHasIsRefusedAtItsLineWithTheAdmissibleRange) {
  std::string text = cardinal;
  text.replace(text.find("546e-6"), 6, "546");
  const std::string refusal = said_of(text, {});
  for (const char* part : {"case.toml:5: conductor.area = 546", "kg/m3; must be at least 10",
                           "did you mean mm2, that is 0.000546 m2?"})
    EXPECT_TRUE(holds(refusal, part)) << refusal;
  EXPECT_THROW(load_case(std::nullopt, {"initial.z1=-100"}), WrongInput);
  EXPECT_THROW(load_case_text(cardinal, "case.toml", {"wind.speed=300"}), WrongInput);
}

}  // namespace
}  // namespace holdfast::program
