#include "case/model/stringing_of_case.hpp"

#include "case/library/conductor_library.hpp"
#include "case/model/cable_of_case.hpp"
#include "program/case/case_text.hpp"
#include "program/jobs/answer_in_memory.hpp"

namespace holdfast::program {
namespace {

using tests::answer_of, tests::AnswerInMemory;
using Words = std::vector<std::string>;

const std::string drake =
    "[conductor]\nname = \"Drake\"\nspan = \"700 ft\"\ndamping_ratio = 2e-4\n";
/// As the published span of 700 ft was strung: 6300 lbf in the mean, 60 degF.
const std::string strung =
    drake +
    "[stringing]\ntemperature = \"60 degF\"\ntension = \"6294.2 lbf\"\nstate = \"initial\"\n";

TEST(Stringing, GivesEveryJobTheTensionOfItsTemperature) {
  const Case as_strung = from_text(strung);
  EXPECT_NEAR(parabolic_tension_of(as_strung), 6294.2 * 4.4482216152605, 1e-6);
  const Case cold = from_text(strung, {"weather.temperature=-20 degF"});
  const double mean = 4.4482216152605 * (8824.0 - 0.5 * 1.094 * 7.60);
  EXPECT_NEAR(parabolic_tension_of(cold), mean, 0.002 * mean);
  // The same through a sweep's way of setting keys.
  EXPECT_DOUBLE_EQ(
      parabolic_tension_of(case_with(as_strung, "weather.temperature", (-20. - 32) / 1.8)),
      parabolic_tension_of(cold));
  // Written and read again, it is the same case.
  const Case again = from_text(case_to_toml(cold));
  EXPECT_EQ(case_to_toml(again), case_to_toml(cold));
  EXPECT_DOUBLE_EQ(again.conductor.tension, cold.conductor.tension);
  EXPECT_FALSE(holds(case_to_toml(cold), "\nsag = "));
}

TEST(Stringing, BySagIsByTheTensionThatLeavesIt) {
  const Case by_sag = from_text(drake + "[stringing]\ntemperature = \"60 degF\"\nsag = 3.2462\n");
  const double weight = by_sag.conductor.mass_per_length * by_sag.conductor.gravity;
  EXPECT_NEAR(catenary_sag(by_sag.conductor.tension, weight, by_sag.conductor.span), 3.2462, 1e-9);
}

TEST(Stringing, OfARulingSpanKeepsItsTensionAndTheCasesOwnSag) {
  const Case alone = from_text(strung, {"weather.temperature=80"});
  const Case of_longer = from_text(strung, {"weather.temperature=80", "stringing.ruling_span=400"});
  EXPECT_GT(of_longer.conductor.tension, 1.02 * alone.conductor.tension);
  const Case longer = from_text(strung, {"weather.temperature=80", "conductor.span=400"});
  EXPECT_NEAR(of_longer.conductor.tension, longer.conductor.tension, 1e-6);
}

TEST(Stringing, RefusesWhatCannotBe) {
  const auto with = [](const std::string& setting) { return refusal(strung, {setting}); };
  EXPECT_TRUE(holds(with("weather.temperature=-300"), "greater than -273.15"));
  EXPECT_TRUE(holds(with("weather.temperature=-500 degF"), "greater than -273.15"));
  EXPECT_TRUE(holds(with("weather.temperature=20 lbf"), "not a unit of this key"));
  EXPECT_TRUE(holds(with("weather.ice=1"), "at most 0.2 m"));
  EXPECT_TRUE(holds(with("stringing.ruling_span=0"), "at least 1 and at most 10000 m"));
  EXPECT_TRUE(holds(with("stringing.sag=3"), "give only one of them"));
  EXPECT_TRUE(holds(with("conductor.tension=28e3"), "is computed from [stringing]"));
  EXPECT_TRUE(holds(refusal(drake + "[stringing]\ntemperature = 15\n"), "stringing.tension (N)"));
  EXPECT_TRUE(holds(refusal(drake, {"weather.temperature=15"}), "no effect without"));
  // Beyond its strength in one state, which is named; and beyond the curves.
  EXPECT_TRUE(holds(refusal(strung, {"weather.temperature=-50", "conductor.rated_strength=36e3"}),
                    "at -50 degC the tension would be"));
  EXPECT_TRUE(holds(refusal(strung, {"stringing.tension=1.2e5", "weather.temperature=-50"}),
                    "beyond its stress-strain curves"));
  EXPECT_TRUE(
      holds(refusal("[conductor]\nmass_per_length = 1.6\nspan = 300\narea = 4.7e-4\n"
                    "youngs_modulus = 7e10\n[stringing]\ntemperature = 15\ntension = 28e3\n",
                    {"weather.temperature=20"}),
            "conductor.thermal_expansion"));
}

AnswerInMemory sag_tension(const std::string& text, std::vector<std::string> options) {
  options.insert(options.begin(), "sag-tension");
  return tests::answer_of(options, text);
}

TEST(Weather, HasTheDamageOfEachTemperatureInItsHours) {
  const std::string line = strung +
                           "[[device]]\nkind = \"dashpot\"\nposition = 1.5\ndamping = 300\n"
                           "[site]\nspeeds = [2, 4]\nhours = [1000, 500]\n";
  const Words of_year = {"weather.temperatures=[-20, 60]", "weather.hours=[2000, 6000]"};
  AnswerInMemory rows = answer_of({"fatigue", "--by-temperature"}, line, of_year);
  const auto parts = rows.numbers("damage_highest"), bare = rows.numbers("damage_bare");
  ASSERT_EQ(parts.size(), 2U);
  double whole = 0.0;
  for (std::size_t k = 0; k < 2; ++k) {
    const std::string at = "weather.temperature=" + std::string(k == 0 ? "-20" : "60");
    AnswerInMemory alone = answer_of({"fatigue"}, line, {at});
    const double damage = alone.numbers("highest")[4], share = k == 0 ? 0.25 : 0.75;
    EXPECT_EQ(alone.word("quantity", 4), "damage_per_year");
    EXPECT_NEAR(parts[k], share * damage, 1e-9 * damage) << at;
    EXPECT_NEAR(bare[k], share * alone.numbers("value")[3], 1e-9 * bare[k]) << at;
    EXPECT_NEAR(rows.numbers("horizontal_tension_N")[k],
                parabolic_tension_of(from_text(line, {at})), 1e-6);
    whole += parts[k];
  }
  AnswerInMemory year = answer_of({"fatigue"}, line, of_year);
  EXPECT_NEAR(year.numbers("highest")[4], whole, 1e-9 * whole);
  const auto by_speed =
      answer_of({"fatigue", "--by-speed"}, line, of_year).numbers("damage_highest");
  EXPECT_NEAR(by_speed[0] + by_speed[1], whole, 1e-9 * whole);
  // Colder is tauter, and lives shorter.
  EXPECT_GT(bare[0] / 0.25, bare[1] / 0.75);
  EXPECT_TRUE(holds(refusal(line, {of_year[0], "weather.hours=[1]"}), "the same number of values"));
  EXPECT_TRUE(holds(refusal(line, {of_year[0], "weather.hours=[8000, 800]"}), "a year has"));
  EXPECT_THROW(answer_of({"fatigue", "--by-temperature"}, line, {}), WrongInput);
}

TEST(SagTension, HasARowForEachTemperatureAndOneForTheHeaviestLoad) {
  const std::string iced = strung +
                           "[weather]\nice = \"0.5 in\"\nwind_pressure = 190\n"
                           "load_temperature = \"0 degF\"\nice_density = 913\n";
  AnswerInMemory table = sag_tension(iced, {"--temperature=-20:80:3"});
  EXPECT_EQ(table.numbers("temperature_C"),
            (std::vector<double>{-20.0, 30.0, 80.0, -17.77777777777778}));
  EXPECT_EQ(table.numbers("ice_m"), (std::vector<double>{0.0, 0.0, 0.0, 0.0127}));
  const std::vector<double>& tension = table.numbers("tension_N");
  EXPECT_GT(tension[1], tension[2]);
  EXPECT_GT(tension[3], tension[0]);
  EXPECT_THROW(sag_tension(iced, {"--temperature=-500:0:3"}), WrongInput);
  EXPECT_EQ(table.numbers("core_share")[2], 1.0);  // above the knee point
  const double span = 213.36, mass = 1.628;
  // The first antisymmetric mode of a slack span is that of the string.
  EXPECT_NEAR(table.numbers("first_frequency_Hz")[2],
              std::sqrt(table.numbers("horizontal_tension_N")[2] / mass) / span, 0.02);
  AnswerInMemory young = sag_tension(iced, {"--temperature=-20:80:3", "--initial"});
  for (std::size_t row = 0; row < 3; ++row)
    EXPECT_LT(tension[row], young.numbers("tension_N")[row]);
}

// Every conductor of the library hangs at 20 % of its strength: tighter in the cold, none breaks,
// and steel bears more of it the warmer it is.
TEST(SagTension, AnswersForEveryConductorOfTheLibrary) {
  for (const LibraryConductor& one : conductor_library()) {
    EXPECT_GT(one.outer.count, 0) << one.name;
    const std::string text =
        "[conductor]\nname = \"" + one.name + "\"\nspan = 250\n[stringing]\n" +
        "temperature = 15\ntension = " + std::to_string(0.2 * one.rated_strength) + "\n";
    AnswerInMemory table = sag_tension(text, {"--temperature=-30:80:3"});
    const std::vector<double>&tension = table.numbers("tension_N"),
          &core = table.numbers("core_share");
    for (std::size_t row = 1; row < 3; ++row) {
      EXPECT_LT(tension[row], tension[row - 1]) << one.name;
      EXPECT_GE(core[row], core[row - 1]) << one.name;
    }
    EXPECT_EQ(core.back() > 0.0, one.core.count > 0) << one.name;
  }
}

}  // namespace
}  // namespace holdfast::program
