#include "case/case_file.hpp"

#include <nlohmann/json.hpp>

#include "case/model/cable_of_case.hpp"
#include "case/needed.hpp"
#include "process/errors.hpp"
#include "program/case/case_text.hpp"
#include "support/temporary_folder.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

using tests::TemporaryFolder;
using tests::write_text;

std::string refusal_of_override(const std::string& text) {
  return message_of<WrongInput>([&] { load_case(std::nullopt, {text}); });
}

/// Equal in every key, and in what the keys mean together.
void expect_same_case(const Case& a, const Case& b) {
  EXPECT_EQ(case_to_json(a), case_to_json(b));
  EXPECT_EQ(a.wind.has_value(), b.wind.has_value());
  EXPECT_EQ(resolved_proportional_gain(a), resolved_proportional_gain(b));
}

const std::string wind_table = "[wind]\nspeed = 3.0\ndiameter = 0.0032\neffective_length = 2.0\n";

TEST(BuiltinCase, IsTableOneAndTheExaminedControl) {
  const Case the_case = load_case(std::nullopt, {});
  EXPECT_EQ(the_case.conductor.mass_per_length, 0.043);
  EXPECT_EQ(the_case.conductor.span, 6.4);
  EXPECT_EQ(the_case.conductor.sag, 0.29);
  EXPECT_EQ(the_case.conductor.area, 5.5e-6);
  EXPECT_EQ(the_case.conductor.youngs_modulus, 18e9);
  EXPECT_EQ(the_case.conductor.damping_ratio, 0.02);
  EXPECT_EQ(the_case.absorber.position, the_case.conductor.span / 10.0);
  EXPECT_EQ(the_case.plant.conductor_mass, 0.0767);
  EXPECT_EQ(the_case.plant.conductor_stiffness, 50.3);
  EXPECT_EQ(the_case.plant.conductor_damping, 0.079);
  EXPECT_EQ(the_case.plant.absorber_mass, 0.16);
  EXPECT_EQ(the_case.plant.absorber_stiffness, 74.4);
  EXPECT_EQ(the_case.plant.absorber_damping, 4.0);
  EXPECT_EQ(the_case.control.proportional_gain, -557.0);
  EXPECT_EQ(the_case.control.differential_gain, -13.0);
  EXPECT_EQ(the_case.control.sampling_period, 0.001);
  EXPECT_EQ(the_case.control.processing_delay, 0.0);
  EXPECT_EQ(the_case.backlash.width, 0.0005);
  EXPECT_EQ(the_case.excitation.amplitude, 0.5);
  EXPECT_EQ(the_case.excitation.frequency, 10.0);
  EXPECT_FALSE(the_case.plant_given || the_case.conductor_given || the_case.wind);
}

TEST(BuiltinCase, IsTheFileInTheDataFolder) {
  const auto file = std::filesystem::path(HOLDFAST_SOURCE_DIR) / "data" / "kollar2022.toml";
  EXPECT_EQ(std::string(builtin_case_text), tests::read_text(file));
  expect_same_case(load_case(file, {}), load_case(std::nullopt, {}));
}

TEST(BuiltinCase, ReductionFrequenciesAreThoseOfThePlant) {
  const Case the_case = load_case(std::nullopt, {});
  const auto& plant = the_case.plant;
  const double pi = std::acos(-1.0);
  for (const double frequency :
       {the_case.reduction.first_frequency, the_case.reduction.second_frequency}) {
    // det(K - omega^2 M) = 0 of the undamped plant; its root lies within the digits given.
    const auto determinant = [&](double hertz) {
      const double square = std::pow(2.0 * pi * hertz, 2);
      const double k1 = plant.conductor_stiffness;
      const double k2 = plant.absorber_stiffness;
      return (k1 + k2 - square * plant.conductor_mass) * (k2 - square * plant.absorber_mass) -
             k2 * k2;
    };
    EXPECT_LT(determinant(frequency - 0.001) * determinant(frequency + 0.001), 0.0) << frequency;
  }
}

