#include "cli/program.hpp"
#include "support/testing.hpp"

namespace holdfast::tests {
namespace {

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

TEST(Conductors, GoToAFileWithMetadata) {
  const TemporaryFolder folder;
  const Outcome outcome = run_holdfast("conductors --output c.csv", "", folder.path().string());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_NE(read_text(folder / "c.csv").find("Drake"), std::string::npos);
  EXPECT_NE(read_text(folder / "c.csv-metadata.json").find("\"kg/m\""), std::string::npos);
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
