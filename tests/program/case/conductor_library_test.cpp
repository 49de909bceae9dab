#include "case/library/conductor_library.hpp"

#include <toml++/toml.h>
#include <nlohmann/json.hpp>

#include "case/case_file.hpp"
#include "case/model/cable_of_case.hpp"
#include "case/plausibility/doubts.hpp"
#include "holdfast/core/types.hpp"
#include "process/errors.hpp"
#include "program/case/case_text.hpp"
#include "support/temporary_folder.hpp"

namespace holdfast::program {
namespace {

/// A span on which a conductor hangs as it does on a line.
std::string span_of(const LibraryConductor& one) {
  return "[conductor]\nname = \"" + one.name +
         "\"\nspan = " + (one.kind == "stay" ? "100" : "300") +
         "\ntension = " + std::to_string(0.2 * one.rated_strength) +
         "\ndamping_ratio = 1e-3\n[absorber]\nposition = 1.5\nmass = 1.0\n";
}

TEST(ConductorLibrary, IsTheFileInTheDataFolderWithNothingElseInIt) {
  const auto file = toml::parse_file(std::string(HOLDFAST_SOURCE_DIR) + "/data/conductors.toml");
  const std::set<std::string> numbers = {"mass_per_length",
                                         "diameter",
                                         "area",
                                         "rated_strength",
                                         "youngs_modulus",
                                         "outer_wire_diameter",
                                         "outer_wire_modulus",
                                         "minimum_bending_stiffness"};
  std::size_t row = 0;
  for (const toml::node& node : *file["conductor"].as_array()) {
    std::set<std::string> missing = numbers;
    missing.insert({"name", "kind", "wires", "source", "derived"});
    for (const auto& [key, value] : *node.as_table()) {
      const bool is_known = missing.erase(std::string(key.str())) == 1 || key.str() == "note" ||
                            key.str() == "layers";
      EXPECT_TRUE(is_known) << key.str();
      if (key.str() != "derived") continue;
      for (const toml::node& name : *value.as_array())
        EXPECT_EQ(numbers.count(name.value<std::string>().value()), 1U);
    }
    EXPECT_TRUE(missing.empty()) << *missing.begin();
    ASSERT_LT(row, conductor_library().size());
    EXPECT_EQ(node.as_table()->at("name").value<std::string>(), conductor_library()[row++].name);
  }
  EXPECT_EQ(row, conductor_library().size());
}

TEST(ConductorLibrary, HasSixtyOrMoreOfDistinctNamesByKindAndAreaEachWithItsSource) {
  const auto& library = conductor_library();
  EXPECT_GE(library.size(), 60U);
  std::set<std::string> names, kinds;
  for (std::size_t k = 0; k < library.size(); ++k) {
    const LibraryConductor& one = library[k];
    EXPECT_EQ(find_conductor(one.name), &one) << "another has the name " << one.name;
    kinds.insert(one.kind);
    EXPECT_GE(one.source.size(), 10U) << one.name;
    EXPECT_LE(one.name.size(), 40U) << one.name;
    if (k == 0) continue;
    const LibraryConductor& before = library[k - 1];
    EXPECT_TRUE(before.kind < one.kind || (before.kind == one.kind && before.area <= one.area))
        << one.name;
  }
  EXPECT_EQ(kinds, (std::set<std::string>{"AAAC", "ACAR", "ACSR", "EHS", "OPGW", "stay"}));
}

TEST(ConductorLibrary, EveryNumberIsOneOfAConductor) {
  for (const LibraryConductor& one : conductor_library()) {
    const double circle = pi<double> / 4.0 * one.diameter * one.diameter;
    const double rod = one.youngs_modulus * one.area * one.area / (4.0 * pi<double>);
    const double wire = pi<double> / 4.0 * one.outer_wire_diameter * one.outer_wire_diameter;
    const auto within = [&](double value, double lowest, double highest) {
      return value >= lowest && value <= highest;
    };
    // Of steel 7780 and of aluminium 2700 kg/m³; laid wires are up to 3 % longer than the
    // conductor, and in an OPGW's mass is its tube with fibres and jelly.
    EXPECT_TRUE(within(one.mass_per_length / one.area, 2600, 1.03 * 7800)) << one.name;
    EXPECT_TRUE(within(one.area / circle, 0.5, 1.0)) << one.name << one.area / circle;
    EXPECT_TRUE(within(one.rated_strength / one.area, 100e6, 2000e6)) << one.name;
    EXPECT_TRUE(within(one.youngs_modulus, 50e9, 210e9)) << one.name;
    EXPECT_TRUE(within(one.outer_wire_modulus, 69e9, 210e9)) << one.name;
    EXPECT_TRUE(within(wire / one.area, 1e-4, 0.18)) << one.name << wire / one.area;
    EXPECT_TRUE(within(one.minimum_bending_stiffness, 1e-4 * rod, rod)) << one.name;
  }
}

/// As the tables of makers and standards print them, typed apart from the library: kg/m, mm, mm²,
/// kN.
struct Printed {
  const char* name;
  double mass, diameter, area, strength;
};

TEST(ConductorLibrary, AgreesWithPublishedTables) {
  for (const Printed& printed :
       {Printed{"Drake", 1.628, 28.14, 468.6, 140.1},
        Printed{"Cardinal", 1.829, 30.38, 546.1, 150.3}, Printed{"Hawk", 0.976, 21.79, 281.0, 86.7},
        Printed{"Zebra", 1.621, 28.62, 484.5, 131.9},
        Printed{"Greeley", 1.295, 28.14, 469.8, 135.7},
        Printed{"EHS 3/8 in", 0.406, 9.15, 51.1, 68.5},
        Printed{"Strand 15.7 mm Y1860S7", 1.172, 15.7, 150.0, 279.0}}) {
    const LibraryConductor* found = find_conductor(printed.name);
    ASSERT_NE(found, nullptr) << printed.name;
    EXPECT_NEAR(found->mass_per_length / printed.mass, 1.0, 0.01) << printed.name;
    EXPECT_NEAR(1e3 * found->diameter / printed.diameter, 1.0, 0.005) << printed.name;
    EXPECT_NEAR(1e6 * found->area / printed.area, 1.0, 0.005) << printed.name;
    EXPECT_NEAR(1e-3 * found->rated_strength / printed.strength, 1.0, 0.012) << printed.name;
  }
}

/// Each layer has six wires more than the one within.
TEST(ConductorLibrary, LayersAreThoseOfTheWires) {
  const auto file = toml::parse_file(std::string(HOLDFAST_SOURCE_DIR) + "/data/conductors.toml");
  std::size_t known = 0;
  for (const toml::node& node : *file["conductor"].as_array()) {
    const toml::table& one = *node.as_table();
    const std::string name = one["name"].value<std::string>().value();
    const std::string wires = one["wires"].value<std::string>().value();
    const auto layers = one["layers"].value<int>();
    const bool has_aluminium = holds(wires, "aluminium") || holds(wires, "alloy");
    EXPECT_EQ(layers.has_value(), has_aluminium) << name;
    EXPECT_EQ(std::isfinite(find_conductor(name)->layers), has_aluminium) << name;
    if (!layers) continue;
    ++known;
    int count = 0;
    for (std::size_t at = 0; at != std::string::npos; at = wires.find(", ", at + 1)) {
      const std::string part = wires.substr(at == 0 ? 0 : at + 2);
      const bool counts = !holds(part.substr(0, part.find(',')), "steel");
      count += counts ? std::stoi(part) : 0;
    }
    // Of aluminium alone there is one wire within the layers.
    const int wires_of_layers = holds(wires, "steel") ? count : count - 1;
    const int innermost = wires_of_layers / *layers - 3 * (*layers - 1);
    EXPECT_EQ(*layers * innermost + 3 * *layers * (*layers - 1), wires_of_layers) << name;
    EXPECT_GE(innermost, 6) << name;
    EXPECT_LE(innermost, 15) << name;
  }
  EXPECT_GE(known, 100U);
}

TEST(ConductorLibrary, EveryConductorMakesACaseThatIsNotDoubted) {
  for (const LibraryConductor& one : conductor_library()) {
    const auto doubts = doubts_about(from_text(span_of(one)), quantities_of_case());
    EXPECT_TRUE(doubts.empty()) << one.name << ": " << doubts.front();
  }
}

TEST(ConductorName, StandsForWhatTheCaseDoesNotGive) {
  const LibraryConductor& drake = *find_conductor("Drake");
  for (const char* name : {"Drake", "drake", "DRAKE"}) {
    const Case the_case = load_case(std::nullopt, {std::string("conductor.name=") + name});
    for (const LibraryKey& key : library_keys()) {
      EXPECT_EQ(case_value(the_case, key.name), drake.*key.value) << key.name;
      EXPECT_TRUE(is_from_library(the_case, key.name)) << key.name;
    }
    EXPECT_EQ(the_case.conductor.name, "Drake");
    EXPECT_EQ(the_case.conductor.span, 6.4) << "the library knows no span";
    EXPECT_TRUE(the_case.conductor_given);
    EXPECT_TRUE(the_case.first_frequency_computed) << "those of the built-in conductor are not its";
  }
  EXPECT_EQ(from_text("[conductor]\nname = \"drake\"\n").conductor.area, drake.area);
}

TEST(ConductorName, AValueThatIsGivenWinsWhereverItStands) {
  const std::string before = "[conductor]\narea = 4e-4\nname = \"Drake\"\n";
  const std::string after = "[conductor]\nname = \"Drake\"\narea = 4e-4\n";
  const double mass = find_conductor("Drake")->mass_per_length;
  for (const Case& the_case :
       {from_text(before), from_text(after),
        load_case(std::nullopt, {"conductor.area=4e-4", "conductor.name=Drake"}),
        load_case(std::nullopt, {"conductor.name=Drake", "conductor.area=4e-4"}),
        from_text("[conductor]\narea = 4e-4\n", {"conductor.name=Drake"}),
        from_text("[conductor]\nname = \"Drake\"\n", {"conductor.area=4e-4"})}) {
    EXPECT_EQ(the_case.conductor.area, 4e-4);
    EXPECT_EQ(the_case.conductor.mass_per_length, mass);
  }
  const Case own = from_text(
      "[conductor]\nname = \"Drake\"\ndiameter = \"unknown\"\n"
      "bending_stiffness = 0\n");
  EXPECT_TRUE(std::isinf(own.conductor.diameter));
  EXPECT_EQ(own.conductor.bending_stiffness, 0.0);
}

TEST(ConductorName, AnotherNameGoesOverItAndNoneTakesItAway) {
  const std::string text = "[conductor]\nname = \"Drake\"\n";
  EXPECT_EQ(from_text(text, {"conductor.name=hawk"}).conductor.area, find_conductor("Hawk")->area);
  const Case none = from_text(text, {"conductor.name=\"\""});
  EXPECT_TRUE(none.stands_alone && std::isnan(none.conductor.area));
  const Case builtin = load_case(std::nullopt, {"conductor.name=Drake", "conductor.name=\"\""});
  EXPECT_EQ(case_to_json(builtin), case_to_json(load_case(std::nullopt, {})));
  EXPECT_FALSE(builtin.conductor_given);
}

TEST(ConductorName, ItsMassCountsInTheSagOfATension) {
  const Case the_case = load_case(
      std::nullopt, {"conductor.span=300", "conductor.tension=28020", "conductor.name=Drake"});
  EXPECT_NEAR(the_case.conductor.sag, 1.628 * 9.81 * 300 * 300 / (8 * 28020), 1e-9);
}

TEST(ConductorName, AWrittenCaseNeedsNoLibrary) {
  const std::string text = span_of(*find_conductor("Drake"));
  const Case the_case = from_text(text);
  std::string written = case_to_toml(the_case);
  EXPECT_EQ(case_to_json(from_text(written)), case_to_json(the_case));
  const std::string name = "name = \"Drake\"";
  ASSERT_TRUE(holds(written, name)) << written;
  written.replace(written.find(name), name.size(), "name = \"\"");
  const Case unnamed = from_text(written);
  for (const LibraryKey& key : library_keys())
    EXPECT_EQ(case_value(unnamed, key.name), case_value(the_case, key.name)) << key.name;
}

TEST(ConductorName, OneThatIsNotKnownIsRefusedWithTheNearest) {
  EXPECT_EQ(
      refusal("[conductor]\nname = \"Drak\"\n").rfind("case.toml:2: conductor.name = 'Drak'", 0),
      0U);
  for (const auto& [given, meant] :
       std::vector<std::pair<std::string, std::string>>{{"Drak", "\"Drake\""},
                                                        {"cardnal", "\"Cardinal\""},
                                                        {"EHS 3/8", "\"EHS 3/8 in\""},
                                                        {"795 kcmil Drake", " or \""},
                                                        {"\\u00e9\\u00e8", " or \""},
                                                        {" ", " or \""}}) {
    const std::string message = refusal("[conductor]\nname = \"" + given + "\"\n");
    EXPECT_TRUE(holds(message, meant)) << message;
    EXPECT_TRUE(holds(message, "holdfast conductors")) << message;
  }
  const std::string endless(100'000, 'x');
  EXPECT_LT(refusal("[conductor]\nname = \"" + endless + "\"\n").size(), 400U);
  for (const char* value : {"12", "true", "nan", "[\"Drake\"]", "\"a\\u0000b\""})
    EXPECT_TRUE(holds(refusal(std::string("[conductor]\nname = ") + value + "\n"),
                      "must be the name of a conductor"))
        << value;
}

TEST(ConductorName, NamesWithBlanksNeedNoQuotesOfTheirOwnInAnOverride) {
  for (const char* name : {"EHS 3/8 in", "\"EHS 3/8 in\"", "ehs 3/8 IN", " EHS 3/8 in "})
    EXPECT_EQ(load_case(std::nullopt, {std::string("conductor.name=") + name}).conductor.name,
              "EHS 3/8 in");
}

TEST(ConductorName, AFaultOfItsValuesIsLaidToItUnlessAnOverrideIsLater) {
  const std::string text = "[conductor]\nname = \"Akron\"\nspan = 6.4\n";
  EXPECT_TRUE(holds(refusal(text + "sag = 1e-9\n"), "case.toml:"));
  EXPECT_EQ(refusal(text, {"conductor.sag=1e-9"}).rfind("--set conductor.sag=1e-9: ", 0), 0U);
}

TEST(ConductorName, ThatIsContradictedIsDoubted) {
  const std::string written = case_to_toml(from_text(span_of(*find_conductor("Drake"))));
  EXPECT_EQ(contradicted_name_text(from_text(written)), "");
  const std::string text = contradicted_name_text(from_text(written, {"conductor.name=Hawk"}));
  EXPECT_EQ(
      text.rfind("--set conductor.name=Hawk: values given besides conductor.name = \"Hawk\"", 0),
      0U)
      << text;
  EXPECT_TRUE(holds(text, "conductor.mass_per_length 1.628 instead of 0.975")) << text;
  EXPECT_EQ(contradicted_name_text(load_case(std::nullopt, {"conductor.name=Hawk"})), "");
}

const std::string wind = "[wind]\nspeed = 3.0\neffective_length = 2.0\n";

TEST(ConductorDiameter, IsThatOfTheWindWhereTheWindHasNone) {
  EXPECT_TRUE(holds(refusal(wind), "wind.diameter is missing"));
  EXPECT_EQ(from_text(wind, {"conductor.name=Drake"}).wind->diameter, 0.028143);
  Case given = from_text(wind, {"conductor.diameter=0.02"});
  EXPECT_EQ(given.wind->diameter, 0.02);
  EXPECT_FALSE(given.conductor_given) << "the two masses do not depend on it";
  set_case_value(given, "conductor.diameter", 0.03);
  EXPECT_EQ(given.wind->diameter, 0.03) << "a sweep moves both";
  Case iced = from_text(wind + "diameter = 0.05\n", {"conductor.name=Drake"});
  EXPECT_EQ(iced.wind->diameter, 0.05);
  set_case_value(iced, "conductor.diameter", 0.03);
  EXPECT_EQ(iced.wind->diameter, 0.05);
}

TEST(ConductorDiameter, AndTheOtherNewKeysRefuseWhatNoConductorHas) {
  for (const char* key : {"conductor.diameter", "conductor.rated_strength",
                          "conductor.outer_wire_diameter", "conductor.outer_wire_modulus"}) {
    for (const char* value : {"0", "-1", "nan", "inf", "true", "\"none\"", "\"\"", "[1]"}) {
      const std::string message = message_of<WrongInput>(
          [&] { load_case(std::nullopt, {std::string(key) + "=" + value}); });
      EXPECT_TRUE(holds(message, "greater than 0")) << message;
    }
    EXPECT_EQ(case_value(load_case(std::nullopt, {}), key),
              std::numeric_limits<double>::infinity());
  }
  EXPECT_TRUE(
      holds(refusal("", {"conductor.diameter=28.14"}), "did you mean mm, that is 0.02814 m?"));
  EXPECT_TRUE(holds(refusal("", {"conductor.name=Drake", "conductor.rated_strength=140.1"}),
                    "did you mean kN, that is 1.401e+05 N?"));
  for (const char* setting : {"conductor.rated_strength=31500", "conductor.outer_wire_modulus=69",
                              "conductor.outer_wire_diameter=4.44"})
    EXPECT_EQ(doubts_about(load_case(std::nullopt, {"conductor.name=Drake", setting}),
                           quantities_of_case())
                  .size(),
              1U)
        << setting;
}

TEST(Conductors, AreFoundByWordsOfNameKindOrSource) {
  EXPECT_EQ(conductors_with("").size(), conductor_library().size());
  ASSERT_EQ(conductors_with("dRAKE").size(), 1U);
  EXPECT_GT(conductors_with("acsr").size(), conductors_with("ACSR Eskom").size());
  EXPECT_EQ(conductors_with("ACSR Eskom").size(), conductors_with(" eskom  acsr ").size());
  EXPECT_FALSE(conductors_with("ACSR Eskom").empty());
  EXPECT_TRUE(conductors_with("drake hawk").empty());
}

}  // namespace
}  // namespace holdfast::program
