#include "holdfast/stability/chart.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "holdfast/stability/characteristic_polynomial.hpp"
#include "holdfast/stability/spectral_radius.hpp"

namespace holdfast {
namespace {

const GainGrid grid{{-900.0, 100.0, 26}, {-40.0, 10.0, 51}};

TEST(Chart, IsTheSpectralRadiusCellByCell) {
  const auto loop = sampled_loop(kollar2022_plant(), Sampling<double>{0.01});
  const auto polynomial = characteristic_polynomial(loop).transformed(in_half_plane<double, 6>);
  int stable = 0;
  visit_stability_chart(polynomial, grid, [&](const PdGains<double>& gains, bool cell) {
    EXPECT_EQ(cell, (spectral_radius<double, 5>(loop.engaged_map(gains)) < 1.0))
        << gains.proportional << ' ' << gains.differential;
    stable += cell ? 1 : 0;
  });
  EXPECT_GT(stable, 100);
  EXPECT_LT(stable, 26 * 51 - 100);
}

TEST(Chart, IsTheSpectralAbscissaOfTheContinuousLoopCellByCell) {
  const auto plant = kollar2022_plant();
  int stable = 0;
  visit_stability_chart(characteristic_polynomial(plant), grid,
                        [&](const PdGains<double>& gains, bool cell) {
                          const Matrix<double, 4> closed =
                              plant.state_matrix() + plant.control_input() * gains.feedback_row();
                          EXPECT_EQ(cell, (spectral_abscissa<double, 4>(closed) < 0.0));
                          stable += cell ? 1 : 0;
                        });
  EXPECT_GT(stable, 100);
  EXPECT_LT(stable, 26 * 51 - 100);
}

TEST(Chart, GoesThroughDFasterThanThroughP) {
  const auto polynomial = characteristic_polynomial(kollar2022_plant());
  std::vector<PdGains<double>> order;
  visit_stability_chart(polynomial, GainGrid{{-2, -1, 2}, {5, 7, 3}},
                        [&](const PdGains<double>& gains, bool) { order.push_back(gains); });
  ASSERT_EQ(order.size(), 6U);
  EXPECT_EQ(order[1].proportional, -2);
  EXPECT_EQ(order[1].differential, 6);
  EXPECT_EQ(order[3].proportional, -1);
  EXPECT_EQ(order[3].differential, 5);
}

TEST(Chart, TheStoredChartIsTheVisitedOne) {
  const auto polynomial = characteristic_polynomial(kollar2022_plant());
  std::vector<bool> visited;
  visit_stability_chart(polynomial, grid,
                        [&](const PdGains<double>&, bool cell) { visited.push_back(cell); });
  EXPECT_EQ(stability_chart(polynomial, grid), visited);
}

}  // namespace
}  // namespace holdfast
