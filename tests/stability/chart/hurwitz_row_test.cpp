#include "holdfast/stability/chart/hurwitz_row.hpp"

#include "support/random.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

TEST(HurwitzRow, IsTheTestOfEachCell) {
  test::Random random(11);
  int stable_cells = 0;
  for (int draw = 0; draw < 300; ++draw) {
    const double binomial[] = {1, 5, 10, 10, 5, 1};
    Vector<double, 6> constant, slope;
    for (int k = 0; k < 6; ++k) {
      constant[k] = binomial[k] * random.log_uniform(0.7, 1.4);
      slope[k] = binomial[k] * random.uniform(-0.3, 0.3);
    }
    std::vector<double> values;
    for (int j = 0; j < 37; ++j) values.push_back(-3.0 + 6.0 * j / 36.0);
    std::vector<std::uint8_t> stable(37, 2);
    hurwitz_row<double, 6>(constant, slope, values, stable.data());
    Eigen::Matrix<double, Eigen::Dynamic, 6> table(37, 6);
    for (int j = 0; j < 37; ++j) table.row(j) = constant + values[std::size_t(j)] * slope;
    std::vector<std::uint8_t> from_table(37, 2);
    hurwitz_row<double, 6>(table, from_table.data());
    for (std::size_t j = 0; j < 37; ++j) {
      const Vector<double, 6> polynomial = constant + values[j] * slope;
      EXPECT_EQ(stable[j], (is_hurwitz<double, 6>(polynomial) ? 1 : 0)) << draw << ' ' << j;
      EXPECT_EQ(from_table[j], stable[j]) << draw << ' ' << j;
      stable_cells += stable[j];
    }
  }
  EXPECT_GT(stable_cells, 500);
}

/// (w + 1)⁵ + x w: stable about x = 0 however far the row reaches.
TEST(HurwitzRow, CellsNearZeroAmidHugeOnesHaveTheirAnswer) {
  const Vector<double, 6> constant{1, 5, 10, 10, 5, 1}, slope{0, 1, 0, 0, 0, 0};
  for (const double huge : {1e10, 1e70, 1e150, 1e290}) {
    std::vector<std::uint8_t> stable(5);
    hurwitz_row<double, 6>(constant, slope, {-huge, -huge / 2, 0.0, 0.5, huge}, stable.data());
    EXPECT_EQ(stable, (std::vector<std::uint8_t>{0, 0, 1, 1, 0})) << huge;
  }
}

}  // namespace
}  // namespace holdfast