TEST(BuiltinCase, EveryKeyHasADefaultButTheWindThatMustBeGiven) {
  for (const CaseKey& key : case_keys()) {
    EXPECT_EQ(case_default(key).empty(), key.required) << key.name;
  }
  EXPECT_EQ(case_default(*find_case_key("wind.strouhal")), "0.2");
  EXPECT_EQ(case_default(*find_case_key("backlash.law")), "\"kollar\"");
}

TEST(CaseFile, AKeyGivenGoesOverTheBuiltInAndTheOthersStay) {
  const Case builtin = load_case(std::nullopt, {});
  const Case the_case = from_text("[plant]\nabsorber_damping = 5\n[backlash]\nwidth = 2e-3\n");
  EXPECT_EQ(the_case.plant.absorber_damping, 5.0);
  EXPECT_EQ(the_case.plant.absorber_mass, builtin.plant.absorber_mass);
  EXPECT_EQ(the_case.backlash.width, 0.002);
  EXPECT_TRUE(the_case.plant_given);
  EXPECT_FALSE(the_case.conductor_given);
}

TEST(CaseFile, AnOverrideGoesOverTheFileAndTheLastOverAll) {
  const Case the_case =
      from_text("[control]\nsampling_period = 0.01\n",
                {"control.sampling_period=0.02", "control.sampling_period = 0.03"});
  EXPECT_EQ(the_case.control.sampling_period, 0.03);
}

TEST(CaseFile, AnEmptyFileIsTheBuiltInCase) {
  expect_same_case(from_text(""), load_case(std::nullopt, {}));
}

/// Values of the keys that are 0, none or a word where nobody gives them.
const std::vector<std::string> digital_values = {
    "backlash.law=dead_zone",
    "backlash.contact_stiffness=1e4",
    "backlash.contact_damping=2",
    "control.displacement_quantum=1e-5",
    "control.velocity_quantum=1e-3",
    "control.velocity=difference",
    "control.largest_force=3",
    "control.jitter=1e-4",
    "control.jitter_seed=9007199254740992",
    "excitation.harmonics=[[0.1, 20], [0, 1e-3, -0.5]]",
    "excitation.record=wind tunnel/force.csv",
    "excitation.record_interpolation=held",
    "excitation.noise_rms=0.2",
    "excitation.noise_seed=0"};

TEST(CaseFile, WritingAndReadingGivesTheSameCase) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> factor(0.99, 1.0);
  for (int i = 0; i < 200; ++i) {
    Case the_case = from_text(i % 2 == 0 ? "" : wind_table,
                              i % 7 == 0 ? std::vector<std::string>() : digital_values);
    for (const CaseKey& key : case_keys()) {
      const bool free = key.is_number() && key.number(the_case) != nullptr && !key.range.whole &&
                        !key.bears_word(the_case) && !is_absent(the_case, key) &&
                        key.table() != "weather" && !(key.replaced_by_wind && the_case.wind);
      if (free) set_case_value(the_case, key.name, *key.number(the_case) * factor(random));
    }
    the_case.control.proportional_gain_tuned = i % 3 == 0;
    the_case.excitation.hold = i % 5 == 0 ? "exact" : "sampled";
    for (auto& harmonic : the_case.excitation.harmonics)
      for (double& number : harmonic) number *= factor(random);
    const Case read = from_text(case_to_toml(the_case));
    expect_same_case(read, the_case);
    EXPECT_EQ(read.excitation.harmonics, the_case.excitation.harmonics);
    EXPECT_EQ(read.excitation.record, the_case.excitation.record);
    EXPECT_EQ(read.control.largest_force, the_case.control.largest_force);
  }
}

TEST(CaseFile, ACaseWithoutTheKeysOfARealLoopHasAnIdealOne) {
  const Case builtin = load_case(std::nullopt, {});
  EXPECT_EQ(builtin.backlash.law, "kollar");
  EXPECT_EQ(builtin.control.velocity, "measured");
  EXPECT_TRUE(std::isinf(builtin.control.largest_force));
  EXPECT_TRUE(builtin.excitation.harmonics.empty() && builtin.excitation.record.empty());
  for (const char* key :
       {"backlash.contact_stiffness", "backlash.contact_damping", "control.displacement_quantum",
        "control.velocity_quantum", "control.jitter", "excitation.noise_rms"}) {
    EXPECT_EQ(case_value(builtin, key), 0.0) << key;
  }
}

