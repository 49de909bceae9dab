#include <nlohmann/json.hpp>

#include "case/plausibility/doubts.hpp"
#include "program/case/case_text.hpp"

namespace holdfast::program {
namespace {

using Numbers = std::vector<double>;

TEST(Site, IsReadAsSpeedsWithTheirHoursOrByWeibullsLaw) {
  const Case listed = from_text("[site]\nspeeds = [1, 2.5]\nhours = [300, 8484]\nyears = 50\n");
  EXPECT_EQ(listed.site.speeds, (Numbers{1.0, 2.5}));
  EXPECT_EQ(listed.site.hours, (Numbers{300.0, 8484.0}));
  EXPECT_EQ(listed.site.years, 50.0);
  EXPECT_TRUE(std::isinf(listed.site.weibull_scale));
  EXPECT_EQ(listed.site.weibull_shape, 2.0);
  const Case weibull = from_text("[site]\nweibull_scale = 6\n", {"site.turbulence_intensity=0.15"});
  EXPECT_EQ(weibull.site.weibull_scale, 6.0);
  EXPECT_EQ(weibull.site.turbulence_intensity, 0.15);
  EXPECT_TRUE(weibull.site.speeds.empty());
  EXPECT_FALSE(listed.plant_given || listed.conductor_given);
  const Case none = from_text("[site]\nweibull_scale = 6\n", {"site.weibull_scale=none"});
  EXPECT_TRUE(std::isinf(none.site.weibull_scale));
}

TEST(Site, IsWrittenWhereSomethingIsSaidOfIt) {
  const Case bare = load_case(std::nullopt, {});
  EXPECT_FALSE(has_site(bare));
  EXPECT_FALSE(holds(case_to_toml(bare), "[site]"));
  EXPECT_FALSE(case_to_json(bare).contains("site"));
  for (const std::string text :
       {"[site]\nspeeds = [0.5, 1e2]\nhours = [0, 8784]\n", "[site]\nweibull_scale = 6.25\n",
        "[site]\nyears = 1\n", "[site]\nturbulence_intensity = 1\n"}) {
    const Case the_case = from_text(text);
    EXPECT_TRUE(has_site(the_case)) << text;
    const Case again = from_text(case_to_toml(the_case));
    EXPECT_EQ(case_to_toml(again), case_to_toml(the_case));
    EXPECT_EQ(again.site.speeds, the_case.site.speeds);
    EXPECT_EQ(again.site.hours, the_case.site.hours);
    EXPECT_EQ(case_to_json(again)["site"], case_to_json(the_case)["site"]);
  }
  EXPECT_EQ(case_to_json(from_text("[site]\nyears = 1\n"))["site"].dump(),
            "{\"speeds\":[],\"hours\":[],\"weibull_scale\":\"none\",\"weibull_shape\":2.0,"
            "\"turbulence_intensity\":0.0,\"years\":1.0}");
}

TEST(Site, ListsOfNumbersAreRefusedNumberByNumber) {
  EXPECT_EQ(refusal("[site]\nspeeds = 3\n"),
            "case.toml:2: site.speeds = 3: must be [number, ...], each greater than 0 and at most "
            "150 m/s, or [] for none");
  for (const std::string one : {"0", "-1", "151", "inf", "nan", "\"3\"", "[3]", "true"}) {
    const std::string message = refusal("[site]\nspeeds = [1.0, " + one + "]\nhours = [1, 2]\n");
    EXPECT_TRUE(holds(message, "case.toml:2: site.speeds = [1, ")) << message;
    EXPECT_TRUE(holds(message, "is not admissible: must be [number, ...]")) << message;
  }
  EXPECT_TRUE(holds(override_refusal({"site.hours=[-1]"}), "--set site.hours=[-1]: -1 is "));
  EXPECT_TRUE(holds(override_refusal({"site.hours=many"}), "must be [number, ...]"));
}

TEST(Site, WhatDoesNotFitTogetherIsRefused) {
  for (const auto& [text, why] : std::vector<std::pair<std::string, std::string>>{
           {"speeds = [1, 2]\nhours = [3]\n",
            "case.toml:3: site.hours = [3]: site.speeds has 2 numbers, but site.hours has 1"},
           {"speeds = [1, 2]\n", "case.toml:2: site.speeds = [1, 2]: site.speeds has 2 numbers"},
           {"hours = [3]\n", "case.toml:2: site.hours = [3]: site.speeds has 0 numbers"},
           {"speeds = [1, 2]\nhours = [3, 4]\nweibull_scale = 6\n",
            "case.toml:4: site.weibull_scale = 6: site.speeds (with site.hours) and"},
           {"speeds = [2, 2]\nhours = [3, 4]\n", "site.speeds must ascend: 2 m/s comes after 2"},
           {"speeds = [1, 2]\nhours = [8000, 785]\n", "site.hours add up to 8785 h"}})
    EXPECT_TRUE(holds(refusal("[site]\n" + text), why)) << refusal("[site]\n" + text);
  for (const char* key : {"weibull_scale", "weibull_shape", "years"})
    EXPECT_TRUE(holds(refusal("[site]\n" + std::string(key) + " = 0\n"), "greater than 0")) << key;
  EXPECT_TRUE(holds(refusal("[site]\nturbulence_intensity = 1.1\n"), "at most 1"));
  EXPECT_TRUE(holds(refusal("[site]\nweibull_scale = \"nun\"\n"), "did you mean \"none\"?"));
  EXPECT_TRUE(holds(refusal("[sites]\nyears = 2\n"), "did you mean [site]?"));
}

TEST(Site, WhatIsNotUsualIsDoubted) {
  const auto doubts = [](const std::string& text) {
    return doubts_about(from_text("[site]\n" + text), quantities_of_case());
  };
  EXPECT_TRUE(
      doubts("weibull_scale = 6\nweibull_shape = 1.8\nturbulence_intensity = 0.2\n").empty());
  ASSERT_EQ(doubts("turbulence_intensity = 0.9\n").size(), 1U);
  EXPECT_TRUE(holds(doubts("weibull_scale = 40\n").front(), "did you mean km/h"));
}

TEST(Absorber, MayBeMissingOnEveryModelButTwoMasses) {
  const std::vector<std::string> without = {"plant.absorber_mass=0", "control.proportional_gain=0",
                                            "control.differential_gain=0"};
  const auto with = [&](const std::string& more) {
    std::vector<std::string> all = without;
    all.push_back(more);
    return all;
  };
  for (const char* model : {"string", "cable", "infinite_string"}) {
    const Case the_case = load_case(std::nullopt, with(std::string("plant.model=") + model));
    EXPECT_FALSE(has_absorber(the_case));
    EXPECT_EQ(case_to_toml(from_text(case_to_toml(the_case))), case_to_toml(the_case));
  }
  EXPECT_TRUE(holds(override_refusal(without), "--set plant.absorber_mass=0: "));
  EXPECT_TRUE(holds(override_refusal(without), "needs a second mass greater than 0 kg"));
  for (const char* gain : {"control.proportional_gain=-1", "control.differential_gain=-1",
                           "control.proportional_gain=tuned"}) {
    std::vector<std::string> all = with("plant.model=string");
    all.emplace_back(gain);
    EXPECT_TRUE(holds(override_refusal(all), "the drive moves nothing")) << gain;
  }
  EXPECT_TRUE(holds(override_refusal({"plant.absorber_mass=-1"}), "at least 0 kg"));
}

TEST(Layers, AreKnownOfConductorsWithLayersOfAluminium) {
  const auto layers = [](const std::string& name) {
    return load_case(std::nullopt, {"conductor.name=" + name}).conductor.layers;
  };
  EXPECT_EQ(layers("Drake"), 2.0);     // 26/7
  EXPECT_EQ(layers("Cardinal"), 3.0);  // 54/7
  EXPECT_EQ(layers("Greeley"), 3.0);   // 37 of alloy
  EXPECT_TRUE(std::isinf(layers("EHS 3/8 in")));
  EXPECT_EQ(load_case(std::nullopt, {"conductor.layers=3"}).conductor.layers, 3.0);
  EXPECT_EQ(from_text("[conductor]\nname = \"Drake\"\nlayers = 1\n").conductor.layers, 1.0);
  for (const char* value : {"0", "6", "1.5"})
    EXPECT_TRUE(holds(override_refusal({std::string("conductor.layers=") + value}),
                      "a whole number, at least 1 and at most 5 or \"unknown\""));
}

TEST(Tension, BeyondTheRatedStrengthIsRefused) {
  const std::string span = "[conductor]\nname = \"Drake\"\nspan = 300\n";
  EXPECT_EQ(from_text(span + "tension = 1.3e5\n").conductor.tension, 1.3e5);
  const std::string message = refusal(span + "tension = 1.45e5\n");
  EXPECT_TRUE(holds(message, "the tension divided by conductor.rated_strength is 1.0")) << message;
  EXPECT_TRUE(holds(message, "must be at most 1")) << message;
  const std::string in_kN = refusal(span + "tension = 28e3\nrated_strength = 140.1\n");
  EXPECT_TRUE(holds(in_kN, "did you mean kN, that is 1.401e+05 N?")) << in_kN;
}

}  // namespace
}  // namespace holdfast::program
