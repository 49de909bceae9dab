#include "explorer/live_charts.hpp"

#include <cmath>

#include "case/case_file.hpp"
#include "case/model/linear_loop.hpp"
#include "case/model/plant_of_case.hpp"
#include "holdfast/core/errors.hpp"
#include "support/testing.hpp"

namespace holdfast::tests {
namespace {

using program::Case;

const GainGrid window{{-1000.0, 200.0, 7}, {-40.0, 20.0, 9}};

Case on(const std::string& model, std::vector<std::string> overrides = {}) {
  overrides.push_back("plant.model=" + model);
  if (model != "two_masses") overrides.emplace_back("plant.modes=8");
  return program::load_case({}, overrides);
}

// The largest root of the loop, found cell by cell, says the same.
TEST(LiveCharts, CellsAreStableWhereTheSpectralRadiusIsBelowOne) {
  for (const char* model : {"two_masses", "string", "cable"}) {
    SCOPED_TRACE(model);
    const std::vector<std::uint8_t> cells = program::stable_cells(on(model), window);
    std::size_t place = 0, stable = 0;
    for (std::int64_t i = 0; i < window.proportional.count; ++i) {
      for (std::int64_t j = 0; j < window.differential.count; ++j, ++place) {
        Case the_case = on(model);
        the_case.control.proportional_gain = window.proportional.at(i);
        the_case.control.differential_gain = window.differential.at(j);
        EXPECT_EQ(cells[place] != 0,
                  program::LinearLoop(the_case).radius(program::gains_of(the_case)) < 1.0)
            << place;
        stable += cells[place];
      }
    }
    EXPECT_GT(stable, 5U);
    EXPECT_LT(stable, place - 5U);
  }
}

TEST(LiveCharts, WithoutGainsTheControlLeavesEverything) {
  for (const char* model : {"two_masses", "string"}) {
    const Case idle = on(model, {"control.proportional_gain=0", "control.differential_gain=0",
                                 "excitation.hold=exact"});
    for (const program::AmplitudesAt& at : program::amplitudes_over(idle, {3.0, 60.0, 20}).at)
      EXPECT_NEAR(at.controlled, at.uncontrolled, 1e-9 * at.uncontrolled) << at.frequency;
  }
}

TEST(LiveCharts, AmplitudesAreNoneWhereThereIsNoSteadyMotionOrTooFewSamples) {
  const program::Amplitudes growing =
      program::amplitudes_over(on("two_masses", {"control.differential_gain=50"}), {3.0, 60.0, 5});
  EXPECT_FALSE(growing.stable);
  for (const program::AmplitudesAt& at : growing.at)
    EXPECT_TRUE(std::isnan(at.controlled) && at.uncontrolled > 0.0);
  const auto slow = program::amplitudes_over(
      on("two_masses", {"control.sampling_period=0.01", "control.differential_gain=-5"}),
      {20.0, 60.0, 2});
  EXPECT_TRUE(slow.stable);
  EXPECT_TRUE(std::isfinite(slow.at[0].controlled));
  EXPECT_TRUE(std::isnan(slow.at[1].controlled));
}

TEST(LiveCharts, RefuseWindowsThatAreNone) {
  EXPECT_THROW(program::stable_cells(on("two_masses"), {{1.0, 0.0, 7}, {-40.0, 20.0, 9}}),
               InvalidParameter);
}

}  // namespace
}  // namespace holdfast::tests