TEST(CaseFile, NamesOfFilesAreWrittenSoThatTheyReadBack) {
  Case the_case = load_case(std::nullopt, {});
  for (const char* name : {"a.csv", "a \"b\" c.csv", "back\\slash", "tab\tline\nend\x7f",
                           "\u00e9.csv", "'single'", "#[x]=1", "\x01\x1f"}) {
    the_case.excitation.record = name;
    EXPECT_EQ(from_text(case_to_toml(the_case)).excitation.record, name);
  }
}

TEST(CaseFile, NumbersBeyondAnIntegerAreWrittenAsFloats) {
  Case the_case = load_case(std::nullopt, {});
  for (const double value : {12345678901234567000.0, 1e300, 1e-300, -3.0, 0.1}) {
    the_case.initial.v1 = value;
    EXPECT_EQ(from_text(case_to_toml(the_case)).initial.v1, value);
  }
}

TEST(CaseFile, EveryKeyRefusesAWrongTypeWithFileLineKeyAndWhatIsAdmissible) {
  for (const CaseKey& key : case_keys()) {
    for (const std::string value : {"true", "[1, 2]", "1979-05-27", "{ a = 1 }", "\"nonsense\""}) {
      if (key.kind == ValueKind::file && value.front() == '"') continue;  // as good a name as any
      const bool is_list = key.kind == ValueKind::interval || key.kind == ValueKind::numbers;
      if (is_list && value.front() == '[') continue;
      const std::string message =
          refusal("\n[" + key.table() + "]\n" + key.short_name() + " = " + value + "\n");
      EXPECT_TRUE(holds(message, "case.toml:3: " + key.name + " = ")) << message;
      EXPECT_TRUE(holds(message, key.admissible())) << message;
    }
  }
}

TEST(CaseFile, EveryNumberRefusesWhatIsNotFinite) {
  for (const CaseKey& key : case_keys()) {
    if (!key.is_number()) continue;
    for (const std::string value : {"nan", "inf", "-inf", "+inf", "1e999"}) {
      const std::string message =
          refusal("[" + key.table() + "]\n" + key.short_name() + " = " + value + "\n");
      EXPECT_TRUE(holds(message, "case.toml:2")) << message;
      EXPECT_TRUE(holds(refusal_of_override(key.name + "=" + value), "--set " + key.name)) << value;
    }
  }
}

TEST(CaseFile, EveryBoundedNumberRefusesWhatIsBelow) {
  for (const CaseKey& key : case_keys()) {
    if (!key.is_number() || !std::isfinite(key.range.lowest)) continue;
    const std::string below = format_number(std::min(-1e-3, key.range.lowest - 1.0));
    const std::string message =
        refusal("[" + key.table() + "]\n" + key.short_name() + " = " + below + "\n");
    EXPECT_TRUE(holds(message, "case.toml:2: " + key.name + " = " + below + ": ")) << message;
    EXPECT_TRUE(holds(message, key.admissible())) << message;
    const std::string override = refusal_of_override(key.name + "=" + below);
    EXPECT_TRUE(holds(override, "--set " + key.name + "=" + below + ": ")) << override;
  }
}

TEST(CaseFile, WholeNumbersRefuseFractionsAndAdmitThemWrittenAsFloats) {
  EXPECT_EQ(from_text("[excitation]\nnoise_lines = 50\n").excitation.noise_lines, 50.0);
  EXPECT_EQ(from_text("[excitation]\nnoise_lines = 5e1\n").excitation.noise_lines, 50.0);
  EXPECT_EQ(refusal("[excitation]\nnoise_lines = 2.5\n"),
            "case.toml:2: excitation.noise_lines = 2.5: must be a whole number, at least 1 "
            "and at most 10000");
  EXPECT_TRUE(holds(refusal_of_override("control.jitter_seed=0.5"),
                    "--set control.jitter_seed=0.5: must be a whole number"));
  EXPECT_TRUE(holds(refusal("[excitation]\nnoise_lines = 10001\n"), "at most 10000"));
}

