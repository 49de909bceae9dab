#include "arb/arb_loop.hpp"
#include "holdfast/stability/chart/proved_chart.hpp"
#include "support/testing.hpp"

namespace holdfast {
namespace {

using test::Ball;
using test::BallMatrix;
using test::DecimalLoop;

const std::array<std::string, 6> paper{"0.0767", "50.3", "0.079", "0.16", "74.4", "4.0"};

const std::vector<DecimalLoop> loops{
    {paper, "0.001", "0"},
    {paper, "0.003", "0.0017"},
    {paper, "0.011", "0.011"},
    {{"0.3", "1000.1", "0.001", "0.07", "31.7", "0.2"}, "0.02", "0.007"}};

TwoMass<double> masses_of(const DecimalLoop& loop) {
  std::array<double, 6> m{};
  for (std::size_t k = 0; k < 6; ++k) m.at(k) = std::stod(loop.masses.at(k));
  return {m[0], m[1], m[2], m[3], m[4], m[5]};
}

Sampling<double> sampling_of(const DecimalLoop& loop) {
  return {std::stod(loop.period), std::stod(loop.delay)};
}

/// e^M by Arb lies within ours, entry by entry, for matrices of many sizes.
TEST(EnclosedExponential, HoldsThatOfArb) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 300; ++trial) {
    const double size = std::pow(10.0, 0.01 * trial - 1.5);
    Matrix<Enclosure, 4> matrix;
    BallMatrix balls(4);
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) {
        const double entry = size * normal(random);
        matrix(i, j) = entry;
        balls.set(i, j, Ball(entry));
      }
    const Matrix<Enclosure, 4> ours = exponential(matrix);
    const BallMatrix theirs = balls.exponential();
    double largest = 0.0, widest = 0.0;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) {
        EXPECT_TRUE(theirs.at(i, j).is_in(ours(i, j))) << "size " << size;
        largest = std::max(largest, ours(i, j).magnitude());
        widest = std::max(widest, ours(i, j).radius());
      }
    if (size < 1.0) {
      EXPECT_LT(widest, 1e-12 * largest) << "size " << size;
    }
  }
}

/// What a short series leaves is held by its bound, and little more than held.
TEST(EnclosedExponential, HoldsWhatAShortSeriesLeaves) {
  Matrix<Enclosure, 2> matrix;
  matrix << 0.3, 0.2, 0.2, 0.3;  // ‖M‖ = 1/2, to which all terms add up
  BallMatrix balls(2);
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) balls.set(i, j, Ball(matrix(i, j).lower()));
  const BallMatrix theirs = balls.exponential();
  for (int terms = 1; terms < 8; ++terms) {
    const Matrix<Enclosure, 2> ours = detail::exponential_series(matrix, 0.5, terms);
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j)
        EXPECT_TRUE(theirs.at(i, j).is_in(ours(i, j))) << terms << " terms";
    const double left = std::pow(0.5, terms + 1) / std::tgamma(terms + 2.0);
    EXPECT_LT(ours(0, 0).radius(), 1.3 * left) << terms << " terms";
  }
}

/// The loop's polynomial, from Arb's S and its determinant, lies within the one that is proved
/// with.
TEST(GainBoxProof, IsOfThePolynomialThatArbFinds) {
  for (const DecimalLoop& loop : loops) {
    const auto loop_in_balls = sampled_loop(enclosed(masses_of(loop)), enclosed(sampling_of(loop)));
    const auto ours = characteristic_polynomial(loop_in_balls);
    const auto base = loop.map(Ball(), Ball()).characteristic_polynomial(1.0);
    const auto with_p = loop.map(Ball(1.0), Ball()).characteristic_polynomial(1.0);
    const auto with_d = loop.map(Ball(), Ball(1.0)).characteristic_polynomial(1.0);
    for (std::size_t k = 0; k <= 5; ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      EXPECT_TRUE(base[k].is_in(ours.base[i])) << k;
      EXPECT_TRUE((with_p[k] - base[k]).is_in(ours.proportional[i])) << k;
      EXPECT_TRUE((with_d[k] - base[k]).is_in(ours.differential[i])) << k;
      EXPECT_LT(ours.base[i].radius(), 1e-11 * (1.0 + ours.base[i].magnitude())) << k;
    }
  }
}

/// Random gains in random boxes of proved charts: the roots that Arb isolates agree.
TEST(ProvedChart, IsNotContradictedByArb) {
  std::mt19937 random(3);
  for (const DecimalLoop& loop : loops) {
    const ProvedChart chart = proved_chart(gain_box_proof(masses_of(loop), sampling_of(loop)),
                                           {{-1000.0, 200.0, 5}, {-40.0, 20.0, 5}}, 1e-3);
    std::array<int, 3> asked{};
    for (int trial = 0; trial < 1500; ++trial) {
      const ProvedBox& box = chart.boxes[random() % chart.boxes.size()];
      // The corners too, where the decisions are nearest to the boundary.
      const auto between = [&](double from, double to) {
        const double share = random() % 2 == 0 ? static_cast<double>(random() % 2)
                                               : static_cast<double>(random() % 1000) / 1000.0;
        return std::clamp(from + share * (to - from), from, to);
      };
      const double p = between(box.gains.proportional_from, box.gains.proportional_to);
      const double d = between(box.gains.differential_from, box.gains.differential_to);
      const auto roots =
          test::count_roots(loop.map(Ball(p), Ball(d)).characteristic_polynomial(0.0));
      ++asked.at(static_cast<std::size_t>(box.stability));
      if (box.stability == ProvedStability::stable) {
        EXPECT_EQ(roots.outside, 0) << p << " " << d;
      }
      if (box.stability == ProvedStability::unstable) {
        EXPECT_NE(roots.inside, 5) << p << " " << d;
      }
    }
    EXPECT_GT(asked[0], 100);
    EXPECT_GT(asked[1], 100);
  }
}

}  // namespace
}  // namespace holdfast
