#include "case/model/resolved_plant.hpp"

#include "case/case_file.hpp"
#include "case/model/cable_of_case.hpp"
#include "case/plausibility/doubts.hpp"
#include "program/case/case_text.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

/// What there is to say of the plant of a case file.
std::string said_of(const std::string& text) {
  Case the_case = load_case_text(text, "case.toml", {});
  return settle_plant(the_case);
}

/// c2 is given, so that no fit is needed.
std::string conductor_and(const std::string& more) {
  return "[absorber]\nmass = 0.1\n[plant]\nabsorber_damping = 4\n" + more;
}

/// [plant] with every key, k1 apart.
std::string plant_with(double conductor_stiffness) {
  return "[plant]\nconductor_mass = 0.0767\nconductor_damping = 0.079\nabsorber_mass = 0.16\n"
         "absorber_stiffness = 74.4\nabsorber_damping = 4\nconductor_stiffness = " +
         format_number(conductor_stiffness) + "\n";
}

TEST(ResolvedPlant, SaysNothingOfTheBuiltInCaseOrAPlantAlone) {
  EXPECT_EQ(said_of(""), "");
  EXPECT_EQ(said_of(plant_with(70.0)), "");
}

TEST(ResolvedPlant, SaysWhatIsGivenAndWhatIsReduced) {
  const std::string said = said_of(conductor_and("[excitation]\nfrequency = 3\n"));
  EXPECT_EQ(said,
            "plant.absorber_damping given; the rest of the plant is reduced from the conductor");
}

TEST(ResolvedPlant, WarnsOfAForceFarFromTheFrequenciesOfTheReduction) {
  const auto said = [](const std::string& frequency) {
    return said_of(conductor_and("[excitation]\nfrequency = " + frequency +
                                 "\n[reduction]\nfirst_frequency = 2\nsecond_frequency = 7\n"));
  };
  EXPECT_TRUE(holds(said("14.1"), "14.1 Hz, far from the natural frequencies of 2 and 7 Hz"));
  EXPECT_TRUE(holds(said("0.99"), "far from"));
  EXPECT_FALSE(holds(said("13.9"), "far from"));
  EXPECT_FALSE(holds(said("1.01"), "far from"));
}

/// What is said of a conductor beside a plant.
std::string contradiction_in(const std::string& text) {
  return contradicted_conductor_text(load_case_text(text, "case.toml", {}));
}

TEST(ContradictedConductor, IsNamedWhereItWouldGiveAnotherPlantThanTheOneGiven) {
  const auto conductor = [](const char* sag) {
    return std::string("[conductor]\nmass_per_length = 0.043\nspan = 6.4\narea = 5.5e-6\n") +
           "youngs_modulus = 18e9\nsag = " + sag + "\n[absorber]\nmass = 0.16\nposition = 0.64\n" +
           "[reduction]\nfirst_frequency = 1.999\nsecond_frequency = 6.998\n";
  };
  EXPECT_EQ(contradiction_in(conductor("0.29") + plant_with(50.3)), "")
      << "Table 1 belongs together";
  const std::string said = contradiction_in(conductor("0.29") + plant_with(80.0));
  EXPECT_TRUE(holds(said, "every key of [plant] is given")) << said;
  EXPECT_TRUE(holds(said, "k1 80 instead of ")) << said;
  EXPECT_TRUE(holds(contradiction_in(conductor("0.29") + plant_with(60.0)), "k1 60 instead of "));
}

TEST(ContradictedConductor, IsNamedAlsoWhereItHasNoPlantAtAll) {
  EXPECT_TRUE(holds(contradiction_in("[conductor]\nmass_per_length = 0.043\nspan = 6.4\n"
                                     "area = 5.5e-6\nyoungs_modulus = 18e9\nsag = 0.29\n"
                                     "[absorber]\nmass = 50\nposition = 0.64\n" +
                                     plant_with(50.3)),
                    "m2 0.16 instead of 50 kg"));
}

TEST(ContradictedConductor, IsNotThereWhereOneOfThemAloneIsGiven) {
  EXPECT_EQ(contradiction_in(""), "");
  EXPECT_EQ(contradiction_in(plant_with(80.0)), "");
  EXPECT_EQ(contradiction_in("[conductor]\nsag = 0.5\n"), "");
  EXPECT_EQ(contradiction_in("[conductor]\nsag = 0.5\n" + plant_with(50.3)), "")
      << "of a conductor that lacks the rest nothing is known";
}

TEST(BorrowedCable, IsNamedWhereTheCaseGivesAPlantAlone) {
  const auto warning = [](const std::string& text) {
    return borrowed_cable_warning(load_case_text(text, "case.toml", {}));
  };
  EXPECT_TRUE(holds(warning("[plant]\nabsorber_mass = 0.2\n"), "that of the built-in case"));
  EXPECT_EQ(warning("[plant]\nabsorber_mass = 0.2\n[conductor]\nsag = 0.3\n"), "");
  EXPECT_EQ(warning(plant_with(50.3)), "") << "it has no cable, and no job takes another's";
  EXPECT_EQ(warning(""), "");
}

}  // namespace
}  // namespace holdfast::program