TEST(CaseFile, AMisspeltWordGetsTheNearestOne) {
  EXPECT_EQ(refusal("[backlash]\nlaw = \"kolar\"\n"),
            "case.toml:2: backlash.law = 'kolar': must be \"kollar\" or \"immediate\" or \"play\" "
            "or \"dead_zone\" or \"none\"; did you mean \"kollar\"?");
  EXPECT_TRUE(holds(refusal_of_override("backlash.law=deadzone"), "did you mean \"dead_zone\"?"));
  EXPECT_TRUE(holds(refusal_of_override("control.velocity=mesured"), "did you mean \"measured\"?"));
  EXPECT_TRUE(
      holds(refusal_of_override("control.proportional_gain=tunde"), "did you mean \"tuned\"?"));
  EXPECT_TRUE(holds(refusal_of_override("control.largest_force=nun"),
                    "must be a number: greater than 0 N or \"none\"; did you mean \"none\"?"));
  EXPECT_FALSE(holds(refusal_of_override("initial.z1=fast"), "did you mean"));
  EXPECT_FALSE(holds(refusal_of_override("backlash.law=true"), "did you mean"));
}

TEST(CaseFile, TheLargestForceIsANumberOrNone) {
  EXPECT_EQ(from_text("[control]\nlargest_force = 4\n").control.largest_force, 4.0);
  const Case none = from_text("[control]\nlargest_force = 4\n", {"control.largest_force=none"});
  EXPECT_TRUE(std::isinf(none.control.largest_force));
  EXPECT_EQ(case_to_json(none)["control"]["largest_force"], "none");
  for (const char* value : {"0", "-1", "inf", "true"})
    EXPECT_TRUE(
        holds(refusal_of_override(std::string("control.largest_force=") + value), "or \"none\""));
}

using HarmonicList = std::vector<std::array<double, 3>>;

TEST(CaseFile, HarmonicsAreAListOfAmplitudeFrequencyAndPhase) {
  const std::string text = "[excitation]\nharmonics = [[0.1, 20, -1.5], [1, 2.5]]\n";
  const HarmonicList expected = {{0.1, 20.0, -1.5}, {1.0, 2.5, 0.0}};
  EXPECT_EQ(from_text(text).excitation.harmonics, expected);
  const Case one = from_text(text, {"excitation.harmonics=[[0.1,20,0]]"});
  EXPECT_EQ(one.excitation.harmonics, (HarmonicList{{0.1, 20.0, 0.0}}));
  EXPECT_TRUE(from_text(text, {"excitation.harmonics=[]"}).excitation.harmonics.empty());
  EXPECT_EQ(case_to_json(one)["excitation"]["harmonics"].dump(), "[[0.1,20.0,0.0]]");
}

TEST(CaseFile, EachFaultyHarmonicIsShown) {
  for (const std::string one :
       {"[0.1]", "[0.1, 20, 0, 0]", "[]", "[-0.1, 20, 0]", "[0.1, 0, 0]", "[0.1, -20]",
        "[0.1, 20, nan]", "[inf, 20]", "[0.1, \"20\"]", "0.1", "[0.1, 20, [0]]", "true"}) {
    const std::string message = refusal("\n[excitation]\nharmonics = [[0.1, 20], " + one + "]\n");
    EXPECT_TRUE(holds(message, "case.toml:3: excitation.harmonics = ")) << message;
    EXPECT_TRUE(holds(message, "frequency greater than 0 Hz")) << message;
  }
  EXPECT_TRUE(holds(refusal_of_override("excitation.harmonics=[[0.1,-20,0]]"),
                    "the harmonic [0.1, -20, 0] is not admissible"));
  EXPECT_TRUE(holds(refusal_of_override("excitation.harmonics=3"), "must be [[amplitude"));
}

TEST(CaseFile, ARecordLiesInTheFolderOfTheFileThatNamesIt) {
  const TemporaryFolder folder;
  write_text(folder / "case.toml", "[excitation]\nrecord = \"forces/one.csv\"\n");
  const auto record = [&](const std::vector<std::string>& overrides) {
    return load_case(folder / "case.toml", overrides).excitation.record;
  };
  EXPECT_EQ(record({}), (folder / "forces/one.csv").string());
  EXPECT_EQ(record({"excitation.record=two.csv"}), "two.csv");
  EXPECT_EQ(record({"excitation.record=\"two.csv\""}), "two.csv");
  EXPECT_EQ(record({"excitation.record=my forces/a#1.csv"}), "my forces/a#1.csv");
  EXPECT_EQ(record({"excitation.record=\"\""}), "");
  write_text(folder / "case.toml", "[excitation]\nrecord = \"/forces/one.csv\"\n");
  EXPECT_EQ(record({}), "/forces/one.csv");
  write_text(folder / "case.toml", "[excitation]\nrecord = \"\"\n");
  EXPECT_EQ(record({}), "");
  EXPECT_EQ(from_text("[excitation]\nrecord = \"one.csv\"\n").excitation.record, "one.csv");
}

TEST(CaseFile, WhatIsNoNameOfAFileIsRefused) {
  EXPECT_TRUE(holds(refusal("[excitation]\nrecord = \"a\\u0000b\"\n"), "the name of a file"));
  EXPECT_TRUE(holds(refusal_of_override("excitation.record=12"), "the name of a file"));
  EXPECT_TRUE(holds(refusal_of_override("excitation.record="), "expected key=value"));
}

TEST(CaseFile, NegativeQuantaAreRefusedWithTheirPlaceAndRange) {
  EXPECT_EQ(refusal("[control]\nvelocity_quantum = -1e-3\n"),
            "case.toml:2: control.velocity_quantum = -0.001: must be at least 0 m/s");
  EXPECT_EQ(refusal_of_override("control.displacement_quantum=-1"),
            "--set control.displacement_quantum=-1: must be at least 0 m");
}

TEST(CaseFile, FaultsOfARealLoopPointAtTheValueGivenLast) {
  EXPECT_TRUE(holds(refusal("[backlash]\ncontact_stiffness = 5\n"),
                    "case.toml:2: backlash.contact_stiffness = 5: backlash.contact_stiffness"));
  EXPECT_TRUE(holds(
      refusal("[backlash]\nlaw = \"dead_zone\"\ncontact_damping = 5\n", {"backlash.law=play"}),
      "--set backlash.law=play: backlash.contact_damping = 5 N s/m"));
  EXPECT_TRUE(holds(refusal_of_override("control.jitter=0.0005"), "--set control.jitter=0.0005: "));
  EXPECT_TRUE(holds(refusal("[excitation]\nnoise_rms = 1\nnoise_highest = 1\n"), "case.toml:3: "));
}

TEST(CaseFile, UnknownNamesGetTheNearestKnownOne) {
  EXPECT_TRUE(holds(refusal("[control]\nsamplingperiod = 1\n"),
                    "case.toml:2: control.samplingperiod = 1: unknown key: did you mean "
                    "control.sampling_period (greater than 0 s)?"));
  EXPECT_TRUE(holds(refusal("\n[contorl]\nx = 1\n"), "case.toml:2: [contorl]"));
  EXPECT_TRUE(holds(refusal("[contorl]\n"), "did you mean [control]?"));
  EXPECT_TRUE(holds(refusal("sampling_period = 1\n"), "did you mean control.sampling_period"));
  EXPECT_TRUE(holds(refusal("control = 1\n"), "must be a table"));
  EXPECT_TRUE(holds(refusal("[[control]]\nsampling_period = 1\n"), "must be a table"));
  EXPECT_TRUE(holds(refusal("[control.deep]\nx = 1\n"), "control.deep"));
  EXPECT_TRUE(holds(refusal_of_override("control.width=1"), "did you mean backlash.width"));
}

TEST(CaseFile, TheNameOfAFileMustBeOneThatACaseCanHold) {
  EXPECT_TRUE(
      holds(refusal_of_override("excitation.record=r\xEA.csv"), "must be the name of a file"));
  EXPECT_EQ(load_case(std::nullopt, {"excitation.record=r\xC3\xA9.csv"}).excitation.record,
            "r\xC3\xA9.csv");
}

TEST(CaseFile, SymbolsAndOtherWordsNameTheirKeys) {
  for (const auto& [word, key] :
       std::vector<std::pair<std::string, std::string>>{{"tau", "control.sampling_period"},
                                                        {"control.D", "control.differential_gain"},
                                                        {"r0", "backlash.width"},
                                                        {"m1", "plant.conductor_mass"},
                                                        {"plant.k2", "plant.absorber_stiffness"},
                                                        {"f", "excitation.frequency"}})
    EXPECT_TRUE(holds(refusal_of_override(word + "=1"), "did you mean " + key + " (")) << word;
}

TEST(CaseFile, WhatIsWrongWithANumberIsGuessed) {
  EXPECT_TRUE(holds(refusal("[backlash]\nwidth = 0,002\n"), "case.toml:2: "));
  EXPECT_TRUE(holds(refusal("[backlash]\nwidth = 0,002\n"), "a decimal point, not a comma"));
  EXPECT_TRUE(holds(refusal_of_override("backlash.width=0,002"), "a decimal point, not a comma"));
  EXPECT_TRUE(holds(refusal("[backlash]\nwidth = 2 mm  # play\n"), "the number alone"));
  EXPECT_TRUE(holds(refusal("[backlash]\nwidth = 2 mm\n"), "in quotes: \"28.2 kN\""));
  EXPECT_FALSE(holds(refusal("[backlash]\nwidth = \n"), "the number alone"));
  EXPECT_FALSE(holds(refusal("[backlash]\nlaw = [1,2\n"), "comma"));
}

TEST(CaseFile, TheFirstMistakeInTheFileIsTheOneReported) {
  EXPECT_TRUE(holds(refusal("[initial]\nz1 = \"a\"\n[control]\nsampling_period = -1\n"), ":2: "));
}

TEST(CaseFile, SyntaxErrorsBearFileAndLine) {
  for (const std::string text :
       {"[control\n", "[control]\nsampling_period == 1\n", "a = \"\n",
        "[initial]\nz1 = 1\nz1 = 2\n", "[initial]\n[initial]\n", "a = \"\xff\"\n", "z = 1e\n"}) {
    EXPECT_EQ(refusal(text).rfind("case.toml:", 0), 0u) << refusal(text);
  }
  EXPECT_TRUE(holds(refusal("[initial]\nz1 = 1\nz1 = 2\n"), "case.toml:3: "));
}

TEST(CaseFile, AbsentAndUnreadableFilesAreNamed) {
  const TemporaryFolder folder;
  const auto message = [](const std::filesystem::path& file) {
    return message_of<WrongInput>([&] { load_case(file, {}); });
  };
  EXPECT_TRUE(holds(message(folder / "absent.toml"), "absent.toml: No such file"));
  EXPECT_TRUE(holds(message(folder.path()), "directory"));
  write_text(folder / "line\nend.toml", "[control]\nsampling_period = -1\n");
  EXPECT_EQ(message(folder / "line\nend.toml").find('\n'), std::string::npos);
}

TEST(CaseFile, FaultsBetweenKeysPointAtTheValueGivenLast) {
  const std::string text = "[control]\nprocessing_delay = 0.005\nsampling_period = 0.01\n";
  EXPECT_EQ(from_text(text).control.processing_delay, 0.005);
  EXPECT_TRUE(holds(refusal(text, {"control.sampling_period=0.00001"}),
                    "--set control.sampling_period=0.00001: control.processing_delay"));
  EXPECT_TRUE(holds(refusal("[control]\nprocessing_delay = 0.5\n"), "case.toml:2: "));
}

TEST(CaseFile, FaultsBetweenKeysOfAFileAreLaidToTheKeyThatExplainsThem) {
  const std::string text =
      "[conductor]\nyoungs_modulus = 1e3\nspan = 6.4\nsag = 0.29\ngravity = 9.81\n"
      "mass_per_length = 0.043\narea = 5.5e-6\n"
      "[absorber]\nposition = 0.64\n";
  EXPECT_TRUE(holds(refusal(text), "case.toml:2: conductor.youngs_modulus")) << refusal(text);
}

TEST(CaseFile, AnotherConductorHasItsOwnFrequencies) {
  const Case builtin = from_text("");
  const Case longer = from_text("", {"conductor.span=7"});
  EXPECT_TRUE(longer.conductor_given && longer.first_frequency_computed);
  EXPECT_EQ(longer.reduction.first_frequency, default_frequencies(longer).first);
  EXPECT_EQ(longer.reduction.second_frequency, default_frequencies(longer).second);
  EXPECT_NE(longer.reduction.first_frequency, builtin.reduction.first_frequency);
  const Case half = from_text("[reduction]\nfirst_frequency = 1.5\n", {"conductor.span=7"});
  EXPECT_EQ(half.reduction.first_frequency, 1.5);
  EXPECT_EQ(half.reduction.second_frequency, longer.reduction.second_frequency);
  EXPECT_FALSE(half.first_frequency_computed);
}

TEST(CaseFile, DampingAndAbsorberLeaveTheFrequenciesOfTheConductor) {
  for (const char* text : {"[conductor]\ndamping_ratio = 0.03\n", "[absorber]\nmass = 0.1\n"}) {
    const Case the_case = from_text(text);
    EXPECT_TRUE(the_case.conductor_given);
    EXPECT_EQ(the_case.reduction.first_frequency, from_text("").reduction.first_frequency);
  }
}

TEST(CaseFile, AGivenPlantIsUsedAsItIs) {
  const Case both = from_text("[plant]\nabsorber_mass = 0.2\n", {"conductor.span=7"});
  EXPECT_EQ(both.conductor.span, 7.0);
  EXPECT_TRUE(both.conductor_given && both.plant_given);
  EXPECT_EQ(both.plant.absorber_mass, 0.2);
  EXPECT_EQ(both.plant.conductor_mass, 0.0767);
}

TEST(CaseFile, TheConductorsShapeIsChecked) {
  const std::string deep = "[conductor]\nsag = 3.2\nspan = 6.4\n";
  EXPECT_TRUE(holds(refusal(deep), "case.toml:2: "));
  EXPECT_TRUE(holds(refusal(deep), "half of conductor.span = 6.4 m"));
  EXPECT_TRUE(holds(refusal_of_override("conductor.sag=3.2"), "half of conductor.span = 6.4 m"));
  EXPECT_TRUE(holds(refusal("[absorber]\nposition = 6.4\n"), "less than conductor.span"));
  EXPECT_TRUE(holds(refusal_of_override("absorber.position=-1"), "greater than 0 m"));
}

TEST(CaseFile, WindOutsideAeolianVibrationIsToldWhy) {
  EXPECT_EQ(wind_warning(from_text("")), "");
  Case the_case = from_text(wind_table);
  the_case.wind->speed = 0.1;  // 6.25 Hz
  EXPECT_EQ(wind_warning(the_case), "");
  the_case.wind->speed = 0.01;
  EXPECT_TRUE(holds(wind_warning(the_case), "0.625 Hz, outside the 3 to 150 Hz"));
  EXPECT_TRUE(holds(wind_warning(the_case), "sways the span as a whole"));
  // A stay of 100 m, 60 kg/m, under 4 MN has its second mode at 2.58 Hz.
  Case stay = the_case;
  stay.conductor.span = 100.0;
  stay.conductor.sag = 0.184;
  stay.wind->speed = 0.04;  // 2.5 Hz
  EXPECT_TRUE(holds(wind_warning(stay), "about mode 2 of the span"));
  EXPECT_FALSE(holds(wind_warning(stay), "sways"));
  the_case.wind->speed = 10.0;
  EXPECT_TRUE(holds(wind_warning(the_case), "625 Hz, outside the 3 to 150 Hz"));
}

TEST(CaseFile, WindMakesTheExcitation) {
  const Case the_case = from_text(wind_table);
  const auto force = effective_excitation(the_case);
  EXPECT_DOUBLE_EQ(force.frequency, 0.2 * 3.0 / 0.0032);
  EXPECT_DOUBLE_EQ(force.amplitude, 0.5 * 1.225 * 9.0 * 0.0032 * 2.0 * 1.0);
  EXPECT_EQ(force.hold, "sampled");
}

TEST(CaseFile, WindAndExcitationExcludeOneAnother) {
  EXPECT_TRUE(holds(refusal("[excitation]\namplitude = 1\n" + wind_table), "case.toml:2: "));
  EXPECT_TRUE(holds(refusal(wind_table, {"excitation.frequency=3"}), "--set excitation"));
  EXPECT_EQ(from_text("[excitation]\nhold = \"exact\"\n" + wind_table).excitation.hold, "exact");
  const Case gusty = from_text("[excitation]\nnoise_rms = 2\nharmonics = [[1, 2]]\n" + wind_table);
  EXPECT_EQ(effective_excitation(gusty).noise_rms, 2.0);
  EXPECT_EQ(effective_excitation(gusty).harmonics.size(), 1U);
  EXPECT_EQ(effective_excitation(gusty).frequency,
            effective_excitation(from_text(wind_table)).frequency);
  const Case replaced =
      from_text("[excitation]\namplitude = 1\n",
                {"wind.speed=3", "wind.diameter=0.0032", "wind.effective_length=2"});
  EXPECT_TRUE(replaced.wind.has_value());
}

TEST(CaseFile, WindNeedsItsThreeQuantities) {
  EXPECT_TRUE(holds(refusal("[wind]\n"), "case.toml:1: [wind]: wind.speed is missing"));
  EXPECT_TRUE(
      holds(refusal("[wind]\nspeed = 3\neffective_length = 1\n"), "wind.diameter is missing"));
  EXPECT_TRUE(holds(refusal_of_override("wind.speed=3"), "wind.diameter is missing"));
}

TEST(CaseFile, TheGainIsANumberOrTuned) {
  EXPECT_EQ(resolved_proportional_gain(load_case(std::nullopt, {})), -557.0);
  for (const char* text : {"control.proportional_gain=tuned", "control.proportional_gain=\"tuned\"",
                           "control.proportional_gain='tuned'"}) {
    const Case the_case = load_case(std::nullopt, {text});
    EXPECT_TRUE(the_case.control.proportional_gain_tuned);
    // The paper rounds Eq. 6 at 10 Hz to -557.
    EXPECT_NEAR(resolved_proportional_gain(the_case), -557.0, 0.5);
  }
  const Case number =
      load_case(std::nullopt, {"control.proportional_gain=tuned", "control.proportional_gain=-1"});
  EXPECT_EQ(resolved_proportional_gain(number), -1.0);
}

TEST(Override, ValuesAreTomlOrABareWord) {
  EXPECT_EQ(load_case(std::nullopt, {"initial.z1=-0.5"}).initial.z1, -0.5);
  EXPECT_EQ(load_case(std::nullopt, {"initial.z1=1e-3"}).initial.z1, 1e-3);
  EXPECT_EQ(load_case(std::nullopt, {"initial.v1=1_000"}).initial.v1, 1000.0);
  EXPECT_EQ(load_case(std::nullopt, {"excitation.hold=exact"}).excitation.hold, "exact");
  EXPECT_EQ(load_case(std::nullopt, {"excitation.hold='exact'"}).excitation.hold, "exact");
}

TEST(Override, MalformedOnesAreRefusedWithTheirText) {
  for (const char* text :
       {"", "control", "control.sampling_period", "control.sampling_period=", "=1",
        "control.sampling_period=1 2", "control.sampling_period=0.5kg",
        "control.sampling_period=1\nother = 2", "control=1", "excitation.hold=none",
        "backlash.law=other", "control.sampling_period=\"0.1\"", "initial.z1=true"}) {
    const std::string message = refusal_of_override(text);
    EXPECT_EQ(message.rfind("--set", 0), 0u) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

TEST(CaseJson, HasEveryKeyInForceInItsTable) {
  const Case windy = from_text(wind_table, {"control.proportional_gain=tuned"});
  const auto json = case_to_json(windy);
  EXPECT_EQ(json["wind"]["speed"], 3.0);
  EXPECT_EQ(json["control"]["proportional_gain"], "tuned");
  EXPECT_FALSE(json["excitation"].contains("amplitude"));
  EXPECT_EQ(json["excitation"]["noise_rms"], 0.0);
  EXPECT_EQ(json["excitation"]["noise_lines"].dump(), "1000");
  EXPECT_EQ(json["excitation"]["harmonics"].dump(), "[]");
  const auto still = case_to_json(load_case(std::nullopt, {}));
  EXPECT_FALSE(still.contains("wind"));
  EXPECT_EQ(still["excitation"]["amplitude"], 0.5);
}

}  // namespace
}  // namespace holdfast::program
